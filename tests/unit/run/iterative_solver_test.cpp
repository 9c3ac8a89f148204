// The books of implicit contact when conjugate gradients solve its equations.
#include <fmt/format.h>

#include <string>

#include "run_fixture.hpp"

namespace carom::run_iterative_solver_test {
namespace {

using namespace test;

/// A steel bar of 2 x 2 x 20 cells at 1 m/s onto one that is held; cells of 50 mm, 5.4e12 N/m^3 each.
std::string bar_on_bar(const std::string& method, double stiffness) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
origin = [0.0, 0.0, -1.0]
size = [0.1, 0.1, 1.0]
divisions = [2, 2, 20]
groups = {{ cells = "ONE", zmax = "HEAD" }}
[[mesh.block]]
origin = [0.0, 0.0, 1e-6]
size = [0.1, 0.1, 1.0]
divisions = [2, 2, 20]
groups = {{ cells = "TWO", zmin = "FOOT", zmax = "END" }}
[materials.steel]
law = "linear_elastic"
E = 2e11
nu = 0.3
rho = 7800.0
[[part]]
name = "one"
cells = "ONE"
material = "steel"
formulation = "full"
[[part]]
name = "two"
cells = "TWO"
material = "steel"
formulation = "full"
[[initial]]
part = "one"
velocity = [0.0, 0.0, 1.0]
[[support]]
nodes = "END"
blocked = ["x", "y", "z"]
[[contact]]
name = "touch"
kind = "pair"
group = "HEAD"
master = "FOOT"
method = "{}"
stiffness = {}
[scheme]
kind = "newmark"
beta = 0.3025
gamma = 0.6
enforcement = "penalty"
[solver]
kind = "cg"
[time]
end = 2e-4
step = 1e-5
[output]
fields = []
)",
                     method, stiffness);
}

// Springs 20 and 400 times as stiff as the cells make the operator ill-conditioned: what is left of a solve is below
// the bound of rounding while its work is not below that of the ledger, 1e-10 of the energy (the verdict's; the run is
// good when all of its items hold).
TEST(ConjugateGradients, CloseTheLedgerOnStiffSprings) {
  for (const char* method : {"node_to_surface", "two_pass", "surface_to_surface"}) {
    for (const double stiffness : {1e14, 2e15}) {
      const TemporaryCase given(bar_on_bar(method, stiffness));
      EXPECT_EQ(given.run(), ExitCode::good) << method << ", stiffness = " << stiffness;
    }
  }
}

}  // namespace
}  // namespace carom::run_iterative_solver_test
