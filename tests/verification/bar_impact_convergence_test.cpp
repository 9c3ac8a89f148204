// A bar hits a penalty wall: the velocity field converges to the exact solution of the wave equation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "build/simulation.hpp"
#include "casefile/read_case.hpp"
#include "exact/bar_impact.hpp"

namespace carom {
namespace {

/// The bar of SDNV100 (nu = 0) on a wall of 1e14 Pa/m, 2 mm below.
constexpr BarImpactData bar{0.2, 2.0e11, 8000.0, 4.0e-4, 100.0, 2.0e-3, 1.0e14};
constexpr double end = 1.4e-4;  // the shock ends at about 1.0e-4

std::string case_text(int cells, double step, const std::string& scheme) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
origin = [0.0, 0.0, 2.0e-3]
size = [0.02, 0.02, 0.2]
divisions = [1, 1, {}]
groups = {{ cells = "BAR", zmin = "FOOT" }}
[materials.steel]
law = "linear_elastic"
E = 2.0e11
nu = 0.0
rho = 8000.0
[[part]]
name = "bar"
cells = "BAR"
material = "steel"
[[initial]]
part = "bar"
velocity = [0.0, 0.0, -100.0]
[[contact]]
name = "wall"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
stiffness = 1.0e14
[scheme]
{}
[time]
end = {}
step = {}
)",
                     cells, scheme, end, step);
}

/// Mean over steps and cells of |v - exact| at the middle of both, over the speed of impact.
double velocity_error(int cells, double step, const std::string& scheme_text) {
  const Case given = parse_case(case_text(cells, step, scheme_text), "bar.toml");
  const Simulation simulation(given);
  const BarImpact exact(bar);
  // The nodes of one edge of the bar, upwards: all four edges move alike.
  std::vector<std::size_t> edge(static_cast<std::size_t>(cells) + 1);
  for (std::size_t n = 0; n < simulation.mesh().node_count(); ++n) {
    const Vec3& x = simulation.mesh().coordinates[n];
    if (x[0] == 0.0 && x[1] == 0.0)
      edge[static_cast<std::size_t>(std::lround((x[2] - bar.gap) / bar.length * cells))] = n;
  }
  const auto scheme = simulation.first().make_scheme();
  State state = simulation.initial_state(), next;
  const double h = simulation.dt();
  scheme->start(state, h);
  double sum = 0.0;
  for (long long i = 1; i <= simulation.steps(); ++i) {
    const double t = static_cast<double>(i) * h;
    EXPECT_TRUE(scheme->step(state, {t, h, 1e-10}, next).converged);  // 3200 J at the start
    for (std::size_t k = 0; k + 1 < edge.size(); ++k) {
      const double z = (static_cast<double>(k) + 0.5) * bar.length / cells;
      double v = 0.0;
      for (const State* s : {&state, &next}) v += 0.25 * (s->v[3 * edge[k] + 2] + s->v[3 * edge[k + 1] + 2]);
      sum += std::abs(v - exact.velocity(z, t - 0.5 * h));
    }
    std::swap(state, next);
  }
  return sum / (bar.speed * static_cast<double>(simulation.steps()) * cells);
}

/// Errors on 20, 40, 80 and 160 cells at the Courant number `courant`.
std::vector<double> errors_of(const std::string& scheme, double courant) {
  std::vector<double> errors;
  for (const int cells : {20, 40, 80, 160}) {
    errors.push_back(velocity_error(cells, courant * 2.0e-6 * 20 / cells, scheme));
  }
  return errors;
}

// In L1 a scheme of order p takes a jump with order p / (p + 1) (Brenner, Thomee and Wahlbin, Besov Spaces and
// Applications to Difference Methods, 1975): 1/2 for Newmark with gamma > 1/2, 2/3 for central differences. Coarse
// meshes are above it or below it, since the penalty wall rises in 4e-7 s, which only the finest mesh resolves; hence
// the mean over the three halvings, between 1/2 and 1, is asserted, and that every mesh is better than the one before.
void expect_convergence(const std::vector<double>& errors) {
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i], errors[i - 1]);
  const double order = std::log2(errors.front() / errors.back()) / 3.0;
  EXPECT_GT(order, 0.5) << testing::PrintToString(errors);
  EXPECT_LT(order, 1.0) << testing::PrintToString(errors);
}

TEST(BarImpactConvergence, OfDissipativeNewmark) {
  expect_convergence(errors_of("kind = \"newmark\"\nbeta = 0.28\ngamma = 0.55", 1.0));
}

// A quarter of a cell per step: the wall is so stiff that the foot's node alone asks for small steps.
TEST(BarImpactConvergence, OfCentralDifferences) {
  expect_convergence(errors_of("kind = \"central_differences\"", 0.25));
}

}  // namespace
}  // namespace carom
