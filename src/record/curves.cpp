#include "record/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "energy/ledger.hpp"
#include "math/vec3.hpp"
#include "record/part_extremes.hpp"
#include "record/probe_place.hpp"

namespace carom {

namespace {

/// The heads of a quantity at a place.
void add_heads(std::string_view quantity, const std::string& place, std::vector<std::string>& heads) {
  for (const std::string& name : column_names(quantity)) heads.push_back(place.empty() ? name : place + "." + name);
}

}  // namespace

EnergyCurves::EnergyCurves() {
  table_.columns = {"time", "step", "dt", "iterations"};
  for (const EnergyTerm& term : energy_terms) table_.columns.emplace_back(term.name);
  table_.columns.emplace_back("imbalance");
  table_.columns.insert(table_.columns.end(), aster_names.begin(), aster_names.end());
  for (const char* quantity : {"momentum", "angular_momentum", "momentum_error", "angular_momentum_error"})
    add_heads(quantity, "", table_.columns);
}

void EnergyCurves::sample(const StepView& view) {
  const EnergyTerms e = view.ledger.now();
  const std::array<double, 6> aster = aster_values(view.ledger.aster());
  const Momentum &p = view.ledger.momentum(), error = view.ledger.momentum_error();
  table_.row = {view.state.t, static_cast<double>(view.step), view.dt, static_cast<double>(view.iterations)};
  for (const EnergyTerm& term : energy_terms) table_.row.push_back(e.*term.value);
  table_.row.push_back(view.ledger.imbalance());
  table_.row.insert(table_.row.end(), aster.begin(), aster.end());
  table_.row.insert(table_.row.end(), {p.linear[0], p.linear[1], p.linear[2], p.angular[0], p.angular[1], p.angular[2],
                                       norm(error.linear), norm(error.angular)});
}

namespace {

/// What contact.csv says of the motion of a contact's obstacle.
std::vector<std::string_view> motion_quantities(const Model& model, std::size_t contact) {
  const ContactParts found = parts_of(model.contacts[contact]);
  if (!found.moves()) return {};
  std::vector<std::string_view> names{"displacement", "velocity"};
  if (found.body >= 0) names.emplace_back("angular_velocity");
  return names;
}

bool asks(const CaseProbe& probe, std::string_view quantity) {
  return std::ranges::any_of(probe.quantities, [&](const auto& name) { return *name == quantity; });
}

std::vector<std::optional<Vec3>> moment_points(const Case& given) {
  std::vector<std::optional<Vec3>> points;
  for (const CaseContact& contact : given.contacts) points.push_back(contact.moment_point);
  return points;
}

}  // namespace

ContactCurves::ContactCurves(const Simulation& simulation)
    : model_(simulation.model()),
      solid_(simulation.solid()),
      contacts_(simulation.given().contacts.size()),
      resultants_(model_, moment_points(simulation.given())) {
  table_.columns = {"time"};
  for (std::size_t c = 0; c < contacts_; ++c) {
    const auto add_columns = [&](const std::string& place, const auto& names) {
      for (const std::string_view name : names) add_heads(name, place, table_.columns);
    };
    for (const ResultantPlace& place : resultants_.places())
      if (place.contact == c) add_columns(place.name, std::array{"force", "impulse", "moment"});
    const std::string& contact = *simulation.given().contacts[c].name;
    add_columns(contact, std::array{"penetration", "closed", "closings"});
    add_columns(contact, motion_quantities(model_, c));
  }
  force_.resize(resultants_.places().size());
  impulse_.resize(resultants_.places().size());
  closed_.resize(contacts_);
  closings_.resize(contacts_);
}

std::vector<std::string> ContactCurves::resultants(std::size_t contact) const {
  std::vector<std::string> names;
  for (const ResultantPlace& place : resultants_.places()) {
    if (place.contact != contact) continue;
    for (const char* quantity : {"force", "moment"}) add_heads(quantity, place.name, names);
  }
  return names;
}

void ContactCurves::add_impulses(const StepView& view, const std::vector<ContactResultant>& now) {
  if (view.step > 0) {
    std::vector<ContactResultant> within(now.size());
    if (view.within.weight > 0.0) within = resultants_.of(view.within.rows, view.within.u);
    const double ends = 1.0 - view.within.weight;
    for (std::size_t k = 0; k < now.size(); ++k) {
      for (std::size_t i = 0; i < 3; ++i)
        impulse_[k][i] +=
            view.dt * (ends * (1.0 - view.end_weight) * force_[k][i] + ends * view.end_weight * now[k].force[i] +
                       view.within.weight * within[k].force[i]);
    }
  }
  for (std::size_t k = 0; k < now.size(); ++k) force_[k] = now[k].force;
}

void ContactCurves::add_motion(std::size_t contact, const State& state) {
  const ContactParts found = parts_of(model_.contacts[contact]);
  const auto append = [&](const Vec3& x) { table_.row.insert(table_.row.end(), x.begin(), x.end()); };
  if (found.carrier >= 0) {
    for (const std::vector<double>* x : {&state.q, &state.v}) {
      const auto first = x->begin() + 3 * static_cast<std::ptrdiff_t>(found.carrier);
      table_.row.insert(table_.row.end(), first, first + 3);
    }
  }
  if (found.body < 0) return;
  const TurningBody& body = model_.turning_bodies[static_cast<std::size_t>(found.body)];
  const BodyFrame displacement = body_frame(body, nodal_values(body, state.q));
  const BodyFrame velocity = body_frame(body, nodal_values(body, state.v));
  BodyFrame position = displacement;
  for (std::size_t i = 0; i < 3; ++i) position.directors[i] = add(position.directors[i], body.axes[i]);
  append(displacement.centre);
  append(velocity.centre);
  append(angular_velocity(position, velocity));
}

void ContactCurves::sample(const StepView& view) {
  const ConstraintRows& rows = *view.forces.rows.rows;
  std::vector<ContactResultant> resultants = resultants_.of(view.forces.rows, view.state.q);
  resultants_.add_cohesive(solid_.cohesive(), view.state.q, view.points().history, resultants);
  std::vector<double> penetration(contacts_, 0.0), closed(contacts_, 0.0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (view.forces.rows.status[r] == RowStatus::open || rows.source[r] < 0) continue;
    const auto c = static_cast<std::size_t>(rows.source[r]);
    penetration[c] = std::max(penetration[c], -rows.gap_at(r, view.state.q));
    closed[c] += 1.0;
  }
  table_.row = {view.state.t};
  add_impulses(view, resultants);
  for (std::size_t c = 0; c < contacts_; ++c) {
    for (std::size_t k = 0; k < resultants.size(); ++k) {
      if (resultants_.places()[k].contact != c) continue;
      for (const Vec3* v : std::array<const Vec3*, 3>{&resultants[k].force, &impulse_[k], &resultants[k].moment})
        table_.row.insert(table_.row.end(), v->begin(), v->end());
    }
    if (closed_[c] == 0.0 && closed[c] > 0.0) closings_[c] += 1.0;
    closed_[c] = closed[c];
    table_.row.insert(table_.row.end(), {penetration[c], closed[c], closings_[c]});
    add_motion(c, view.state);
  }
}

ProbeCurves::ProbeCurves(const Simulation& simulation, const CurveTable& parts)
    : simulation_(simulation), gravity_(gravity_loads(simulation.model())) {
  table_.columns = {"time"};
  for (const CaseProbe& given : simulation.given().probes) {
    Probe probe;
    for (const auto& quantity : given.quantities) probe.quantities.push_back(*quantity);
    positions_.emplace_back();
    if (given.part) {
      probe.part = PartSums(given, simulation, parts);
      positions_.back() = probe.part.centre();
    } else {
      add_nodes(given, probe);
    }
    probe.position = positions_.back();
    add_columns(given, probe);
    probes_.push_back(std::move(probe));
  }
  find_stressed_cells();
}

void ProbeCurves::find_stressed_cells() {
  for (const Probe& probe : probes_)
    for (const std::string& quantity : probe.quantities) {
      if (is_extreme_of_stress(quantity))
        stressed_cells_.insert(stressed_cells_.end(), probe.part.cells().begin(), probe.part.cells().end());
      if (!FieldsNow::needs_stress(quantity)) continue;
      if (field_kind(simulation_, quantity)->is_at_nodes()) return stressed_cells_.clear();
      stressed_cells_.insert(stressed_cells_.end(), probe.cells.begin(), probe.cells.end());
    }
  std::ranges::sort(stressed_cells_);
  stressed_cells_.erase(std::unique(stressed_cells_.begin(), stressed_cells_.end()), stressed_cells_.end());
}

void ProbeCurves::add_nodes(const CaseProbe& given, Probe& probe) {
  const ProbePlace place = place_probe(given, simulation_);
  probe.nodes = place.nodes;
  Vec3& position = positions_.back();
  for (const Index n : probe.nodes)
    position =
        add(position, scaled(simulation_.mesh().coordinates[at(n)], 1.0 / static_cast<double>(probe.nodes.size())));
  find_cells(given, position, probe);
  find_held(given, probe);
  if (asks(given, "local_acceleration")) probe.axes = TurningAxes(given, probe.nodes, simulation_);
  if (given.point) note_node(given, place);
}

void ProbeCurves::note_node(const CaseProbe& given, const ProbePlace& place) {
  const auto n = static_cast<std::size_t>(place.nodes[0]);
  const Vec3& x = simulation_.mesh().coordinates[n];
  notes_.push_back(fmt::format("probe \"{}\": node {} at ({:.6g}, {:.6g}, {:.6g}), {:.3g} from the point", *given.name,
                               simulation_.mesh().node_label(place.nodes[0]), x[0], x[1], x[2], place.distance));
}

void ProbeCurves::find_cells(const CaseProbe& given, const Vec3& position, Probe& probe) const {
  const auto of_cells = std::ranges::find_if(probe.quantities, [&](const std::string& name) {
    const std::optional<FieldKind> kind = field_kind(simulation_, name);
    return (kind && !kind->is_at_nodes()) || name == "section_force";
  });
  if (of_cells == probe.quantities.end()) return;
  const Mesh& mesh = simulation_.mesh();
  const Solid& solid = simulation_.solid();
  const Vec3 across = given.side ? across_section(given, probe.nodes, mesh) : Vec3{};
  std::vector<bool> is_member(mesh.node_count(), false);
  for (const Index n : probe.nodes) is_member[static_cast<std::size_t>(n)] = true;
  for (std::size_t k = 0; k < solid.cells().size(); ++k) {
    const auto nodes = solid.cells().nodes_of(k);
    bool touches = false;
    Vec3 centre{};
    for (const Index n : nodes) {
      touches = touches || is_member[static_cast<std::size_t>(n)];
      centre =
          add(centre, scaled(mesh.coordinates[static_cast<std::size_t>(n)], 1.0 / static_cast<double>(nodes.size())));
    }
    if (!touches) continue;
    if (simulation_.model().part_of(solid.cells()[k])->rigid_body >= 0)
      throw CaseError(given.where, "probe.quantities",
                      fmt::format("\"{}\" at cells of a rigid body, which have no stresses", *of_cells),
                      "a probe on deformable parts",
                      "Contacts have the forces of their sides, [[support]]s those of what they hold (reaction).");
    probe.cells.push_back(static_cast<Index>(k));
    if (given.side && dot(subtract(centre, position), across) > 0.0)
      probe.section_cells.push_back(static_cast<Index>(k));
  }
  const bool nothing_to_sum = asks(given, "section_force") && probe.section_cells.empty();
  if (probe.cells.empty() || nothing_to_sum) {
    throw CaseError(
        given.where, "probe",
        fmt::format("no solid cell that touches probe \"{}\"{}", *given.name, nothing_to_sum ? " on that side" : ""),
        "a probe on nodes of a part", nothing_to_sum ? "Turn `side` to where the cells are." : "");
  }
  if (asks(given, "section_force")) probe.section_mass = SectionMass(solid, probe.nodes, probe.section_cells);
}

void ProbeCurves::find_held(const CaseProbe& given, Probe& probe) const {
  const auto asked = std::find_if(given.quantities.begin(), given.quantities.end(), [](const auto& quantity) {
    return *quantity == "reaction" || *quantity == "reaction_moment";
  });
  if (asked == given.quantities.end()) return;
  probe.held = probe.nodes;
  for (const Index n : probe.nodes)  // what holds a rigid body holds its four nodes
    if (const Embedding::Follower* follower = simulation_.model().embedding.find(n))
      probe.held.insert(probe.held.end(), follower->carrier.begin(), follower->carrier.end());
  std::sort(probe.held.begin(), probe.held.end());
  const auto is_held = [&](const PrescribedDof& p) {
    return std::binary_search(probe.held.begin(), probe.held.end(), p.dof / 3);
  };
  const bool any = std::ranges::any_of(simulation_.stages(), [&](const auto& stage) {
    return std::ranges::any_of(stage->supports().prescribed(), is_held);
  });
  if (any) return;
  throw CaseError(asked->where, "probe.quantities",
                  fmt::format("\"{}\" of \"{}\", of which no node is held or moved", **asked, *given.name),
                  "nodes that a [[support]] holds or moves");
}

void ProbeCurves::add_columns(const CaseProbe& given, Probe& probe) {
  for (const Located<std::string>& quantity : given.quantities) {
    const Quantity* found = find_quantity(*quantity);
    if ((found == nullptr || is_field(*found)) && !field_kind(simulation_, *quantity))
      throw CaseError(quantity.where, "probe.quantities",
                      fmt::format("\"{}\", which this case does not have", *quantity),
                      "fields of contact where there is one, what laws remember where one does");
    add_heads(*quantity, *given.name, probe.columns);
  }
  table_.columns.insert(table_.columns.end(), probe.columns.begin(), probe.columns.end());
}

void ProbeCurves::complete(const StepView& view) const {
  if (!view.shared.is_partial()) return;
  std::vector<Index> nodes;
  for (const Probe& probe : probes_)
    for (const std::string& quantity : probe.quantities) {
      const bool is_of_nodes = quantity == "displacement" || quantity == "velocity" || quantity == "acceleration";
      if (PartSums::is_known_to_all(quantity)) continue;
      if (!is_of_nodes && quantity != "reaction" && quantity != "reaction_moment") return view.shared.collect();
      if (is_of_nodes) nodes.insert(nodes.end(), probe.nodes.begin(), probe.nodes.end());
    }
  if (!nodes.empty()) view.shared.complete(nodes);
}

void ProbeCurves::sample(FieldsNow& now) {
  table_.row = {now.view.state.t};
  for (const Probe& probe : probes_)
    for (const std::string& quantity : probe.quantities) append(quantity, probe, now);
}

void ProbeCurves::append(const std::string& quantity, const Probe& probe, FieldsNow& now) {
  using Value = Vec3 (ProbeCurves::*)(const Probe&, const StepView&);
  static constexpr std::pair<std::string_view, Value> own[]{{"section_force", &ProbeCurves::section_force},
                                                            {"reaction", &ProbeCurves::reaction_force},
                                                            {"reaction_moment", &ProbeCurves::reaction_moment},
                                                            {"local_acceleration", &ProbeCurves::local_acceleration}};
  const Quantity* found = find_quantity(quantity);
  if (found != nullptr && found->place == Place::part) return probe.part.append(quantity, now, table_.row);
  for (const auto& [name, value] : own) {
    if (name != quantity) continue;
    const Vec3 v = (this->*value)(probe, now.view);
    table_.row.insert(table_.row.end(), v.begin(), v.end());
    return;
  }
  append_mean(quantity, probe, now);
}

void ProbeCurves::append_mean(const std::string& field, const Probe& probe, FieldsNow& now) {
  const FieldKind kind = *field_kind(simulation_, field);
  const FieldValues all = now.evaluate(field);
  const std::vector<Index>& where = kind.is_at_nodes() ? probe.nodes : probe.cells;
  const std::size_t count = components(kind.form);
  for (std::size_t c = 0; c < count; ++c) {
    double sum = 0.0;
    for (const Index k : where) sum += all.values[count * at(k) + c];
    table_.row.push_back(sum / static_cast<double>(where.size()));
  }
}

Vec3 ProbeCurves::section_force(const Probe& probe, const StepView& view) {
  section_work_.assign(view.state.q.size(), 0.0);
  simulation_.solid().add_internal_force_of(probe.section_cells, view.state.q, section_work_, view.points());
  Vec3 gravity{}, sum{};
  for (const Gravity& field : gravity_) gravity = add(gravity, scaled(field.acceleration, field.factor(view.state.t)));
  for (const Index n : probe.nodes) sum = subtract(sum, vector_at(section_work_, at(n)));
  const bool is_static = !has_inertia(view.stage.settings().kind);
  for (const NodeMass& share : probe.section_mass.of(view.stage.mass().kind())) {
    const Vec3 a = is_static ? Vec3{} : vector_at(view.state.a, at(share.node));
    sum = subtract(sum, scaled(subtract(a, gravity), share.mass));
  }
  return sum;
}

Wrench ProbeCurves::reaction(const Probe& probe, const StepView& view) const {
  Wrench sum;
  const std::vector<PrescribedDof>& prescribed = view.stage.supports().prescribed();
  for (std::size_t k = 0; k < prescribed.size(); ++k) {
    const Index node = prescribed[k].dof / 3;
    if (!std::binary_search(probe.held.begin(), probe.held.end(), node)) continue;
    Vec3 force{};
    force[at(prescribed[k].dof % 3)] = view.forces.supports[k].reaction;
    const Vec3 x = add(simulation_.mesh().coordinates[at(node)], vector_at(view.state.q, at(node)));
    sum.force = add(sum.force, force);
    sum.moment = add(sum.moment, cross(subtract(x, probe.position), force));
  }
  return sum;
}

Vec3 ProbeCurves::local_acceleration(const Probe& probe, const StepView& view) {
  Vec3 mean{};
  for (const Index n : probe.nodes)
    mean = add(mean, scaled(vector_at(view.state.a, at(n)), 1.0 / static_cast<double>(probe.nodes.size())));
  return along(probe.axes.at(view.state.q, view.state.alive()), mean);
}

}  // namespace carom
