#include "build/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "build/torn_ties.hpp"
#include "parallel/threads.hpp"
#include "solid/mass_scaling.hpp"
#include "solid/modified_mass.hpp"
#include "solid/stability.hpp"
#include "surface/facing_facets.hpp"
#include "system/free_modes.hpp"

namespace carom {

namespace {

SchemeSettings settings_of(const CaseScheme& given, const CaseSolver& solver) {
  return {.kind = *given.kind,
          .parameters = given.parameters,
          .enforcement = **given.enforcement,
          .max_iterations = solver.max_contact_iterations,
          .penetration = given.penetration.value_or(SchemeSettings{}.penetration),
          .solver = solver.kind};
}

Mass make_scaled_mass(const StageContext& context, const CaseScheme& scheme, const SchemeSettings& settings,
                      Stage::MassNotes& notes) {
  const double omega = stability_limit(settings) / **scheme.mass_scaling_step;
  const std::vector<double> factors = mass_factors(context.solid, omega * omega);
  const MassGain gain = mass_gain(context.solid, factors);
  const std::string what = describe(gain, context.solid, context.mesh);
  if (gain.share() > *scheme.mass_scaling_limit) {
    throw CaseError(
        scheme.mass_scaling_step->where, "scheme.mass_scaling_step",
        fmt::format("a step of {:.6g}, for which {}", **scheme.mass_scaling_step, what),
        fmt::format("at most {:.4g} % of added mass (mass_scaling_limit)", 100.0 * *scheme.mass_scaling_limit),
        "Lower the step, mend the mesh where the worst cells are, or raise the limit if the added inertia "
        "does no harm there.");
  }
  notes.added = gain.added;
  notes.added_share = gain.share();
  notes.lines.push_back("mass scaling: " + what);
  return context.solid.lumped_mass(factors);
}

/// Nodes without inertia on a body that flows: nothing bounds their speed (docs/taylor_bar.md).
void refuse_massless_flow(const StageContext& context, const CaseScheme& scheme, const Mass& modified) {
  const Mass lumped = context.solid.mass(MassKind::lumped);
  const auto gives = [&](Index n) {
    const auto i = static_cast<std::size_t>(n);
    return lumped.node_diagonal()[i] > 0.0 && modified.node_diagonal()[i] == 0.0;
  };
  for (const Part& part : context.model.parts) {
    if (part.material.law->history.empty()) continue;
    const CellBlock& block = *context.mesh.block(part.type);
    const auto gives_any = [&](Index cell) {
      const std::span<const Index> nodes = block.nodes(cell);
      return std::any_of(nodes.begin(), nodes.end(), gives);
    };
    if (std::none_of(part.cells.begin(), part.cells.end(), gives_any)) continue;
    throw CaseError(
        scheme.mass->where, "scheme.mass",
        fmt::format("a modified mass, which takes the inertia of contact nodes, where part \"{}\" yields ({})",
                    part.name, part.material.law->name),
        "contact nodes of bodies that do not yield, for nothing else resists those nodes in a flow: a bar's "
        "foot spreads 10 % too far",
        "Choose a scheme with a lumped mass, such as cd_lagrange or central_differences.");
  }
}

Mass make_mass(const StageContext& context, const CaseScheme& scheme, const SchemeSettings& settings,
               Stage::MassNotes& notes) {
  if (scheme.mass_scaling_step) return make_scaled_mass(context, scheme, settings, notes);
  if (**scheme.mass == CaseScheme::Mass::modified) {
    MassModification how;
    if (*scheme.redistribution == CaseScheme::Redistribution::least_squares)
      how.spread = MassSpread::least_squares;
    else
      how.layers = *scheme.layers;
    try {
      ModifiedMass modified = modify_mass(context.solid, with_facing_facets(context.model), how);
      if (has_inertia(settings.kind)) {
        refuse_massless_flow(context, scheme, modified.mass);
        notes.lines = describe(modified.shift);
        notes.moved_share = modified.shift.moved / modified.shift.total;
      }
      return std::move(modified.mass);
    } catch (const std::invalid_argument& e) {
      throw CaseError(scheme.mass->where, "scheme.mass", e.what(),
                      "a body with more layers of cells than its contact surface");
    }
  }
  return context.solid.mass(**scheme.mass == CaseScheme::Mass::consistent ? MassKind::consistent : MassKind::lumped);
}

/// The nodes of the bodies: those that carry mass before contact nodes give theirs away.
std::vector<bool> body_nodes(const StageContext& context) {
  const Mass lumped = context.solid.mass(MassKind::lumped);
  std::vector<bool> has_mass;
  for (const double m : lumped.node_diagonal()) has_mass.push_back(m > 0.0);
  return has_mass;
}

Supports make_supports(const StageContext& context, const Model& model, const std::vector<bool>& has_mass) {
  const Case& given = context.given;
  try {
    return {model, has_mass};
  } catch (const std::invalid_argument& e) {
    throw CaseError(given.supports.empty() ? Location{given.file} : given.supports.front().where, "support", e.what(),
                    "");
  }
}

/// Flags of the nodes that touch something at the start, where there is a weight to rest on it.
std::vector<bool> resting_nodes(const StageContext& context) {
  std::vector<bool> resting(context.mesh.node_count());
  const std::vector<Load>& loads = context.model.loads;
  const auto is_weight = [](const Load& load) { return std::holds_alternative<Gravity>(load); };
  if (std::none_of(loads.begin(), loads.end(), is_weight)) return resting;
  const std::vector<double> zero(context.solid.dof_count(), 0.0);
  const std::shared_ptr<const ConstraintRows> rows = context.contact.rows_at(zero, zero);
  for (std::size_t r = 0; r < rows->size(); ++r) {
    if (!rows->is_closed(r, zero)) continue;
    for (auto k = static_cast<std::size_t>(rows->begin[r]); k < static_cast<std::size_t>(rows->begin[r + 1]); ++k)
      resting[static_cast<std::size_t>(rows->node[k])] = true;
  }
  return resting;
}

/// Flags of the nodes that forces or pressures act on.
std::vector<bool> loaded_nodes(const Model& model) {
  std::vector<bool> loaded(model.mesh->node_count());
  const auto mark = [&loaded](Index n) {
    if (n >= 0) loaded[static_cast<std::size_t>(n)] = true;
  };
  for (const Load& load : model.loads) {
    if (const auto* force = std::get_if<NodalForce>(&load))
      std::for_each(force->nodes.begin(), force->nodes.end(), mark);
    if (const auto* pressure = std::get_if<Pressure>(&load))
      for (const Facet& facet : pressure->surface.facets) std::for_each(facet.begin(), facet.end(), mark);
  }
  return loaded;
}

}  // namespace

Stage::Stage(const StageContext& context, const CaseScheme& scheme, const CaseTime& time, double begin,
             const std::vector<bool>& later_velocity)
    : context_(context),
      scheme_(scheme),
      time_(time),
      begin_(begin),
      settings_(settings_of(scheme, context.given.solver)),
      mass_(make_mass(context, scheme, settings_, notes_)),
      has_mass_(body_nodes(context)),
      supports_(make_supports(context, context.model, has_mass_)),
      system_{context.mesh, context.solid, mass_, context.contact, supports_},
      rest_(system_) {
  if (!has_inertia(settings_.kind)) {
    hold_bodies_in_flight(later_velocity);
    if (context.contact.bonds().size() > 0)
      refuse_floating_ties(context.given, context.model, context.contact, settings_.enforcement,
                           FreeModes(system_).free_bodies(), context.mesh.node_count());
  }
  refuse_massless_contact();
  refuse_driven_bonds();
  refuse_history();
  refuse_laws_without_tangent();
  choose_step();
  refuse_loads_without_hold();
}

/// Without inertia nothing keeps a body in the air. Its weight alone is a load only where it rests on something.
void Stage::hold_bodies_in_flight(const std::vector<bool>& later_velocity) {
  const std::vector<bool> loaded = loaded_nodes(context_.model), resting = resting_nodes(context_);
  const auto any_of = [](const std::vector<Index>& nodes, const std::vector<bool>& flags) {
    return std::any_of(nodes.begin(), nodes.end(), [&](Index n) { return flags[static_cast<std::size_t>(n)]; });
  };
  Model model = context_.model;
  for (const std::vector<Index>& nodes : FreeModes(system_).free_bodies()) {
    if (!any_of(nodes, later_velocity) || any_of(nodes, loaded) || any_of(nodes, resting)) continue;
    const Vec3& x = context_.mesh.coordinates[static_cast<std::size_t>(nodes.front())];
    notes_.lines.push_back(fmt::format(
        "statics: the body of {} nodes at ({:.4g}, {:.4g}, {:.4g}) has no supports, touches nothing and has a velocity "
        "for later; it stays where it is",
        nodes.size(), x[0], x[1], x[2]));
    for (int c = 0; c < 3; ++c) {
      PrescribedMotion held{"a body in flight", {}, c, MotionKind::velocity, {{0.0}, {0.0}}};
      std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(held.nodes),
                   [&](Index n) { return !supports_.is_prescribed(3 * n + c); });
      model.motions.push_back(std::move(held));
    }
  }
  supports_ = make_supports(context_, model, has_mass_);
}

