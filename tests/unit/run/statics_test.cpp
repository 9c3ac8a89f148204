// Statics: what it solves to.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "run_fixture.hpp"

namespace carom::run_statics_test {
namespace {

using namespace test;

// A cantilever 1000 times as long as it is thick, whose operator has a condition of 1e9: one back-substitution leaves
// 4e-7 of the work unbooked, a second one what rounding of the sums leaves.
TEST(Statics, SolvesThinBodiesToWhatTheBalanceNeeds) {
  const TemporaryCase plate(R"(units = "mm-t-s"
[[mesh.block]]
size = [100.0, 20.0, 0.1]
divisions = [40, 4, 1]
[materials.steel]
law = "linear_elastic"
E = 2.1e5
nu = 0.3
rho = 7.8e-9
[[part]]
name = "plate"
cells = "BLOCK"
material = "steel"
[[support]]
nodes = "XMIN"
blocked = ["x", "y", "z"]
[[load]]
force = [0.0, 0.0, -1e-4]
group = "XMAX"
[scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
)");
  EXPECT_EQ(plate.run(), ExitCode::good) << plate.result("summary.json");  // the verdict's balance: 1e-10
}

/// A rigid cylinder of radius 0.3 indents half of a neo-Hookean block by 0.5; ends in `time`.
std::string indentation(const std::string& time) {
  return R"(units = "SI"
[[mesh.block]]
size = [2.0, 0.1, 1.5]
divisions = [10, 1, 6]
[materials.soft]
law = "neo_hookean"
E = 1.0
nu = 0.3
rho = 1.0
[[part]]
name = "body"
cells = "BLOCK"
material = "soft"
[[support]]
nodes = "XMIN"
symmetry = "x"
[[support]]
nodes = "all"
blocked = ["y"]
[[support]]
nodes = "ZMIN"
displacement = { z = 0.5, function = "ramp" }
[functions.ramp]
time = [0.0, 0.5]
value = [0.0, 1.0]
[[contact]]
name = "roll"
kind = "cylinder"
group = "ZMAX"
point = [0.0, 0.0, 1.8]
axis = [0.0, 1.0, 0.0]
radius = 0.3
[scheme]
kind = "statics"
enforcement = "lagrange"
[time]
end = 0.5
)" + time;
}

// The rows turn under a pressure of the order of Young's modulus. From t = 0.4 on, iterations that leave the turning of
// their normals out of the tangent do not come to their end in 50. An elastic body without friction does not know its
// path: the force is that of five times as many steps, to what equilibrium is solved to.
TEST(Statics, SolvesForRowsThatTurnUnderPressure) {
  const TemporaryCase given(indentation("step = 0.05\nfixed = true\n")), fine(indentation("step = 0.01\n"));
  EXPECT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
  fine.run();
  const double force = last_row(given.result("contact.csv"))["roll.force_z"];
  EXPECT_LT(force, 0.0);
  EXPECT_NEAR(force, last_row(fine.result("contact.csv"))["roll.force_z"], 1e-9 * std::abs(force));
}

// Bars of length 1 between walls, longer than their room by 0.01: multipliers push them apart in one step, and the
// energy of the fit is all there is. E d / (2 L) A, as Hooke has it.
TEST(Statics, PressFitsByMultipliersAreNoEnergyMade) {
  const TemporaryCase given(R"(units = "SI"
[[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [2, 2, 2]
groups = { cells = "LOWER", zmin = "FOOT", zmax = "MASTER" }
[[mesh.block]]
origin = [0.0, 0.0, 0.99]
size = [1.0, 1.0, 1.0]
divisions = [2, 2, 2]
groups = { cells = "UPPER", zmin = "SLAVE", zmax = "HEAD" }
[materials.soft]
law = "linear_elastic"
E = 2.0
nu = 0.0
rho = 1.5
[[part]]
name = "lower"
cells = "LOWER"
material = "soft"
[[part]]
name = "upper"
cells = "UPPER"
material = "soft"
[[support]]
nodes = "FOOT"
blocked = ["x", "y", "z"]
[[support]]
nodes = "HEAD"
blocked = ["x", "y", "z"]
[[contact]]
name = "fit"
kind = "pair"
group = "SLAVE"
master = "MASTER"
initial_penetration = "prestress"
[scheme]
kind = "statics"
enforcement = "lagrange"
[time]
end = 1.0
step = 1.0
)");
  EXPECT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
  EXPECT_NEAR(last_row(given.result("contact.csv"))["fit.force_z"], 0.01, 1e-10);
}

// A plate that nothing but a block under it holds, both of 2 GPa, pressed on: a fit for multipliers, whose rounding on
// the plate's weak springs moved its forces by 1e-12 at each Newton step, too much for an equilibrium of any step. The
// block bears 25 MPa on 50 x 50 mm, to the balance of the run.
TEST(Statics, BalancesPlatesThatMultipliersAloneHold) {
  const TemporaryCase given(R"(units = "mm-t-s"
[[mesh.block]]
size = [100.0, 100.0, 100.0]
divisions = [8, 8, 8]
groups = { cells = "LOWER", xmin = "LX", ymin = "LY", zmin = "FOOT", zmax = "MASTER" }
[[mesh.block]]
origin = [0.0, 0.0, 100.0]
size = [50.0, 50.0, 5.0]
divisions = [6, 6, 6]
groups = { cells = "UPPER", xmin = "UX", ymin = "UY", zmin = "SLAVE", zmax = "HEAD" }
[materials.soft]
law = "linear_elastic"
E = 2000.0
nu = 0.3
rho = 1e-9
[[part]]
name = "lower"
cells = "LOWER"
material = "soft"
[[part]]
name = "upper"
cells = "UPPER"
material = "soft"
[[support]]
nodes = "FOOT"
blocked = ["z"]
[[support]]
nodes = "LX"
symmetry = "x"
[[support]]
nodes = "LY"
symmetry = "y"
[[support]]
nodes = "UX"
symmetry = "x"
[[support]]
nodes = "UY"
symmetry = "y"
[[load]]
pressure = 25.0
group = "HEAD"
[[contact]]
name = "c"
kind = "pair"
group = "SLAVE"
master = "MASTER"
[scheme]
kind = "statics"
enforcement = "lagrange"
[time]
end = 1.0
step = 1.0
)");
  EXPECT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
  const std::vector<double> force = column(given.result("contact.csv"), "c.force_z");
  ASSERT_EQ(force.size(), 2u);  // the start, and one step
  EXPECT_NEAR(std::abs(force.back()), 62500.0, 62500.0 * 1e-10);
}

// The uppermost of four blocks with gaps of 0.05 comes down by 0.5 in four steps: after the first it carries two on,
// which nothing loads yet, and all energy is what rounding leaves.
TEST(Statics, CarryBodiesOnBeforeAnythingIsLoaded) {
  std::string text = "units = \"mm-t-s\"\n[materials.m]\nlaw = \"linear_elastic\"\nE = 2e5\nnu = 0.3\nrho = 7.8e-9\n";
  const std::vector<std::string> names{"A", "B", "C", "D"};
  const std::vector<double> bottom{-50.0, 0.05, 40.099999999999994, 80.14999999999999};
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format(R"([[mesh.block]]
kind = "quad"
origin = [0.0, {1}, 0.0]
size = [40.0, {2}]
divisions = [{3}, 4]
groups = {{ cells = "{0}", ymin = "{0}B", ymax = "{0}T", xmin = "{0}X" }}
[[part]]
name = "{0}"
cells = "{0}"
material = "m"
section = "plane_strain"
[[support]]
nodes = "{0}X"
symmetry = "x"
)",
                        names[i], bottom[i], i == 0 ? 50.0 : 40.0, 4 + i % 2);
  text += R"([[support]]
nodes = "AB"
blocked = ["x", "y"]
[[support]]
nodes = "DT"
displacement = { y = -0.5, function = "ramp" }
[functions.ramp]
time = [0.0, 1.0]
value = [0.0, 1.0]
[[contact]]
name = "BA"
kind = "pair"
group = "BB"
master = "AT"
[[contact]]
name = "CB"
kind = "pair"
group = "CB"
master = "BT"
[[contact]]
name = "DC"
kind = "pair"
group = "DB"
master = "CT"
[scheme]
kind = "statics"
enforcement = "penalty"
[time]
end = 1.0
step = 0.25
)";
  const TemporaryCase given(text);
  EXPECT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
}

// Two iterations do not find the equilibrium of the first step.
TEST(Statics, SaysWhatHelpsWhereItFindsNoEquilibrium) {
  const TemporaryCase given(indentation("step = 0.05\nfixed = true\n[solver]\nmax_contact_iterations = 2\n"));
  EXPECT_EQ(given.run(), ExitCode::run_failed);
  const std::string summary = given.result("summary.json");
  EXPECT_NE(summary.find("scheme with inertia"), std::string::npos) << summary;
}

}  // namespace
}  // namespace carom::run_statics_test
