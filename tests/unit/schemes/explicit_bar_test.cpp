// The explicit schemes with exact contact on bars that hit a rigid floor.
#include <gtest/gtest.h>

#include "exact/bar_impact.hpp"
#include "exact/bouncing_bar.hpp"
#include "schemes_explicit_fixture.hpp"

namespace carom::schemes_explicit_bar_test {
namespace {

using namespace test;

BarScheme four_layers(const BarCase& bar) {
  return modified_mass_bar(bar, {.layers = 4});
}
BarScheme one_layer(const BarCase& bar) {
  return modified_mass_bar(bar, {.layers = 1});
}
BarScheme least_squares(const BarCase& bar) {
  return modified_mass_bar(bar, {.spread = MassSpread::least_squares});
}

void expect_books(const BarMeasures& m) {
  ASSERT_TRUE(m.converged);
  EXPECT_LT(m.imbalance, 1e-10);             // what a case promises (verdict: energy balance)
  EXPECT_LT(std::abs(m.quadrature), 1e-10);  // linear bodies: all the work of the multipliers is booked
  EXPECT_NEAR(m.energy + m.impact + m.algorithmic, 1.0, 1e-10);
}

// The bar of Doyen, Ern and Piperno (SIAM J. Sci. Comput. 33, 2011, section 5): force 300 for 2 L / c, 100 elements,
// Courant 0.9. The numbers are those of independent one-dimensional computations of the same schemes, rounded to the
// digits that they were given with.
struct Reached {
  const char* name;
  MakeBarScheme make;
  double force_error, peak, energy;  ///< at most, at most, at least
};

void PrintTo(const Reached& reached, std::ostream* out) {
  *out << reached.name;
}

struct ImpactBar : testing::TestWithParam<Reached> {};

TEST_P(ImpactBar, ReachesWhatTheSchemeIsKnownToReach) {
  const BarCase bar;
  const BarImpact exact({.length = 10, .modulus = 900, .density = 1, .area = 1, .speed = 10, .gap = 5});
  const double h = bar.step(0.9);
  const BarMeasures m = measure(GetParam().make(bar), bar, h, static_cast<int>(1.5 / h),
                                [&](double t) { return exact.contact_force(t); });
  expect_books(m);
  EXPECT_LE(m.force_error, GetParam().force_error);
  EXPECT_LE(m.peak / 300.0, GetParam().peak);
  EXPECT_GE(m.energy, GetParam().energy);
}

INSTANTIATE_TEST_SUITE_P(, ImpactBar,
                         testing::Values(Reached{"cd_lagrange", cd_lagrange_bar, 0.0485, 1.075, 0.9965},
                                         Reached{"forward_increment", forward_increment_bar, 0.0745, 1.045, 0.9942},
                                         Reached{"one_layer", one_layer, 0.0655, 1.305, 0.9990},
                                         Reached{"four_layers", four_layers, 0.0655, 1.125, 0.9990},
                                         Reached{"least_squares", least_squares, 0.0655, 1.125, 0.9990}),
                         [](const auto& one) { return std::string(one.param.name); });

// No row is ever closed by more than round-off of the displacement (5) with multipliers on the displacement; impulses
// let in what moves in one step (0.03 = speed times step).
TEST(Penetration, IsNoneWithMultipliers) {
  const BarCase bar;
  const double h = bar.step(0.9);
  const auto no_force = [](double) { return 1.0; };
  for (const MakeBarScheme& make : {MakeBarScheme(four_layers), MakeBarScheme(forward_increment_bar)}) {
    EXPECT_LT(measure(make(bar), bar, h, 500, no_force).penetration, 1e-12 * 5.0);
  }
  const double impulse = measure(cd_lagrange_bar(bar), bar, h, 500, no_force).penetration;
  EXPECT_GT(impulse, 1e-4);  // so that the test above can fail
  EXPECT_LT(impulse, 10.0 * h);
}

// SDNV100 of Code_Aster (V5.03.100) with nu = 0 on a rigid wall, its 20 elements, Courant 0.99, the removed mass on
// four layers. The bounds are the project's goal; an independent one-dimensional computation has 3.2 %, 1.105, 0.1 %
// and 99.90 m/s.
TEST(Sdnv100, ModifiedMassMeetsTheGoal) {
  const BarCase bar{
      .length = 0.2, .modulus = 2e11, .density = 8000, .edge = 0.02, .cells = 20, .gap = 2e-3, .speed = 100};
  const BarImpact exact({.length = 0.2, .modulus = 2e11, .density = 8000, .area = 4e-4, .speed = 100, .gap = 2e-3});
  const double h = bar.step(0.99);
  for (const int steps : {70, 71}) {  // 1.386e-4 and 1.4058e-4 s, on both sides of 1.4e-4 s
    const BarMeasures m = measure(
        four_layers(bar), bar, h, steps, [&](double t) { return exact.contact_force(t); },
        [&](double z, double t) { return exact.velocity(z, t); });
    expect_books(m);
    EXPECT_LE(m.velocity_error, 0.0315);  // goal: 0.035
    EXPECT_NEAR(m.centre_speed, 100.0, 0.2);
    EXPECT_GE(m.kinetic, 0.998);
    EXPECT_LE(m.peak / (8000.0 * 5000.0 * 100.0 * 4e-4), 1.11);
  }
}

// Twenty bounces of 8/3 each under gravity 10: the energy may have fallen by at most 0.5 %.
TEST(BouncingBar, KeepsItsEnergyWithTheModifiedMass) {
  const BarCase bar{.speed = 0.0, .gravity = 10.0};
  const double h = bar.step(0.9);
  const BarMeasures m =
      measure(four_layers(bar), bar, h, static_cast<int>(20 * 8.0 / 3.0 / h), [](double) { return 1.0; });
  expect_books(m);
  EXPECT_GE(m.energy, 0.995);
  EXPECT_LE(m.energy, 1.01);  // what the scheme lends to T + V at this step
  EXPECT_LT(m.penetration, 1e-12 * 5.0);
}

// The same bar as a column of 2 x 2 cells: the masses of a layer are in proportion to its nodes', so that plane
// sections stay plane.
TEST(ModifiedMass, GivesTheSameMotionForAnySection) {
  const BarCase bar{.cells = 20};
  Model wide = column(bar);
  StructuredBlock data;
  data.size = {1, 1, 10};
  data.divisions = {2, 2, 20};
  Model fine = one_part(make_structured_blocks({data}), wide.parts[0].material);
  block(fine, "BLOCK", {0, 1});
  fine.contacts.emplace_back(plane_below(fine, bar.gap, 0.0));
  const double h = bar.step(0.9);
  const ModifiedProblem p(std::move(wide)), q(std::move(fine));
  SemiExplicit one(p.system), four(q.system);
  const State a = march(one, falling(p.system, bar), h, 90).state;
  const State b = march(four, falling(q.system, bar), h, 90).state;
  for (std::size_t k = 0; k <= 20; ++k) EXPECT_NEAR(a.v[3 * (4 * k) + 2], b.v[3 * (9 * k + 4) + 2], 1e-8 * 10.0);
}

}  // namespace
}  // namespace carom::schemes_explicit_bar_test
