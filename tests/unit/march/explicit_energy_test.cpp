// Explicit runs with springs of contact at default settings: no energy from chatter, and the right force.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "march/energy_guard.hpp"
#include "run_fixture.hpp"

namespace carom::run_explicit_energy_test {
namespace {

using namespace test;

struct TwoBars {
  double young, density;  ///< of the bar that is hit, 3 x the length of the other; c = 5092 in both
};

/// Bars of 3 x 3 and 2 x 2 cells of 10 mm, 0.25 m and 0.75 m long; the first flies at 3 m/s.
std::string two_bars_case(const TwoBars& bars) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
origin = [0.0, 0.0, -0.25]
size = [0.05, 0.05, 0.25]
divisions = [3, 3, 25]
groups = {{ cells = "LEFT", zmax = "LFACE" }}
[[mesh.block]]
origin = [0.0, 0.0, 2e-05]
size = [0.05, 0.05, 0.75]
divisions = [2, 2, 75]
groups = {{ cells = "RIGHT", zmin = "RFACE" }}
[materials.one]
law = "linear_elastic"
E = 7e10
nu = 0.0
rho = 2700.0
[materials.two]
law = "linear_elastic"
E = {}
nu = 0.0
rho = {}
[[part]]
name = "left"
cells = "LEFT"
material = "one"
[[part]]
name = "right"
cells = "RIGHT"
material = "two"
[[initial]]
part = "left"
velocity = [0.0, 0.0, 3.0]
[[contact]]
name = "faces"
kind = "pair"
group = "RFACE"
master = "LFACE"
method = "two_pass"
[scheme]
kind = "central_differences"
[time]
end = 3.0e-4
[output]
fields = []
[[probe]]
name = "right"
group = "RFACE"
quantities = ["velocity"]
)",
                     bars.young, bars.density);
}

// The pressure of two bars until the wave comes back from the free end of the shorter one, 2 L / c = 98 us after the
// touch at 7 us, is v Z_1 Z_2 / (Z_1 + Z_2), Z = sqrt(E rho). At the linear stability limit the springs of both passes,
// on faces that do not match, shook the nodes until the energy had grown by 4.4 and by more than 5 %. The mean over the
// plateau is right to the 2 % of its wavy front; the ends of the plateau are left out.
TEST(ExplicitPairs, MakeNoEnergyAndPressRightAtDefaultSettings) {
  for (const TwoBars& bars : {TwoBars{2.1e11, 8100.0}, TwoBars{3.5e10, 1350.0}}) {
    const TemporaryCase one(two_bars_case(bars));
    EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
    const std::string contact = one.result("contact.csv"), energy = one.result("energy.csv");
    const std::vector<double> time = column(contact, "time"), force = column(contact, "faces.force_z"),
                              quadrature = column(energy, "quadrature"), kinetic = column(energy, "kinetic");
    EXPECT_GT(*std::min_element(quadrature.begin(), quadrature.end()), -0.005 * kinetic.front());
    const double Z_1 = std::sqrt(7e10 * 2700.0), Z_2 = std::sqrt(bars.young * bars.density);
    const double exact = 3.0 * Z_1 * Z_2 / (Z_1 + Z_2) * 0.05 * 0.05;
    const std::vector<double> impulse = column(contact, "faces.impulse_z");
    const auto index = [&](double t) {
      return static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), t) - time.begin());
    };
    const std::size_t from = index(2.5e-5), to = index(9.5e-5);
    EXPECT_NEAR(std::abs(impulse[to] - impulse[from]) / (time[to] - time[from]), exact, 0.02 * exact);
    const auto [least, most] = std::minmax_element(force.begin(), force.end());
    const double largest = std::max(-*least, *most);
    EXPECT_LT(largest, 1.8 * exact);  // the first force overshoots by half, at any step
  }
}

// A rigid ball at half the wave speed of a gelatine block: in the ten steps between two looks at the stable step the
// cells below it were crushed flat, and a spring of one slope let the ball in by 1.5 cells. Energy books of the whole
// run, lent included, within the verdict's limits.
TEST(SoftBodies, AreCrushedAtDefaultSettings) {
  const TemporaryCase one(R"(
[[mesh.block]]
origin = [-0.05, -0.05, 0.0]
size = [0.1, 0.1, 0.1]
divisions = [8, 8, 8]
groups = { cells = "GEL", zmin = "FOOT", zmax = "TOP" }
[materials.gel]
law = "neo_hookean"
E = 1.0e5
nu = 0.45
rho = 1000.0
[[part]]
name = "gel"
cells = "GEL"
material = "gel"
[[support]]
nodes = "FOOT"
blocked = ["x", "y", "z"]
[[contact]]
name = "ball"
kind = "sphere"
group = "TOP"
centre = [0.0, 0.0, 0.151]
radius = 0.05
mass = 0.5
velocity = [0.0, 0.0, -10.0]
[scheme]
kind = "central_differences"
[time]
end = 0.005
[output]
fields = []
)");
  EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
  EXPECT_EQ(one.result("summary.json").find("is soft"), std::string::npos);  // p / M = 0.5, not 0.5 of a cell
  const std::string energy = one.result("energy.csv");
  const std::vector<double> kinetic = column(energy, "kinetic"), strain = column(energy, "strain"),
                            stored = column(energy, "contact_stored");
  for (std::size_t i = 0; i < kinetic.size(); ++i)
    EXPECT_LT(kinetic[i] + strain[i] + stored[i], 1.02 * kinetic.front()) << i;  // lent: 1e-2 a step, halved
}