/// A contact node that belongs to no part and is held by no support has no equation.
void Stage::refuse_massless_contact() const {
  const std::vector<double> zero(context_.solid.dof_count(), 0.0);
  const std::shared_ptr<const ConstraintRows> shared = context_.contact.rows_at(zero, zero);
  const ConstraintRows& rows = *shared;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k) {
      const Index n = rows.node[k];
      if (has_mass_[static_cast<std::size_t>(n)]) continue;
      if (supports_.is_prescribed(3 * n) && supports_.is_prescribed(3 * n + 1) && supports_.is_prescribed(3 * n + 2))
        continue;
      if (rows.source[r] < 0) continue;  // add_equations has looked
      const CaseContact& contact = context_.given.contacts[static_cast<std::size_t>(rows.source[r])];
      throw CaseError(contact.group().where, "contact.group",
                      fmt::format("node {} of \"{}\", which belongs to no part and is not held in x, y and z",
                                  context_.mesh.node_label(n), *contact.group()),
                      "nodes with mass, or supports on all three components",
                      "Put the cells in a [[part]], or block the node by a [[support]].");
    }
  }
}

/// Statics without contact, whose loads push a body where nothing holds it: no step can be made. Contact may close on
/// the way, so that it is asked at every step.
void Stage::refuse_loads_without_hold() const {
  if (has_inertia(settings_.kind) || !context_.model.contacts.empty()) return;
  const FreeModes free(system_);
  if (free.empty()) return;
  std::vector<double> f(context_.solid.dof_count());
  const std::vector<double> zero(f.size(), 0.0);
  for (const double t : {begin_ + dt_, end()}) {
    context_.solid.loads().force(t, mass_, f);
    const std::vector<double> motion = free.unheld({}, {}, zero, f, f);
    if (is_zero(motion)) continue;
    throw CaseError(
        scheme_.where, "scheme.kind",
        "statics, where no support and no contact holds " + free.describe(motion) + ", where the loads push it",
        "bodies that supports hold against their loads", "Add a [[support]], or take a scheme that lets the body fly.");
  }
}

