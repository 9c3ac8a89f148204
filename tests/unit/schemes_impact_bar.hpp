// The impact bar (Doyen, Ern and Piperno, SIAM J. Sci. Comput. 33(1), 2011) as a column of HEXA8 that is
// one-dimensional.
#pragma once

#include <string>

#include "schemes_fixture.hpp"

namespace carom::test {

/// L = 10, E = 900, rho = 1 (c = 30), unit section, speed 10, gap 5. Exact: the wall is touched at 0.5 and answers with
/// 300 until 0.5 + 2/3; then rigid motion at +10.
struct ImpactBar {
  static constexpr double length = 10.0, speed = 10.0, gap = 5.0, wave_speed = 30.0;
  static constexpr double touch = gap / speed, release = touch + 2.0 * length / wave_speed, force = 300.0;

  static Model model(int cells, const ContactLaw& law = {}) {
    StructuredBlock block_shape;
    block_shape.size = {1.0, 1.0, length};
    block_shape.divisions = {1, 1, cells};
    Model model = one_part(make_structured_blocks({block_shape}), LinearElastic{{.E = 900.0, .nu = 0.0, .rho = 1.0}});
    block(model, "BLOCK", {0, 1});
    ObstacleContact wall = plane_below(model, gap, 0.0);
    wall.law = law;
    model.contacts.emplace_back(wall);
    return model;
  }
};

struct ImpactBarRun {
  double error = 0.0;        ///< relative L2 error of the contact force in time
  double peak = 0.0;         ///< largest contact force over the exact one
  double energy = 0.0;       ///< mechanical energy at the end over the initial one
  double penetration = 0.0;  ///< largest, over the length
  double imbalance = 0.0;    ///< largest, over the initial energy
  double momentum_error = 0.0;
  double largest_energy = 0.0;  ///< over the initial one
  bool converged = false;
};

/// Runs until well after the rebound, at t = 1.5. The force is sampled at the ends of the steps.
inline ImpactBarRun run_impact_bar(const Problem& p, Scheme& scheme, double h) {
  ImpactBarRun out;
  const double weight = p.mass.total() * ImpactBar::speed;
  double square = 0.0, exact_square = 0.0, initial = 0.0, energy = 0.0;
  const auto observe = [&](const State& state) {
    const Forces& forces = state.forces;
    double wall = 0.0;
    for (std::size_t i = 2; i < forces.contact.size(); i += 3) wall += forces.contact[i];
    const double exact = state.t > ImpactBar::touch && state.t < ImpactBar::release ? ImpactBar::force : 0.0;
    square += (wall - exact) * (wall - exact);
    exact_square += exact * exact;
    out.peak = std::max(out.peak, wall / ImpactBar::force);
    const ConstraintRows& rows = *forces.rows.rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      out.penetration = std::max(out.penetration, -rows.gap_at(r, state.q) / ImpactBar::length);
    }
    energy = forces.stored.mechanical();
    if (initial == 0.0) initial = energy;
    out.largest_energy = std::max(out.largest_energy, energy / initial);
  };
  const int n = static_cast<int>(1.5 / h);
  const History run = march(scheme, p.moving({0, 0, -ImpactBar::speed}), h, n, observe);
  out.converged = run.converged;
  out.error = std::sqrt(square / exact_square);
  out.energy = energy / initial;
  out.imbalance = run.imbalance / initial;
  out.momentum_error = run.linear_momentum_error / weight;
  return out;
}

}  // namespace carom::test
