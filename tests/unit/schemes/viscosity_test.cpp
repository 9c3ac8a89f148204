// Artificial viscosity in time: the decay of a standing wave, and the step at which explicit schemes stay stable.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "schemes/scheme_table.hpp"
#include "schemes_explicit_fixture.hpp"

namespace carom::schemes_viscosity_test {
namespace {

using namespace test;

constexpr double b_1 = 0.4;

/// A column of cells without Poisson's ratio, guided laterally, its foot held: a bar of linear finite elements.
Model bar(const BarCase& of) {
  Model model = column(of);
  model.contacts.clear();
  model.parts[0].viscosity = {.linear = b_1};
  block(model, "ZMIN", {2});
  return model;
}

State deformed(const Problem& p, const BarCase& of, int half_waves) {
  State state = p.moving({0, 0, 0});
  for (std::size_t n = 0; n < p.mass.node_diagonal().size(); ++n)
    state.q[3 * n + 2] =
        1e-3 * std::sin((half_waves - 0.5) * std::numbers::pi * p.model.mesh->coordinates[n][2] / of.length);
  return state;
}

// The damping of linear bulk viscosity is eta / E times the stiffness, eta = b_1 rho c l: each mode decays by exp(-xi
// omega t), xi = b_1 l omega / (2 c) (Kelvin and Voigt). A mode of N linear elements of lumped mass has omega = 2 c / l
// sin((k - 1/2) pi / (2 N)), of consistent mass that over (1 - 2/3 sin^2)^(1/2). The rate is that of the step, whose
// middle is half a step before: an error of first order.
TEST(BulkViscosity, DampsStandingWavesAsKelvinAndVoigtDo) {
  const BarCase of{.length = 10.0, .edge = 2.0, .cells = 8};  // cells are longest across
  constexpr int half_waves = 3;
  const double c = of.wave_speed(), l = of.length / of.cells;
  const double s = std::sin((half_waves - 0.5) * std::numbers::pi / (2 * of.cells));
  for (const MassKind kind : {MassKind::lumped, MassKind::consistent}) {
    const Problem p(bar(of), kind);
    const double omega = 2.0 * c / l * s / (kind == MassKind::lumped ? 1.0 : std::sqrt(1.0 - 2.0 / 3.0 * s * s));
    const double xi = 0.5 * b_1 * l * omega / c;
    const double period = 2.0 * std::numbers::pi / (omega * std::sqrt(1.0 - xi * xi));
    double error[2];
    for (const int refined : {0, 1}) {
      const int n = refined == 0 ? 200 : 400;
      const double h = period / n;
      const auto scheme = kind == MassKind::lumped ? central(p) : newmark(p, h);
      const State begin = deformed(p, of, half_waves);
      const History end = march(*scheme, begin, h, n);
      ASSERT_TRUE(end.converged) << end.failure;
      EXPECT_LT(end.imbalance, 1e-12 * end.ledger.scale());
      EXPECT_GT(end.ledger.now().viscous, 0.5 * end.ledger.scale());
      const std::size_t top = 3 * p.model.mesh->nodes_of("ZMAX")[0] + 2;
      error[refined] = end.state.q[top] / begin.q[top] / std::exp(-xi * omega * period) - 1.0;
    }
    EXPECT_LT(std::abs(error[1]), 0.02);
    EXPECT_NEAR(error[0] / error[1], 2.0, 0.1) << "first order";
  }
}

// With the rate of the step's middle central differences are stable up to h = 2 / omega ((1 + xi^2)^(1/2) - xi) of the
// highest mode, which the program's bound is not above: it knows of no guides, so that cells swell in all directions.
TEST(StableStep, CountsBulkViscosity) {
  const BarCase of{.length = 10.0, .edge = 2.0, .cells = 8};
  const Problem p(bar(of), MassKind::lumped);
  const double s = std::sin((of.cells - 0.5) * std::numbers::pi / (2 * of.cells)), xi = b_1 * s;
  const double omega = 2.0 * of.wave_speed() / (of.length / of.cells) * s;
  const double limit = 2.0 / omega * (std::sqrt(1.0 + xi * xi) - xi);
  const auto growth = [&](double h) {
    const auto scheme = central(p);
    const History end = march(*scheme, deformed(p, of, of.cells), h, 400);
    double largest = 0.0;
    for (const double q : end.state.q) largest = std::max(largest, std::abs(q));
    return largest / 1e-3;
  };
  EXPECT_LT(growth(0.99 * limit), 1.0);
  EXPECT_GT(growth(1.02 * limit), 10.0);
  const double dt = stable_step(p.system, 2.0, EnforcementKind::lagrange).dt;
  EXPECT_LE(dt, limit);
  EXPECT_GE(dt, 0.5 * limit);
}

// Statics knows no rates of its own: a bar that is pulled ends where it does without viscosity, and loses nothing.
TEST(BulkViscosity, RestsInStatics) {
  const BarCase of{.length = 10.0, .edge = 2.0, .cells = 8};
  State ends[2];
  for (const bool is_viscous : {false, true}) {
    Model model = bar(of);
    if (!is_viscous) model.parts[0].viscosity = {};
    model.motions.push_back(
        {"pull", model.mesh->nodes_of("ZMAX"), 2, MotionKind::displacement, {{0.0, 1.0}, {0.0, 1e-3}}});
    const Problem p(std::move(model));
    const SchemeSettings settings{.kind = SchemeKind::statics};
    const auto scheme = make_scheme({p.system, settings, 0.1, stable_step(p.system).omega_max_squared});
    const History end = march(*scheme, p.moving({0, 0, 0}), 0.1, 3);
    ASSERT_TRUE(end.converged) << end.failure;
    EXPECT_EQ(end.ledger.now().viscous, 0.0);
    ends[is_viscous ? 1 : 0] = end.state;
  }
  ASSERT_GT(ends[0].forces.stored.strain, 0.0);
  EXPECT_NEAR(ends[1].forces.stored.strain, ends[0].forces.stored.strain, 1e-12 * ends[0].forces.stored.strain);
}

}  // namespace
}  // namespace carom::schemes_viscosity_test