/// Two schemes do not take what hangs on an imposed motion along: u1 = u0 + h v0 + phi h^2 a0 leads elsewhere than the
/// motion does, by (phi - 1/2) h times the velocity; and the nonsmooth scheme parts the forces of bonds into those of
/// the smooth motion and of the jumps, while its supports answer their sum.
void Stage::refuse_driven_bonds() const {
  const SchemeTraits& scheme = traits(settings_.kind);
  if (scheme.takes_driven_bonds) return;
  std::vector<bool> is_driven(context_.solid.dof_count(), false);
  for (const PrescribedDof& p : supports_.prescribed()) {
    const std::vector<double>& values = supports_.motions()[p.motion].function.value;
    is_driven[static_cast<std::size_t>(p.dof)] = !is_zero(values);
  }
  const ConstraintRows& bonds = context_.contact.bonds();
  for (std::size_t r = 0; r < bonds.size(); ++r) {
    if (!any_dof(bonds, r, [&](std::size_t dof) { return is_driven[dof]; })) continue;
    throw CaseError(scheme_.kind.where, "scheme.kind",
                    fmt::format("\"{}\" with {}, on which a support imposes a motion", scheme.name,
                                context_.contact.describe(bonds, r)),
                    "a scheme that takes what hangs on an imposed motion along with it, or a support that holds",
                    "Take another scheme, as \"central_differences\" or \"generalized_alpha\".");
  }
}

/// A scheme that steps between stored energies has no force for what is not stored.
void Stage::refuse_history() const {
  const SchemeTraits& scheme = traits(settings_.kind);
  if (scheme.takes_history) return;
  if (!context_.model.cohesive.empty())
    throw CaseError(scheme_.kind.where, "scheme.kind",
                    fmt::format("\"{}\" with \"{}\", a tie that tears, and so dissipates", scheme.name,
                                context_.model.cohesive.front().name),
                    "a tie without strength with this scheme, whose forces are those of a stored energy",
                    "Take a scheme of another kind, as \"generalized_alpha\" or \"bathe\", or leave the strength out.");
  for (const Part& part : context_.model.parts) {
    if (part.distortion_control > 0.0)
      throw CaseError(scheme_.kind.where, "scheme.kind",
                      fmt::format("\"{}\" with distortion_control of the part \"{}\"", scheme.name, part.name),
                      "parts without distortion_control with this scheme, which has no force between two places of a "
                      "corner",
                      "Take a scheme of another kind, as \"generalized_alpha\" or \"bathe\", or leave it out.");
    if (!part.remembers()) continue;
    const std::string what = part.viscosity.is_any() ? "the viscosity" : "the law \"" + part.material.law->name + '"';
    throw CaseError(
        scheme_.kind.where, "scheme.kind",
        fmt::format("\"{}\" with {} of the part \"{}\"", scheme.name, what, part.name),
        "elastic laws without viscosity with this scheme, whose forces are those of a stored energy",
        "Take a scheme of another kind, as \"generalized_alpha\" or \"bathe\", or elastic laws without viscosity.");
  }
}

