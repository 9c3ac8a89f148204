// Mechanisms: whatever solves the equations, the message names the node and the direction that nothing resists.
#include <gtest/gtest.h>

#include "run_fixture.hpp"

namespace carom::run_singular_test {
namespace {

using namespace test;

/// Two bars in a line between fixed ends, loaded across at the node between them, which only moves along z there.
std::string mechanism(const std::string& solver, const std::string& more) {
  return R"(units = "SI"
[[mesh.block]]
kind = "bar"
end = [4.0, 0.0, 0.0]
divisions = 2
groups = { cells = "BARS", start = "LEFT", end = "RIGHT" }
points = { MIDDLE = [2.0, 0.0, 0.0] }
[materials.m]
law = "linear_elastic"
E = 8.0
nu = 0.0
rho = 1.5
[[part]]
name = "bars"
cells = "BARS"
material = "m"
section = "bar"
area = 1.0
[[support]]
nodes = "BARS"
blocked = ["y"]
[[support]]
nodes = "LEFT"
blocked = ["x", "z"]
[[support]]
nodes = "RIGHT"
blocked = ["x", "z"]
[[load]]
group = "MIDDLE"
force = [1e-3, 0.0, 2e-3]
[output]
fields = []
[scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
fixed = true
[solver]
kind = ")" +
         solver + "\"\n" + more;
}

TEST(Singular, MechanismsAreNamedByNodeAndDirection) {
  for (const char* solver : {"auto", "cholmod", "mumps", "cg", "multigrid"}) {
    const TemporaryCase run(mechanism(solver, ""));
    EXPECT_EQ(run.run(), ExitCode::run_failed) << solver;
    const std::string summary = run.result("summary.json");
    EXPECT_NE(summary.find("node 2 at (2, 0, 0) moves along z"), std::string::npos) << solver << "\n" << summary;
  }
}

TEST(Singular, ASpringMendsIt) {
  for (const char* solver : {"auto", "cholmod", "mumps", "cg", "multigrid"}) {
    const TemporaryCase run(mechanism(solver, "[[spring]]\nnodes = \"MIDDLE\"\nstiffness = [0, 0, 4]\n"));
    EXPECT_EQ(run.run(), ExitCode::good) << solver << "\n" << run.result("summary.json");
  }
}

}  // namespace
}  // namespace carom::run_singular_test
