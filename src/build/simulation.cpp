#include "build/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "base/page_memory.hpp"
#include "build/build_mesh.hpp"
#include "build/build_model.hpp"
#include "build/eroding_parts.hpp"
#include "build/facing.hpp"
#include "build/torn_ties.hpp"
#include "contact/mirror_images.hpp"
#include "contact/stiffness.hpp"
#include "math/vec3.hpp"
#include "schemes/imposed_motion.hpp"
#include "solid/smallest_cell.hpp"
#include "surface/buried_facets.hpp"

namespace carom {

namespace {

/// Turns what the numerics refuse (std::invalid_argument) into an error at the section that asked for it.
template <class Make>
auto at_section(const Location& where, const std::string& key, const Make& make) -> decltype(make()) {
  try {
    return make();
  } catch (const std::invalid_argument& e) {
    throw CaseError(where, key, e.what(), "");
  }
}

Location contacts_place(const Case& given) {
  return given.contacts.empty() ? Location{given.file} : given.contacts.front().where;
}

bool needs_stiffness(const CaseScheme& scheme) {
  return traits(**scheme.enforcement).takes_stiffness;
}
RowHold hold_of(const CaseScheme& scheme) {
  const EnforcementKind enforcement = **scheme.enforcement;
  if (enforcement == EnforcementKind::penalty) return RowHold::springs;
  if (enforcement == EnforcementKind::impulse) return RowHold::impulses;
  return is_explicit(*scheme.kind) ? RowHold::increments : RowHold::multipliers;
}
RowHold hold_of(const Case& given) {
  RowHold most = hold_of(given.scheme);
  for (const CaseStage& stage : given.stages) most = std::max(most, hold_of(stage.scheme));
  return most;
}
/// Explicit steps tie exactly.
bool ties_by_springs(const CaseScheme& scheme) {
  return needs_stiffness(scheme) && !is_explicit(*scheme.kind);
}
bool any_stage(const Case& given, bool (*does)(const CaseScheme& scheme)) {
  return does(given.scheme) || std::any_of(given.stages.begin(), given.stages.end(),
                                           [does](const CaseStage& stage) { return does(stage.scheme); });
}

/// The model of the case, with the state that it takes over, and with a stiffness for every contact whose case gives
/// none and whose enforcement needs one.
Model make_model(const Case& given, std::shared_ptr<const Mesh> mesh, std::optional<TakenState>& taken,
                 std::vector<std::string>& notes) {
  Model model = build_model(given, std::move(mesh));
  notes = model.notes;
  for (ContactDefinition& contact : model.contacts)
    if (ContactLaw* law = law_of(contact)) law->hold = hold_of(given);
  for (const CohesiveZone& zone : model.cohesive) notes.insert(notes.end(), zone.notes.begin(), zone.notes.end());
  taken = take_over(given, model);
  leave_out_cuts(model);
  const auto choose = [&](std::vector<std::string> (*choice)(Model&)) {
    const auto more = at_section(contacts_place(given), "contact", [&] { return choice(model); });
    notes.insert(notes.end(), more.begin(), more.end());
  };
  choose(choose_cohesive_stiffness);
  if (any_stage(given, needs_stiffness)) choose(choose_stiffness);
  if (any_stage(given, ties_by_springs)) choose(choose_tie_stiffness);
  return model;
}

/// Is an overlap, in cells, such as contact has that presses by penalties? No verdict passes deeper ones
/// (PenetrationWatch); stops are springs of any depth.
bool is_of_penalties(const CaseContact& contact, double depth) {
  constexpr double most = 0.25;
  return depth <= most || contact.law() == nullptr;
}

/// What the case says of overlaps at the start; empty: those of its initial state are kept.
std::optional<InitialPenetration> initial_penetration(const Case& given, const CaseContact& contact) {
  if (contact.law() != nullptr) return contact.law()->initial_penetration;
  return given.initial_state ? std::nullopt : std::optional(InitialPenetration::refuse);
}

ContactGeometry make_contact(const Case& given, const Model& model) {
  return at_section(contacts_place(given), "contact", [&] { return ContactGeometry(model); });
}

}  // namespace

Simulation::Simulation(Case given)
    : case_(std::move(given)),
      mesh_(std::make_shared<const Mesh>(build_mesh(case_))),
      model_(make_model(case_, mesh_, taken_, notes_)),
      solid_(model_),
      contact_(make_contact(case_, model_)) {
  notes_.insert(notes_.end(), contact_.notes().begin(), contact_.notes().end());
  if (taken_) {
    take_points(case_, solid_, *taken_);
    notes_.insert(notes_.begin(), taken_->note);
  }
  refuse_surfaces_from_behind();
  settle_initial_penetrations();
  {
    const State first = initial_state();  // not kept while the stages are made: it is large
    refuse_torn_ties(case_, model_, contact_, first.q, first.v);
  }
  const StageContext context{case_, *mesh_, model_, solid_, contact_};
  stages_.push_back(std::make_unique<Stage>(context, case_.scheme, case_.time, 0.0, later_velocities(0)));
  for (const CaseStage& stage : case_.stages) {
    stages_.push_back(std::make_unique<Stage>(context, stage.scheme, stage.time, stages_.back()->end(),
                                              later_velocities(stages_.size())));
  }
  refuse_velocities(initial_state());
  refuse_erosion(case_, model_, stages_);
  for (const auto& stage : stages_) {
    const std::vector<std::string>& lines = stage->mass_notes().lines;
    notes_.insert(notes_.end(), lines.begin(), lines.end());
  }
}

/// Flags of the nodes that have been given a velocity which begins after this stage, where this one and all before it
/// are statics.
std::vector<bool> Simulation::later_velocities(std::size_t stage) const {
  const auto is_static = [this](std::size_t i) {
    return !has_inertia(*(i == 0 ? case_.scheme : case_.stages[i - 1].scheme).kind);
  };
  std::vector<bool> later(mesh_->node_count());
  for (std::size_t i = 0; i <= stage; ++i)
    if (!is_static(i)) return later;
  for (const InitialState& initial : model_.initial) {
    for (std::size_t k = 0; k < initial.nodes.size() && !initial.velocity.empty(); ++k) {
      const bool is_given = norm(initial.velocity_of(k)) > 0.0;
      if (is_given || initial.stage == 0) later[static_cast<std::size_t>(initial.nodes[k])] = is_given;
    }
  }
  return later;
}

long long Simulation::steps() const {
  long long count = 0;
  for (const auto& stage : stages_) count += stage->steps();
  return count;
}

/// Bodies that overlap at the start would be thrown apart by energy that nobody put in: what is done about it is the
/// user's choice, contact by contact.
void Simulation::settle_initial_penetrations() {
  const State state = initial_state();
  const double cell = smallest_cell(solid_);
  const double round_off = 1e-6 * cell;  // coordinates of meshes often come in single precision
  for (std::size_t c = 0; c < case_.contacts.size(); ++c) {
    std::size_t count = 0;
    double worst = 0.0;
    std::string list;
    for (const Penetration& p : contact_.initial_penetrations(state.q)) {
      if (static_cast<std::size_t>(p.contact) != c || p.depth - p.rounded <= round_off) continue;
      worst = std::max(worst, p.depth);
      if (++count > 3) continue;
      list += fmt::format("{}{:.4g} at ({:.4g}, {:.4g}, {:.4g})", list.empty() ? "" : ", ", p.depth, p.position[0],
                          p.position[1], p.position[2]);
    }
    if (count == 0) {
      refuse_buried_facets(c, state);
      continue;
    }
    const CaseContact& contact = case_.contacts[c];
    const std::string what =
        fmt::format("{} rows of \"{}\" that penetrate at the start, the worst by {:.4g} ({:.3g} of a cell): {}{}",
                    count, *contact.name, worst, worst / cell, list, count > 3 ? ", ..." : "");
    const std::optional<InitialPenetration> chosen = initial_penetration(case_, contact);
    const InitialPenetration wanted = chosen.value_or(
        is_of_penalties(contact, worst / cell) ? InitialPenetration::prestress : InitialPenetration::refuse);
    if (wanted == InitialPenetration::refuse) {
      throw CaseError(
          contact.where, "contact", what,
          chosen ? "a gap that is open or just closed"
                 : "a gap that is open, or an overlap as the contact of the initial state leaves "
                   "it: of at most a quarter of a cell",
          "Is the normal turned the wrong way, or the gap of the wrong sign? If the overlap is meant, choose "
          "initial_penetration = \"offset\" or \"prestress\".");
    }
    notes_.push_back(fmt::format(
        "{}; {}", what, wanted == InitialPenetration::prestress ? "kept as prestress" : "taken as free of strain"));
  }
  contact_.set_initial(state.q);
}

/// Rigid surfaces are met from the side that their normals look to; from the other side everything passes.
void Simulation::refuse_surfaces_from_behind() const {
  const State state = initial_state();
  for (std::size_t c = 0; c < case_.contacts.size(); ++c) {
    if (!goes_through_its_back(model_, c, state)) continue;
    const CaseContact& contact = case_.contacts[c];
    throw CaseError(contact.where, "contact",
                    fmt::format("faces of the rigid surface of \"{}\" that look away from \"{}\", which moves towards "
                                "their back and would pass",
                                *contact.name, *contact.group()),
                    "normals that look at what touches: by the right-hand rule, and of lines a quarter turn clockwise "
                    "from the first node to the second",
                    "Turn the faces round (the order of their nodes; in a deck, of whose lines the normal is a quarter "
                    "turn counter-clockwise, SNEG instead of SPOS).");
  }
}

/// Facets of a pair inside of another body and too deep for any row: contact would not see them, ever.
void Simulation::refuse_buried_facets(std::size_t c, const State& state) const {
  std::vector<BuriedFacet> buried = buried_facets(model_, model_.contacts[c], state.q);
  if (buried.empty()) return;
  const std::shared_ptr<const ConstraintRows> rows = contact_.rows_at(state.q, state.q);
  std::set<Index> seen;
  for (std::size_t r = 0; r < rows->size(); ++r)
    if (static_cast<std::size_t>(rows->source[r]) == c)
      seen.insert(rows->node.begin() + rows->begin[r], rows->node.begin() + rows->begin[r + 1]);
  std::erase_if(buried, [&](const BuriedFacet& b) {
    return std::any_of(b.facet.begin(), b.facet.end(), [&](Index n) { return seen.contains(n); });
  });
  if (buried.empty()) return;
  const CaseContact& contact = case_.contacts[c];
  const auto& [facet, x, cell] = buried[0];
  const CellBlock& block = mesh_->blocks[static_cast<std::size_t>(cell.block)];
  throw CaseError(
      contact.where, "contact",
      fmt::format("{} facets of \"{}\" deep inside of another body at the start, such as that of node {} at "
                  "({:.4g}, {:.4g}, {:.4g}) inside of {} {}",
                  buried.size(), *contact.name, mesh_->node_label(facet[0]), x[0], x[1], x[2], name(block.type),
                  mesh_->cell_label(cell)),
      "bodies that are apart or just touch",
      "Is one body placed on the wrong side of the other? Contact sees overlaps of one facet's size at most.");
}

State Simulation::initial_state() const {
  State state;
  for (std::vector<double>* values : {&state.q, &state.v, &state.a}) *values = unwritten_zeros(solid_.dof_count());
  if (taken_) state.points = taken_->points;
  for (const InitialState& initial : model_.initial) {
    if (initial.stage > 0) continue;
    for (std::size_t k = 0; k < initial.nodes.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t i = 3 * static_cast<std::size_t>(initial.nodes[k]) + c;
        if (!initial.displacement.empty()) state.q[i] = initial.displacement_of(k)[c];
        if (!initial.velocity.empty()) state.v[i] = initial.velocity_of(k)[c];
      }
    }
  }
  for (std::vector<double>* values : {&state.q, &state.v}) model_.embedding.spread(*values);
  state.contact = contact_.first_history(state.q);
  return state;
}

