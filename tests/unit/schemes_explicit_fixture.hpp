// Bars on a rigid floor for the explicit schemes, and what is measured on them.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "schemes/central_differences.hpp"
#include "schemes/semi_explicit.hpp"
#include "schemes_fixture.hpp"
#include "solid/modified_mass.hpp"

namespace carom::test {

/// A problem with the modified mass.
struct ModifiedProblem {
  explicit ModifiedProblem(Model given, const MassModification& how = {}, Isa isa = chosen_isa())
      : model(std::move(given)),
        solid(model, isa),
        modified(modify_mass(solid, model, how)),
        contact(model),
        supports(model, Problem::with_mass(solid.mass(MassKind::lumped))),
        system{*model.mesh, solid, modified.mass, contact, supports} {}
  ModifiedProblem(const ModifiedProblem&) = delete;
  ModifiedProblem& operator=(const ModifiedProblem&) = delete;

  Model model;
  Solid solid;
  ModifiedMass modified;
  ContactGeometry contact;
  Supports supports;
  System system;
};

/// A bar of square section as a column of cells guided laterally, its foot a gap above a plane z = -gap.
struct BarCase {
  double length = 10.0, modulus = 900.0, density = 1.0, edge = 1.0;
  int cells = 100;
  double gap = 5.0, speed = 10.0, gravity = 0.0;

  double wave_speed() const { return std::sqrt(modulus / density); }
  /// Step of the Courant number.
  double step(double courant) const { return courant * length / cells / wave_speed(); }
};

inline Model column(const BarCase& bar, double eps_N = 0.0) {
  StructuredBlock block_data;
  block_data.size = {bar.edge, bar.edge, bar.length};
  block_data.divisions = {1, 1, bar.cells};
  const LinearElastic material{{.E = bar.modulus, .nu = 0.0, .rho = bar.density}};
  Model model = one_part(make_structured_blocks({block_data}), material);
  block(model, "BLOCK", {0, 1});
  model.contacts.emplace_back(plane_below(model, bar.gap, eps_N));
  if (bar.gravity != 0.0) model.loads.emplace_back(Gravity{{0, 0, -bar.gravity}, {}});
  return model;
}

inline State falling(const System& system, const BarCase& bar) {
  State state;
  state.q.assign(system.solid.dof_count(), 0.0);
  for (std::size_t i = 0; i < state.q.size(); ++i) state.v.push_back(i % 3 == 2 ? -bar.speed : 0.0);
  state.contact.resize(system.contact.slots());
  return state;
}

/// Any explicit scheme on a bar, built with what it needs.
struct BarScheme {
  std::unique_ptr<Problem> lumped;
  std::unique_ptr<ModifiedProblem> massless_foot;
  std::unique_ptr<Scheme> scheme;

  const System& system() const { return lumped ? lumped->system : massless_foot->system; }
};
using MakeBarScheme = std::function<BarScheme(const BarCase&)>;

template <class Make>
BarScheme lumped_bar(const BarCase& bar, double eps_N, const Make& make) {
  BarScheme out;
  out.lumped = std::make_unique<Problem>(column(bar, eps_N), MassKind::lumped);
  out.scheme = make(out.lumped->system);
  return out;
}

inline BarScheme cd_lagrange_bar(const BarCase& bar) {
  return lumped_bar(bar, 0.0,
                    [](const System& s) { return std::make_unique<CentralDifferences>(s, impulse_contact(s)); });
}
inline BarScheme forward_increment_bar(const BarCase& bar) {
  return lumped_bar(
      bar, 0.0, [](const System& s) { return std::make_unique<CentralDifferences>(s, forward_increment_contact(s)); });
}
inline BarScheme modified_mass_bar(const BarCase& bar, const MassModification& how = {}) {
  BarScheme out;
  out.massless_foot = std::make_unique<ModifiedProblem>(column(bar), how);
  out.scheme = std::make_unique<SemiExplicit>(out.massless_foot->system);
  return out;
}

/// What a run on a bar gives, with the exact force on the floor beside it.
struct BarMeasures {
  bool converged = true;
  double force_error = 0.0;     ///< |F - exact| / |exact| in L2 over the run
  double peak = 0.0;            ///< largest force
  double energy = 0.0;          ///< at the end over at the start, potential energy included
  double kinetic = 0.0;         ///< at the end over at the start
  double penetration = 0.0;     ///< largest, length
  double centre_speed = 0.0;    ///< at the end
  double velocity_error = 0.0;  ///< mean |v - exact| over elements' middles and half steps, over the speed
  double imbalance = 0.0;       ///< largest, over the energy
  double impact = 0.0, algorithmic = 0.0, quadrature = 0.0;  ///< at the end, over the energy
};

inline double floor_force(const State& state) {
  double sum = 0.0;
  for (const Vec3& f : state.forces.rows.force) sum += f[0];
  return sum;
}

using ExactForce = std::function<double(double t)>;
using ExactVelocity = std::function<double(double z, double t)>;

inline BarMeasures measure(const BarScheme& s, const BarCase& bar, double h, int steps, const ExactForce& exact,
                           const ExactVelocity& velocity = {}) {
  const System& system = s.system();
  const std::size_t layers = static_cast<std::size_t>(bar.cells) + 1;
  BarMeasures out;
  double squares = 0.0, exact_squares = 0.0, velocity_sum = 0.0;
  State before;
  std::vector<double> first;
  const auto observe = [&](const State& state) {
    const double force = floor_force(state), wanted = exact(state.t);
    squares += (force - wanted) * (force - wanted);
    exact_squares += wanted * wanted;
    out.peak = std::max(out.peak, force);
    out.penetration = std::max(out.penetration, -state.q[2] - bar.gap);
    if (velocity && !before.q.empty()) {
      for (std::size_t k = 0; k + 1 < layers; ++k) {
        const std::size_t a = 3 * (4 * k) + 2, b = 3 * (4 * (k + 1)) + 2;
        const double v = 0.5 * (state.q[a] - before.q[a] + state.q[b] - before.q[b]) / h;
        const double z = (static_cast<double>(k) + 0.5) * bar.length / bar.cells;
        velocity_sum += std::abs(v - velocity(z, state.t - 0.5 * h));
      }
    }
    before = state;
  };
  const State begin = falling(system, bar);
  const History run = march(*s.scheme, begin, h, steps, observe);
  const EnergyTerms now = run.ledger.now();
  const double energy = run.ledger.initial().kinetic > 0.0
                            ? run.ledger.initial().mechanical()
                            : bar.density * bar.length * bar.edge * bar.edge * bar.gravity * bar.gap;
  out.converged = run.converged;
  out.force_error = std::sqrt(squares / exact_squares);
  out.energy = (energy + run.ledger.growth()) / energy;
  out.kinetic = now.kinetic / energy;
  out.centre_speed = run.state.forces.total_momentum.linear[2] / (bar.density * bar.length * bar.edge * bar.edge);
  out.velocity_error = velocity_sum / (static_cast<double>(steps) * bar.cells * bar.speed);
  out.imbalance = run.imbalance / energy;
  out.impact = now.impact / energy;
  out.algorithmic = now.algorithmic / energy;
  out.quadrature = now.quadrature / energy;
  return out;
}

}  // namespace carom::test
