// The multilevel preconditioner: what it must be for conjugate gradients, and how many iterations it leaves them.
#include "system/multigrid.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "cell_meshes.hpp"
#include "schemes_fixture.hpp"
#include "solid_bodies.hpp"

namespace carom::schemes_multigrid_test {
namespace {

using namespace test;

/// A solve to a relative residual, and what it took.
struct Solved {
  std::vector<double> x;
  int iterations = 0;
};

std::vector<double> free_load(const Problem& p, unsigned seed) {
  std::vector<double> b = random_vector(p.solid.dof_count(), seed);
  for (std::size_t i = 0; i < b.size(); ++i)
    if (p.supports.fixed()[i]) b[i] = 0.0;
  return b;
}

constexpr double eight_digits = 1e-8;

Solved solve(const Problem& p, SolverKind kind, double m, double c, const std::vector<RowTangent>& D = {}) {
  const std::vector<double> b = free_load(p, 1), rest(b.size(), 0.0);
  const auto solver = make_effective_solver(p.system, kind);
  Solved out{std::vector<double>(b.size()), 0};
  EXPECT_EQ(solver->prepare(m, c, rest), "");
  const LinearSolveReport report = solver->solve(b, p.rows(), D, eight_digits * std::sqrt(dot(b, b)), out.x);
  EXPECT_TRUE(report.converged);
  out.iterations = report.iterations;
  return out;
}

/// h^2 / 4 of Newmark's average acceleration at a Courant number, for cells of edge 1.
double ratio_at(double courant) {
  return 0.25 * courant * courant * unit_material.rho / unit_material.p_wave_modulus();
}

Model bar(int n, double distortion = 0.0) {
  return one_part(block_mesh({n, n, 5 * n}, distortion));
}

Model clamped(Model model) {
  block(model, "ZMIN", {0, 1, 2});
  return model;
}

/// A block twice as wide above another, every face of the one pressed on the other by springs.
Model stacked(int n) {
  StructuredBlock lower, upper;
  lower.size = {2, 2, 1};
  upper.size = {1, 1, 2};
  upper.origin = {0.5, 0.5, 1.0};
  lower.divisions = {2 * n, 2 * n, n};
  upper.divisions = {n + 1, n + 1, 2 * n};
  lower.face_groups = {"", "", "", "", "FLOOR", "MASTER"};
  upper.face_groups = {"", "", "", "", "SLAVE", ""};
  Model model = one_part(make_structured_blocks({lower, upper}));
  PairContact pair;
  pair.name = "pair";
  pair.slave.facets = faces_of(*model.mesh, "SLAVE");
  pair.master.facets = faces_of(*model.mesh, "MASTER");
  pair.law.eps_N = 2.0 * n;  // of the order of a cell's own stiffness, E over its height
  model.contacts.emplace_back(pair);
  block(model, "FLOOR", {0, 1, 2});
  return model;
}

/// Springs of rows that act, along their normals and across.
std::vector<RowTangent> springs(const Problem& p, double normal, double across) {
  return std::vector<RowTangent>(p.rows()->size(), {normal, 0, 0, 0, across, 0, 0, 0, across});
}

// Five actions of the fine operator an iteration: one of the conjugate gradients, one and two of smoothing, one for the
// residual in between. Ten iterations for eight digits are fifty actions, sixteen eighty.
TEST(Multigrid, IterationsDoNotGrowWithTheMesh) {
  for (const double distortion : {0.0, 0.2})
    for (const int n : {4, 8, 14}) {
      const Problem free(bar(n, distortion)), held(clamped(bar(n, distortion)));
      EXPECT_LE(solve(free, SolverKind::multigrid, 1.0, ratio_at(18.0)).iterations, 10) << n << ", " << distortion;
      EXPECT_LE(solve(free, SolverKind::multigrid, 1.0, ratio_at(1000.0)).iterations, 16) << n << ", " << distortion;
      EXPECT_LE(solve(held, SolverKind::multigrid, 0.0, 1.0).iterations, 16) << n << ", " << distortion;
    }
}

// Contact stands on every level: up to ten times the stiffness of the cells costs no iterations, and at any it is the
// same number on every mesh, far from that of the diagonal.
TEST(Multigrid, ContactStandsOnEveryLevel) {
  for (const int n : {3, 6}) {
    const Problem p(stacked(n));
    const double cell = 2.0 / n;  // its stiffness
    for (const double times : {1.0, 10.0, 100.0, 1e3})
      for (const double across : {0.0, 0.3 * times}) {
        const std::vector<RowTangent> D = springs(p, times * cell, across * cell);
        const int iterations = solve(p, SolverKind::multigrid, 1.0, ratio_at(18.0), D).iterations;
        const int plain = solve(p, SolverKind::conjugate_gradients, 1.0, ratio_at(18.0), D).iterations;
        EXPECT_LE(iterations, times > 10.0 ? plain / 2 : 16) << n << ", " << times;
      }
  }
}

/// Models that the background grids know least of: cells of other shapes, a soft half, a thin plate, nodes on edges.
std::vector<std::pair<std::string, Model>> awkward_models() {
  std::vector<std::pair<std::string, Model>> out;
  const auto add = [&](const std::string& label, Model model) { out.emplace_back(label, clamped(std::move(model))); };
  for (const CellType type : {CellType::tetra4, CellType::tetra10, CellType::penta6, CellType::hexa20})
    add(std::string(name(type)), body(with_cells(block_mesh({4, 4, 8}, 0.1), type),
                                      *find_element(type, Section::solid, {}), Material(unit_material)));
  Model halves = one_part(block_mesh({6, 6, 12}, 0.1));
  Part soft = halves.parts[0];
  for (Part* part : {&halves.parts[0], &soft}) part->cells.clear();
  for (Index k = 0; k < 6 * 6 * 12; ++k) (k < 6 * 6 * 6 ? halves.parts[0] : soft).cells.push_back(k);
  soft.name = "soft";
  soft.material = LinearElastic{{.E = 1e-3 * unit_material.E, .nu = 0.45, .rho = 0.1}};
  halves.parts.push_back(soft);
  add("a thousandth", halves);
  Mesh plate = block_mesh({12, 2, 12}, 0.0);
  for (Vec3& x : plate.coordinates) x[1] *= 0.1;
  add("plate", one_part(plate));
  return out;
}

// 1e-6 of the largest displacement: eight digits of the residual, and two for the condition number of what is slender.
TEST(Multigrid, SolvesWhatAFactorisationSolves) {
  for (const auto& [label, model] : awkward_models()) {
    const Problem p(model);
    for (const bool is_static : {false, true}) {
      const double m = is_static ? 0.0 : 1.0, c = is_static ? 1.0 : ratio_at(18.0);
      const Solved iterated = solve(p, SolverKind::multigrid, m, c), factored = solve(p, SolverKind::cholesky, m, c);
      EXPECT_LT(largest_difference(iterated.x, factored.x), 1e-6 * largest(factored.x)) << label << is_static;
      // A plate whose cells do not lock bends more easily than the diagonal says.
      EXPECT_LE(iterated.iterations, label == "plate" ? 56 : 24) << label << is_static;
    }
  }
}

/// Two bodies, of which the small one waves run through a hundred times as fast.
Model unlike_bodies() {
  StructuredBlock soft, hard;
  soft.size = {1, 1, 2};
  soft.divisions = {6, 6, 12};
  hard.size = {0.2, 0.2, 0.2};
  hard.origin = {2, 0, 0};
  hard.divisions = {2, 2, 2};
  Model model = one_part(make_structured_blocks({soft, hard}));
  Part other = model.parts[0];
  for (Part* part : {&model.parts[0], &other}) part->cells.clear();
  constexpr Index of_soft = 6 * 6 * 12, of_hard = 8;
  for (Index k = 0; k < of_soft + of_hard; ++k) (k < of_soft ? model.parts[0] : other).cells.push_back(k);
  other.name = "hard";
  other.material = LinearElastic{{.E = 1e4 * unit_material.E, .nu = 0.3, .rho = 1.0}};
  model.parts.push_back(other);
  return model;
}

// The largest eigenvalue of D^-1 A, to which smoothing is tuned, is then one of the small body, whichever of mass and
// stiffness prevails in the other: a Lanczos iteration that sees the other alone ends at 1 at once. The mass of the
// cycle is lumped, of which that of trilinear cells is 1/27 to 1: sqrt(27) / 2 ln(2 / 1e-8) = 50 iterations where it
// prevails, and two for the residual's norm in place of the error's.
TEST(Multigrid, SmoothsTheStiffestBody) {
  const Problem p(unlike_bodies());
  for (double courant = 1e-3; courant < 100.0; courant *= 2.0)
    EXPECT_LE(solve(p, SolverKind::multigrid, 1.0, ratio_at(courant)).iterations, 52) << courant;
}

// What conjugate gradients ask of a preconditioner: x . B y = y . B x to round-off, x . B x > 0; and the same bits
// again, whatever has been solved in between.
TEST(Multigrid, IsSymmetricAndPositiveDefinite) {
  const Problem p(stacked(3));
  const std::size_t n = p.solid.dof_count();
  Multigrid grids(p.system);
  const std::vector<double> rest(n, 0.0);
  grids.make(1.0, ratio_at(18.0), std::make_shared<TangentPlace>(TangentPlace{0.0, rest, {}}), {});
  std::vector<double> first;
  for (const double stiffness : {0.0, 1.0, 1e3, 0.0}) {
    grids.use(p.rows(), springs(p, stiffness, 0.0));
    const std::vector<double> x = free_load(p, 1), y = free_load(p, 2);
    std::vector<double> Bx(n), By(n);
    grids.apply(x, Bx);
    grids.apply(y, By);
    const double scale = std::sqrt(dot(x, Bx) * dot(y, By));
    EXPECT_GT(dot(x, Bx), 0.0);
    EXPECT_NEAR(dot(x, By), dot(y, Bx), 1e-12 * scale) << stiffness;
    if (first.empty()) first = Bx;
    if (stiffness == 0.0) {
      EXPECT_EQ(Bx, first);
    }
  }
}

// Springs of some cells' stiffness at all dofs of the foot in the place of supports, where nothing else holds the body:
// the same solution as that of a factorisation, in no more iterations than where supports hold the foot (above).
TEST(Multigrid, SpringsHoldABodyOnEveryLevel) {
  for (const std::size_t spread : {1U, 2U}) {
    const Problem p(bar(8));
    std::vector<DofSpring> held;
    const std::vector<Index> foot = p.model.mesh->nodes_of("ZMIN");
    for (std::size_t k = 0; k < foot.size(); k += spread)
      for (std::size_t c = 0; c < 3; ++c)
        held.push_back({3 * static_cast<std::size_t>(foot[k]) + c, 100.0 * unit_material.E});
    const std::vector<double> b = free_load(p, 1), rest(b.size(), 0.0);
    std::vector<double> iterated(b.size()), factored(b.size());
    const double absolute = eight_digits * std::sqrt(dot(b, b));
    int iterations = 0;
    for (const SolverKind kind : {SolverKind::multigrid, SolverKind::cholesky}) {
      const auto solver = make_effective_solver(p.system, kind);
      solver->hold(held);
      ASSERT_EQ(solver->prepare(0.0, 1.0, rest), "");
      std::vector<double>& x = kind == SolverKind::multigrid ? iterated : factored;
      const LinearSolveReport report = solver->solve(b, p.rows(), {}, absolute, x);
      EXPECT_TRUE(report.converged);
      if (kind == SolverKind::multigrid) iterations = report.iterations;
    }
    EXPECT_LE(iterations, 16) << spread;
    EXPECT_LT(largest_difference(iterated, factored), 1e-6 * largest(factored)) << spread;
  }
}

}  // namespace
}  // namespace carom::schemes_multigrid_test