/// The first stage with inertia; the number of stages where none has.
std::size_t Simulation::first_with_inertia() const {
  const auto has_inertia = [](const auto& s) { return carom::has_inertia(s->settings().kind); };
  return static_cast<std::size_t>(std::find_if(stages_.begin(), stages_.end(), has_inertia) - stages_.begin());
}

/// Velocities that break equations, or part what is tied, as a stage begins.
void Simulation::refuse_velocities(const State& start) const {
  const std::size_t first = first_with_inertia();
  std::vector<double> v = start.v;
  const auto impose = [&](std::size_t stage, const auto& note) {
    const Supports& supports = stages_[stage]->system().supports;
    for (const PrescribedDof& p : supports.prescribed()) {
      v[static_cast<std::size_t>(p.dof)] = imposed_velocity(supports, p, stages_[stage]->begin());
      note(static_cast<std::size_t>(p.dof));
    }
  };
  if (first < stages_.size()) impose(first, [](std::size_t) {});
  refuse_broken_equations(case_, model_, contact_, start.q, v);
  for (std::size_t stage = 1; stage < stages_.size(); ++stage) {
    std::vector<Velocity> known(v.size(), Velocity::unknown);
    v.assign(v.size(), 0.0);
    for (const InitialState& initial : model_.initial) {
      if (initial.stage != stage || initial.velocity.empty()) continue;
      for (std::size_t k = 0; k < initial.nodes.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t i = 3 * static_cast<std::size_t>(initial.nodes[k]) + c;
          v[i] = initial.velocity_of(k)[c];
          known[i] = Velocity::given;
        }
      }
    }
    impose(stage, [&](std::size_t dof) { known[dof] = Velocity::imposed; });
    refuse_parting_velocities(case_, model_, contact_, stage, v, known);
  }
}

bool Simulation::begin_velocities(std::size_t stage, State& state, const Holding* shared) const {
  constexpr std::size_t piece = 1U << 17U;  // nodes: 3 MB
  const std::size_t first = first_with_inertia();
  bool given = false;
  for (const InitialState& initial : model_.initial) {
    if (initial.velocity.empty() || stage != (initial.stage > 0 ? initial.stage : first)) continue;
    given = true;
    for (std::size_t k = 0; k < initial.nodes.size(); ++k) {
      const Vec3& velocity = initial.velocity_of(k);
      std::copy(velocity.begin(), velocity.end(), state.v.begin() + 3 * static_cast<std::ptrdiff_t>(initial.nodes[k]));
      if (shared != nullptr && k % piece == piece - 1) shared->release(state.v);
    }
  }
  return given;
}

}  // namespace carom
