// Iterations and seconds of the iterative solvers of implicit steps: a clamped cube of n^3 cells HEXA8, a random load,
// eight digits. Usage: bench_solvers n [n...]. bench/solvers_petsc.py measures PETSc's on such a cube.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "build/simulation.hpp"
#include "casefile/read_case.hpp"
#include "parallel/threads.hpp"
#include "system/effective_solver.hpp"

namespace {

using namespace carom;

std::string cube(int n, double nu) {
  return fmt::format(R"(
[[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [{0}, {0}, {0}]
groups = {{ cells = "CUBE", zmin = "FOOT" }}
[materials.one]
law = "linear_elastic"
E = 1.0
nu = {1}
rho = 1.0
[[part]]
name = "cube"
cells = "CUBE"
material = "one"
[[support]]
nodes = "FOOT"
blocked = ["x", "y", "z"]
[scheme]
kind = "newmark"
[time]
end = 1.0
step = 1.0
)",
                     n, nu);
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Courant number: of the longitudinal wave over a cell's edge; infinite for statics.
void measure(const System& system, SolverKind kind, int n, double nu, double courant) {
  const double modulus = (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)), step = courant / (n * std::sqrt(modulus));
  const bool is_static = std::isinf(courant);
  const auto begin = std::chrono::steady_clock::now();
  const auto solver = make_effective_solver(system, kind);
  std::vector<double> b(system.solid.dof_count()), x(b.size());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = system.supports.fixed()[i] ? 0.0 : entry(random);
  solver->prepare(is_static ? 0.0 : 1.0, is_static ? 1.0 : 0.25 * step * step, x);
  const double set_up = seconds_since(begin);
  const auto start = std::chrono::steady_clock::now();
  const LinearSolveReport report = solver->solve(b, nullptr, {}, 1e-8 * std::sqrt(dot(b, b)), x);
  fmt::print("| {} | {} | {} | {} | {} | {:.2f} | {:.2f} |\n", n, nu,
             is_static ? "static" : fmt::format("{:g}", courant),
             kind == SolverKind::multigrid ? "multigrid" : "Jacobi", report.iterations, set_up, seconds_since(start));
}

}  // namespace

int main(int argc, char** argv) {
  set_threads(1);
  fmt::print(
      "| cells an edge | nu | Courant | preconditioner | iterations | set-up, s | solve, s |\n|---|---|---|---|---|---|---|\n");
  for (int k = 1; k < argc; ++k)
    for (const double nu : {0.3, 0.49}) {
      const int n = std::atoi(argv[k]);
      const Simulation simulation(parse_case(cube(n, nu), "cube.toml"));
      for (const double courant : {std::numeric_limits<double>::infinity(), 100.0, 10.0, 1.0})
        for (const SolverKind kind : {SolverKind::multigrid, SolverKind::conjugate_gradients})
          measure(simulation.system(), kind, n, nu, courant);
    }
}
