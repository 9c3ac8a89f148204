// The augmented Lagrangian where constraints nearly depend on each other, and where steps are short.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "run_fixture.hpp"

namespace carom::run_augmented_lagrangian_test {
namespace {

using namespace test;

/// A block of 3^3 cells falls on a free one of 12 x 12 x 4; steps are never halved.
std::string coarse_block_on_fine(const std::string& enforcement, double gap, double step, int steps) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
origin = [0.0, 0.0, -0.03]
size = [0.06, 0.06, 0.03]
divisions = [12, 12, 4]
groups = {{ cells = "LOWER", zmax = "TOP" }}
[[mesh.block]]
origin = [0.0051, 0.0032, {}]
size = [0.05, 0.05, 0.05]
divisions = [3, 3, 3]
groups = {{ cells = "UPPER", zmin = "FACE" }}
[materials.rubber]
law = "linear_elastic"
E = 2e9
nu = 0.3
rho = 1200.0
[[part]]
name = "lower"
cells = "LOWER"
material = "rubber"
[[part]]
name = "upper"
cells = "UPPER"
material = "rubber"
[[initial]]
part = "upper"
velocity = [0.0, 0.0, -2.0]
[[contact]]
name = "touch"
kind = "pair"
group = "TOP"
master = "FACE"
method = "two_pass"
[scheme]
kind = "hht"
enforcement = "{}"
[time]
end = {}
step = {}
fixed = true
[output]
fields = []
)",
                     gap, enforcement, steps * step, step);
}

// By two passes a coarse node presses the fine facet whose nodes press the coarse one: forces that cancel, and whose
// multipliers an iteration changes for ever. No motion hangs on them: the force is that of exact multipliers to the 1 %
// that the augmented Lagrangian promises, at every step.
TEST(AugmentedLagrangian, SettlesWhereConstraintsNearlyDepend) {
  std::vector<std::vector<double>> forces;
  for (const char* enforcement : {"lagrange", "augmented_lagrangian"}) {
    const TemporaryCase given(coarse_block_on_fine(enforcement, 1e-5, 2e-6, 10));
    EXPECT_EQ(given.run(), ExitCode::good) << enforcement;
    forces.push_back(column(given.result("contact.csv"), "touch.force_z"));
  }
  ASSERT_EQ(forces[0].size(), forces[1].size());
  const double peak = std::abs(*std::min_element(forces[0].begin(), forces[0].end()));
  EXPECT_GT(peak, 0.0);
  for (std::size_t i = 0; i < forces[0].size(); ++i)
    EXPECT_NEAR(forces[1][i], forces[0][i], 0.01 * peak) << "row " << i;
}

// Springs stiffened as inertia grows turn the rounding of a gap, 1e-17 m, into forces of 1e-9 of those that act: no
// iteration goes below, and none needs to. The impulse is that of exact multipliers, again to 1 %; the verdict is left
// out, as waves pass no cell within the run.
TEST(AugmentedLagrangian, KnowsTheRoundingOfStiffenedSprings) {
  std::vector<double> impulses;
  for (const char* enforcement : {"lagrange", "augmented_lagrangian"}) {
    const TemporaryCase given(coarse_block_on_fine(enforcement, 2e-9, 1e-9, 6));
    EXPECT_NE(given.run(), ExitCode::run_failed) << enforcement;
    impulses.push_back(last_row(given.result("contact.csv"))["touch.impulse_z"]);
  }
  EXPECT_GT(std::abs(impulses[0]), 0.0);
  EXPECT_NEAR(impulses[1], impulses[0], 0.01 * std::abs(impulses[0]));
}

}  // namespace
}  // namespace carom::run_augmented_lagrangian_test