// ---- EnergyGuard: one row of stiffness 1 along z

struct OneRow {
  ContactResponse response;
  State begin, end;

  OneRow(double gap_begin, double gap_end) {
    ConstraintRows rows;
    rows.add_row(0.0, {0, 0, 1}, {}, 1.0, {1.0, 0.0, 0.0, 0.0, 0.0}, 0);
    rows.add_node(0, 1.0);
    response.rows = std::make_shared<const ConstraintRows>(std::move(rows));
    begin.q = {0, 0, gap_begin};
    end.q = {0, 0, gap_end};
  }
};

TEST(EnergyGuard, EndsStepsAtTheTouchThatMisplaceEnergy) {
  const OneRow closing(1.0, -1.0), opening(-1.0, 3.0);
  EnergyGuard guard;
  // 1/2 |g_0 g_1| <= 1e-4 of the scale 1 within a fifth behind the touch
  const std::optional<double> touch = guard.cut(closing.begin, closing.end, closing.response, {0.5, 0.0, 1.0});
  ASSERT_TRUE(touch);
  EXPECT_GT(*touch, 0.5 * 0.8);
  EXPECT_LT(*touch, 0.5 + 2e-4);
  EXPECT_FALSE(guard.cut(closing.begin, closing.end, closing.response, {0.5, 0.0, 1.0}));  // once
  guard.accept({1e-4, 0.0, 1.0});
  const std::optional<double> part = guard.cut(opening.begin, opening.end, opening.response, {-1.5, 0.0, 1.0});
  ASSERT_TRUE(part);
  EXPECT_LT(*part, 0.25 + 2e-4);
  guard.accept({0.0, 0.0, 1.0});
  EXPECT_FALSE(guard.cut(closing.begin, closing.end, closing.response, {1e-4, 0.0, 1.0}));  // too little to matter
  EXPECT_EQ(guard.share(), 1.0);
}

TEST(EnergyGuard, ShortensTheStepsWhereEnergyIsMade) {
  const OneRow open(1.0, 1.0);
  EnergyGuard guard;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(guard.cut(open.begin, open.end, open.response, {nan, nan, 1.0}), 0.5);
  EXPECT_EQ(guard.cut(open.begin, open.end, open.response, {nan, nan, 1.0}), 0.5);
  EXPECT_EQ(guard.share(), std::sqrt(0.5));  // once for the step, however often it is made again
  guard.accept({0.0, 0.0, 1.0});
  for (int i = 0; i < 6; ++i) guard.accept({-1e-4, 0.0, 1.0});  // 6e-4 > 5e-4 gained
  EXPECT_NEAR(guard.share(), 0.5, 1e-15);
  for (int i = 0; i < 98; ++i) guard.accept({i % 2 == 0 ? -4e-4 : 4e-4, 0.0, 1.0});  // comes and goes
  EXPECT_NEAR(guard.share(), 0.5, 1e-15);
}

// After a hundred steps that hold they grow by 2^(1/4); where that was too far, after twice as many the next time.
TEST(EnergyGuard, LetsStepsGrowAgain) {
  EnergyGuard guard;
  const auto steps_until = [&guard](double share) {
    int steps = 0;
    while (guard.share() < share - 1e-12 && steps < 1000) {
      guard.accept({0.0, 0.0, 1.0});
      ++steps;
    }
    return steps;
  };
  guard.accept({-6e-4, 0.0, 1.0});
  EXPECT_NEAR(guard.share(), std::sqrt(0.5), 1e-15);
  EXPECT_EQ(steps_until(std::exp2(-0.25)), 100);
  EXPECT_EQ(steps_until(1.0), 100);
  guard.accept({-6e-4, 0.0, 1.0});
  EXPECT_EQ(steps_until(std::exp2(-0.25)), 200);
  guard.accept({-6e-4, 0.0, 1.0});
  EXPECT_NEAR(guard.share(), std::exp2(-0.75), 1e-15);
  EXPECT_EQ(steps_until(std::exp2(-0.5)), 400);
}