/// Schemes that solve for displacements need the tangent of every law.
void Stage::refuse_laws_without_tangent() const {
  if (is_explicit(settings_.kind) && !has_massless_contact(settings_.kind)) return;
  for (const Part& part : context_.model.parts)
    if (!part.material.law->has_tangent)
      throw CaseError(scheme_.kind.where, "scheme.kind",
                      fmt::format("\"{}\" with the law \"{}\" of the part \"{}\", which gives no tangent",
                                  traits(settings_.kind).name, part.material.law->name, part.name),
                      "an explicit scheme with lumped masses, such as \"central_differences\"",
                      "Or give the law a tangent (docs/user_laws.md).");
}

/// The step that the program chooses; a hundredth of the stage where nothing vibrates.
double Stage::chosen_step(const StableStep& stable) const {
  double step = time_.safety * stable.advised();
  if (driven_.count > 0)
    step = std::min({step, driven_.dt_strain,
                     time_.safety * stable_step_of(stability_limit(settings_), driven_.omega_max_squared)});
  return std::isfinite(step) ? step : 0.01 * (end() - begin_);
}

void Stage::choose_step() {
  const double length = end() - begin_;
  const bool explicit_steps = is_explicit(settings_.kind);
  double wanted = explicit_steps ? 0.0 : **time_.step, stable_dt = std::numeric_limits<double>::infinity();
  if (explicit_steps) {
    const StableStep stable = contact_step(rest_, stability_limit(settings_), settings_.enforcement);
    stable_dt = stable.dt;
    driven_ = driven_cells(system_, begin_, end());
    wanted = time_.step ? **time_.step : chosen_step(stable);
    if (wanted > stable.dt) {
      throw CaseError(time_.step->where, "time.step", fmt::format("{:.6g}", wanted),
                      fmt::format("at most the stable step {:.6g} (contact included; {:.6g} without)", stable.dt,
                                  this->stable().dt_free),
                      "Lower the step, or leave it out to have it chosen.");
    }
  }
  const double count = length / wanted;
  if (!(count < 1e13)) {
    throw CaseError(time_.where, "time", fmt::format("{:.3g} steps to the end", count), "fewer than 1e13");
  }
  steps_ = std::max(1LL, static_cast<long long>(std::ceil(count * (1.0 - 1e-9))));
  if (time_.fixed && std::abs(count - static_cast<double>(steps_)) > 1e-6) {
    throw CaseError(time_.end.where, "time.end", fmt::format("{:.9g} steps of {:.6g} to {:.6g}", count, wanted, end()),
                    "a whole number of steps, since the step is fixed",
                    "Change end or step, or leave out fixed = true.");
  }
  // Keep the user's own number when it divides the end; its multiples are then the times of the steps.
  dt_ = std::abs(count - static_cast<double>(steps_)) <= 1e-6 ? wanted : length / static_cast<double>(steps_);
  if (explicit_steps) {
    reversible_energy_ = 1.0 / std::max(1e-3, 1.0 - std::pow(dt_ / stable_dt, 2));  // finite also at the limit
  } else {
    const bool may_grow = std::isfinite(stability_limit(settings_));
    reversible_energy_ = may_grow ? 0.0 : 1.0;
  }
}

StableStep Stage::stable() const {
  return stable_step(rest_, stability_limit(settings_), settings_.enforcement);
}

StableStep Stage::stable(double limit, EnforcementKind enforcement) const {
  return stable_step(rest_, limit, enforcement);
}

bool Stage::stable_step_changes() const {
  return is_explicit(settings_.kind) && (!context_.solid.is_linear() || !context_.contact.is_fixed());
}

StableStepWatch Stage::watch_stable_step() const {
  return {rest_, stability_limit(settings_), settings_.enforcement};
}

std::unique_ptr<Scheme> Stage::make_scheme() const {
  const double bound = is_explicit(settings_.kind) ? infinity : largest_frequency_bound(context_.solid);
  return carom::make_scheme({system_, settings_, dt_, bound});
}

std::string Stage::name() const {
  static constexpr const char* masses[] = {"consistent", "lumped", "modified"};
  return fmt::format("{}, {} mass", describe(settings_), masses[static_cast<int>(**scheme_.mass)]);
}

}  // namespace carom
