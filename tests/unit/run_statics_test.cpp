// Statics: what it solves to.
#include "run_fixture.hpp"

namespace carom {
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
force = [0.0, 0.0, -1e-3]
group = "XMAX"
[scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
)");
  EXPECT_EQ(plate.run(), ExitCode::good) << plate.result("summary.json");  // the verdict's balance: 1e-10
}

}  // namespace
}  // namespace carom