// A steel block falls on a plane at 2 m/s, or the plane rises to the block, or each comes half of the way: the same
// impact. Bodies at rest have no energy that steps at the touch could be compared with, and the steps became a quarter
// as long for good.
TEST(EnergyGuard, TakesTheSameStepsWhoeverMoves) {
  const auto impact = [](double of_block, double of_plane) {
    const TemporaryCase given(fmt::format(R"(units = "SI"
[[mesh.block]]
origin = [0.0, 0.0, 0.0001]
size = [0.1, 0.1, 0.2]
divisions = [4, 4, 8]
groups = {{ cells = "B", zmin = "FOOT" }}
[materials.steel]
law = "linear_elastic"
E = 2.1e11
nu = 0.3
rho = 7800.0
[[part]]
name = "block"
cells = "B"
material = "steel"
[[initial]]
part = "block"
velocity = [0.0, 0.0, {}]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
velocity = [0.0, 0.0, {}]
[scheme]
kind = "central_differences"
[time]
end = 2.0e-4
[output]
fields = []
)",
                                          of_block, of_plane));
    EXPECT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
    return column(given.result("contact.csv"), "floor.force_z");
  };
  const std::vector<double> falls = impact(-2.0, 0.0), met = impact(0.0, 2.0), both = impact(-1.0, 1.0);
  const double peak = *std::max_element(falls.begin(), falls.end());
  for (const std::vector<double>& other : {met, both}) {
    // A step more or less, where rounding cuts one at the touch.
    EXPECT_NEAR(static_cast<double>(other.size()), static_cast<double>(falls.size()), 2.0);
    EXPECT_NEAR(*std::max_element(other.begin(), other.end()), peak, 1e-3 * peak);
  }
}

// A cube of side 2 with the velocities (y z, 0, 0): a pure hourglass mode, which strains nothing. What kinetic energy
// it loses stands as hourglass energy, to the error of second order of the steps (at most 10 % of the mode's at the
// longest).
TEST(HourglassEnergy, OfALinearBodyIsNotStrain) {
  for (const char* scheme : {"kind = \"central_differences\"\n[time]\nend = 12.0\n",
                             "kind = \"newmark\"\n[time]\nend = 12.0\nstep = 0.05\n"}) {
    const TemporaryCase in(std::string(R"(units = "SI"
[[mesh.block]]
origin = [-1.0, -1.0, -1.0]
size = [2.0, 2.0, 2.0]
divisions = [1, 1, 1]
groups = { cells = "BODY" }
[materials.soft]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "body"
cells = "BODY"
material = "soft"
formulation = "one_point"
[[initial]]
part = "body"
velocity_field = ["0.01 * y * z", "0", "0"]
[scheme]
)") + scheme);
    in.run();
    const auto energy = test::read_csv(in.result("energy.csv"));
    const std::vector<double>&kinetic = energy.at("kinetic"), &hourglass = energy.at("hourglass");
    const double all = kinetic.front();
    EXPECT_GT(*std::max_element(hourglass.begin(), hourglass.end()), 0.5 * all);
    for (std::size_t i = 0; i < kinetic.size(); ++i) {
      EXPECT_NEAR(energy.at("strain")[i], 0.0, 1e-14 * all);
      EXPECT_NEAR(kinetic[i] + hourglass[i], all, 0.1 * all);
    }
  }
}

// Cells that are crushed to a few percent of their height: the plastic part of their hourglass modes goes with them.
// Kept in the metric of the time at which it flowed, it threw cells about until the bar had 29 times its energy.
TEST(ExplicitEnergy, StaysInCellsThatAreCrushedFlat) {
  const TemporaryCase bar(R"(units = "SI"
[[mesh.block]]
size = [3.2e-3, 3.2e-3, 12e-3]
divisions = [3, 3, 8]
groups = { cells = "BAR", zmin = "FOOT" }
[materials.copper]
law = "j2"
E = 1.17e11
nu = 0.35
rho = 8930.0
yield_stress = 4e8
hardening_modulus = 1e8
[[part]]
name = "bar"
cells = "BAR"
material = "copper"
[[initial]]
part = "bar"
velocity = [0.0, 0.0, -400.0]
[[contact]]
name = "wall"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
[scheme]
kind = "central_differences"
enforcement = "impulse"
[time]
end = 3e-5
safety = 0.5
[output]
fields = []
)");
  bar.run();
  const double kinetic = 0.5 * 8930.0 * 3.2e-3 * 3.2e-3 * 12e-3 * 400.0 * 400.0;
  EXPECT_GT(last_row(bar.result("energy.csv")).at("quadrature"), -0.005 * kinetic);  // as much as the verdict lets gain
}

}  // namespace
}  // namespace carom::run_explicit_energy_test
