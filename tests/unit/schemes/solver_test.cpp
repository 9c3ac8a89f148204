// Linear systems of implicit steps, both solvers against a dense solve and against each other.
#include <gtest/gtest.h>

#include "contact_fixture.hpp"
#include "linalg/dense.hpp"
#include "schemes/scheme_table.hpp"
#include "schemes_fixture.hpp"

namespace carom::schemes_solver_test {
namespace {

using namespace test;

/// Interface rows (weights on eight nodes) and node rows, some dofs blocked.
Model many_rows() {
  Mesh mesh = block_mesh({2, 1, 2}, 0.1);
  Model model = one_part(mesh);
  const std::vector<Index> cells = add_interface(mesh, "ZMIN");
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.contacts.emplace_back(InterfaceContact{"wall", cells, {.eps_N = 20.0, .eps_T = 10.0, .mu = 0.3}});
  model.contacts.emplace_back(StopContact{"stop", model.mesh->nodes_of("XMAX"), {-1, 0, 0}, 0.1, 2.0, 0.0});
  block(model, "WALL", {0, 1, 2});
  block(model, "YMIN", {1});
  return model;
}

/// M + s K + G^T D G on all dofs, identity on fixed ones: the oracle, by applying every part to unit vectors.
std::vector<double> dense_operator(const Problem& p, double s, const std::vector<RowTangent>& D) {
  const std::size_t n = p.solid.dof_count();
  const auto shared = p.rows();
  const ConstraintRows& rows = *shared;
  const std::vector<bool>& fixed = p.supports.fixed();
  std::vector<double> A(n * n), unit(n), column(n), K_unit(n);
  for (std::size_t j = 0; j < n; ++j) {
    std::fill(unit.begin(), unit.end(), 0.0);
    unit[j] = 1.0;
    p.mass.apply(unit, column);
    p.solid.internal_force(unit, K_unit);
    for (std::size_t i = 0; i < n; ++i) column[i] += s * K_unit[i];
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Vec3 w = rows.relative(r, unit);
      Vec3 force{};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) force[i] += D[r][3 * i + k] * w[k];
      }
      rows.scatter(r, force, column);
    }
    for (std::size_t i = 0; i < n; ++i) A[n * i + j] = fixed[i] || fixed[j] ? (i == j ? 1.0 : 0.0) : column[i];
  }
  return A;
}

std::vector<double> free_random(const Problem& p, unsigned seed) {
  std::vector<double> b = random_vector(p.solid.dof_count(), seed);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (p.supports.fixed()[i]) b[i] = 0.0;
  }
  return b;
}

std::string name_of(const EffectiveSolver& solver) {
  StageMemory memory;
  solver.leave(memory);
  return solver.name(memory);
}

/// Solves with the given tangents and compares with the dense solution.
void expect_dense_solution(const Problem& p, EffectiveSolver& solver, double s, const std::vector<RowTangent>& D,
                           double tolerance) {
  const std::vector<double> b = free_random(p, 3);
  std::vector<double> expected = b, x(b.size(), 1.0);
  DenseLu(dense_operator(p, s, D), static_cast<int>(b.size())).solve(expected);
  EXPECT_EQ(solver.prepare(1.0, s, x), "");
  const LinearSolveReport report = solver.solve(b, p.rows(), D, 0.0, x);
  EXPECT_TRUE(report.converged || report.residual < 1e-12) << report.residual;
  EXPECT_LT(largest_difference(x, expected), tolerance * largest(expected));
}

enum class Draw { symmetric, general };

/// Tangents of every third row zero, of the others random; normal only for every second.
std::vector<RowTangent> random_tangents(std::size_t count, unsigned seed, Draw draw) {
  std::vector<RowTangent> D(count);
  for (std::size_t r = 0; r < count; ++r) {
    if (r % 3 == 0) continue;
    const std::vector<double> d = random_vector(9, seed + static_cast<unsigned>(r));
    if (r % 2 == 0) {
      D[r][0] = 5.0 + d[0];
      continue;
    }
    for (std::size_t i = 0; i < 9; ++i) D[r][i] = d[i] + (i % 4 == 0 ? 4.0 : 0.0);  // positive definite
    if (draw == Draw::symmetric) {
      for (const auto& [i, j] : {std::pair{1, 3}, {2, 6}, {5, 7}}) {
        D[r][static_cast<std::size_t>(i)] = D[r][static_cast<std::size_t>(j)];
      }
    }
  }
  return D;
}

TEST(EffectiveSolver, CholeskyCorrectsForAnyContactTangent) {
  const Problem p(many_rows());
  const auto solver = make_effective_solver(p.system, SolverKind::cholesky);
  for (const double s : {0.1, 3.0}) {  // the second factor throws the columns of the first away
    for (unsigned seed = 1; seed <= 5; ++seed) {
      // 1e-11: round-off 1e-16 times a condition number of M + s K of some hundred, and the correction's
      expect_dense_solution(p, *solver, s, random_tangents(p.contact.slots(), 100 * seed, Draw::general), 1e-11);
    }
    expect_dense_solution(p, *solver, s, std::vector<RowTangent>(p.contact.slots()), 1e-11);
  }
}

TEST(EffectiveSolver, ConjugateGradientsSolveSymmetricTangents) {
  const Problem p(many_rows());
  for (const SolverKind kind : {SolverKind::conjugate_gradients, SolverKind::multigrid}) {
    const auto solver = make_effective_solver(p.system, kind);
    for (const double s : {0.1, 3.0})
      for (const unsigned seed : {7U, 8U}) {  // the second tangents on the operator that has been made
        // 1e-10: a residual of 1e-14 times the condition number
        expect_dense_solution(p, *solver, s, random_tangents(p.contact.slots(), seed, Draw::symmetric), 1e-10);
      }
  }
}

TEST(EffectiveSolver, LdltCorrectsForAnyContactTangent) {
  const Problem p(many_rows());
  const auto solver = make_effective_solver(p.system, SolverKind::ldlt);
  EXPECT_EQ(name_of(*solver), "LDL^T factorisation");
  for (const double s : {0.1, 3.0}) {
    for (unsigned seed = 1; seed <= 3; ++seed) {  // 1e-11: as for Cholesky
      expect_dense_solution(p, *solver, s, random_tangents(p.contact.slots(), 100 * seed, Draw::general), 1e-11);
    }
  }
}

// s < 0 stands for a tangent with negative stiffness: M - 3 K is indefinite.
TEST(EffectiveSolver, CholeskyGivesWayToLdltWhereTheOperatorIsIndefinite) {
  const Problem p(many_rows());
  const auto solver = make_effective_solver(p.system, SolverKind::cholesky);
  expect_dense_solution(p, *solver, 0.1, random_tangents(p.contact.slots(), 100, Draw::general), 1e-11);
  EXPECT_EQ(name_of(*solver), "Cholesky factorisation");
  // 1e-10: M - 3 K may have an eigenvalue near zero, so that the condition number is some thousand
  expect_dense_solution(p, *solver, -3.0, random_tangents(p.contact.slots(), 100, Draw::general), 1e-10);
  const std::string name = name_of(*solver);
  EXPECT_EQ(name.find("LDL^T factorisation since a tangent had "), 0u) << name;
  expect_dense_solution(p, *solver, 0.1, random_tangents(p.contact.slots(), 100, Draw::general), 1e-11);
  EXPECT_EQ(name_of(*solver), name);
}

// Whatever it has factored before, it solves by the factors that the memory of the stage asks for, to the bit.
TEST(EffectiveSolver, GoesOnFromTheMemoryOfTheStage) {
  const Problem p(many_rows());
  const std::vector<double> b = free_random(p, 3);
  const std::vector<RowTangent> D = random_tangents(p.contact.slots(), 100, Draw::general);
  const auto solution = [&](EffectiveSolver& solver, const StageMemory& memory) {
    std::vector<double> x(b.size(), 0.0);
    solver.begin(memory);
    EXPECT_EQ(solver.prepare(1.0, 0.1, x), "");
    EXPECT_TRUE(solver.solve(b, p.rows(), D, 0.0, x).converged);
    return x;
  };
  const auto solver = make_effective_solver(p.system, SolverKind::cholesky);
  const StageMemory definite;
  StageMemory indefinite;
  solver->begin(definite);
  EXPECT_EQ(solver->prepare(1.0, -3.0, b), "");
  solver->leave(indefinite);
  ASSERT_GT(indefinite.negative_eigenvalues, 0);
  const std::vector<double> by_cholesky = solution(*solver, definite), by_ldlt = solution(*solver, indefinite);
  EXPECT_NE(by_cholesky, by_ldlt);
  EXPECT_EQ(by_cholesky, solution(*make_effective_solver(p.system, SolverKind::cholesky), definite));
  EXPECT_EQ(by_ldlt, solution(*make_effective_solver(p.system, SolverKind::cholesky), indefinite));
  EXPECT_EQ(by_cholesky, solution(*solver, definite));
}

TEST(EffectiveSolver, ConjugateGradientsSayThatTheOperatorIsIndefinite) {
  const Problem p(many_rows());
  for (const SolverKind kind : {SolverKind::conjugate_gradients, SolverKind::multigrid}) {
    const auto solver = make_effective_solver(p.system, kind);
    const std::vector<double> b = free_random(p, 3);
    std::vector<double> x(b.size());
    EXPECT_EQ(solver->prepare(1.0, -3.0, x), "");
    const LinearSolveReport report = solver->solve(b, p.rows(), {}, 0.0, x);
    EXPECT_FALSE(report.converged);
    EXPECT_TRUE(report.is_indefinite);
  }
}

// Sliding makes the tangent unsymmetric, which conjugate gradients cannot take: they leave the one-way coupling out.
TEST(EffectiveSolver, ConjugateGradientsLeaveOneWayCouplingOut) {
  const Problem p(many_rows());
  for (const SolverKind kind : {SolverKind::conjugate_gradients, SolverKind::multigrid}) {
    const auto solver = make_effective_solver(p.system, kind);
    std::vector<RowTangent> coupled(p.contact.slots(), {5.0, 0, 0, -1.5, 1.0, 0, 0.5, 0, 2.0});
    const std::vector<RowTangent> uncoupled(coupled.size(), {5.0, 0, 0, 0, 1.0, 0, 0, 0, 2.0});
    const std::vector<double> b = free_random(p, 3);
    std::vector<double> x(b.size()), y(b.size());
    EXPECT_EQ(solver->prepare(1.0, 0.1, x), "");
    EXPECT_TRUE(solver->solve(b, p.rows(), coupled, 1e-12, x).converged);
    EXPECT_TRUE(solver->solve(b, p.rows(), uncoupled, 1e-12, y).converged);
    EXPECT_EQ(x, y);
  }
}

TEST(EffectiveSolver, AutomaticTakesTheFactorisationForLongSteps) {
  const Problem p(many_rows());
  const double omega_squared = stable_step(p.system).omega_max_squared_free;
  const auto name_for = [&](double courant) {
    const double h = courant * 2.0 / std::sqrt(omega_squared);
    const SolverKind kind =
        chosen_solver(p.system, SolverKind::automatic, EnforcementKind::penalty, 0.25 * h * h, omega_squared);
    return name_of(*make_effective_solver(p.system, kind));
  };
  // kappa = 1 + courant^2: 60 iterations at sqrt(kappa) / 2 ln(2e12) = 60, a Courant number of about 4.1
  EXPECT_EQ(name_for(1.0), "conjugate gradients");
  EXPECT_EQ(name_for(4.0), "conjugate gradients");
  EXPECT_EQ(name_for(4.5), "Cholesky factorisation");
  EXPECT_EQ(name_for(100.0), "Cholesky factorisation");
}

// Of 46,875 dofs of a linear body (25 x 25 x 25 nodes) a factorisation, of 59,049 (27 x 27 x 27) multigrid.
TEST(EffectiveSolver, AutomaticTakesMultigridForLargeMeshes) {
  for (const auto& [n, expected] : {std::pair{24, SolverKind::cholesky}, {26, SolverKind::multigrid}}) {
    const Problem p(one_part(block_mesh({n, n, n}, 0.1)));
    const auto kind = [&](double ratio) {
      return chosen_solver(p.system, SolverKind::automatic, EnforcementKind::penalty, ratio, 1.0);
    };
    EXPECT_EQ(kind(infinity), expected);  // statics
    EXPECT_EQ(kind(400.0), expected);     // at a Courant number of 20
    EXPECT_EQ(kind(1.0), SolverKind::conjugate_gradients);
  }
}

Model impact(const Friction& friction) {
  Model model = one_part(block_mesh({2, 2, 4}, 0.15));
  model.contacts.emplace_back(plane_below(model, 0.05, 20.0, friction));
  return model;
}

TEST(Solvers, AgreeOnAnImpact) {
  for (const Friction& friction : {Friction{}, Friction{10.0, 0.5}}) {
    for (const MassKind kind : {MassKind::consistent, MassKind::lumped}) {
      std::vector<State> states;
      for (const SolverKind solver :
           {SolverKind::cholesky, SolverKind::conjugate_gradients, SolverKind::multigrid, SolverKind::ldlt}) {
        const Problem p(impact(friction), kind);
        const History run = march(*newmark(p, 0.1, {}, {.solver = solver}), p.moving({0.1, 0.05, -0.2}), 0.1, 100);
        ASSERT_TRUE(run.converged);
        states.push_back(run.state);
      }
      // 1e-9: both leave at most 1e-12 of the energy unbooked, that is 1e-6 of a velocity squared at worst but 1e-9 in
      // practice; the contact has been made and lost.
      for (std::size_t k = 1; k < states.size(); ++k) {
        EXPECT_LT(largest_difference(states[0].q, states[k].q), 1e-9 * largest(states[0].q));
        EXPECT_LT(largest_difference(states[0].v, states[k].v), 1e-9 * largest(states[0].v));
      }
    }
  }
}

// Contact nodes of which supports hold one component: their rows reach into fixed dofs.
TEST(Solvers, AgreeOnMultipliersOfHeldNodes) {
  Model model = impact({10.0, 0.5});
  block(model, "XMIN", {0});
  const Problem p(std::move(model));
  std::vector<State> states;
  for (const SolverKind solver :
       {SolverKind::cholesky, SolverKind::conjugate_gradients, SolverKind::multigrid, SolverKind::ldlt}) {
    const ImplicitSettings settings{.enforcement = EnforcementKind::lagrange, .solver = solver};
    GeneralizedAlpha scheme(p.system, hht_parameters(-0.2), settings, 0.1,
                            stable_step(p.system).omega_max_squared_free);
    const History run = march(scheme, p.moving({0.0, 0.05, -0.2}), 0.1, 40);
    ASSERT_TRUE(run.converged);
    states.push_back(run.state);
  }
  for (std::size_t k = 1; k < states.size(); ++k) {
    // 1e-5: each step may leave 1e-12 of the energy unbooked, 1e-6 of the velocity; ten of these in one direction
    EXPECT_LT(largest_difference(states[0].q, states[k].q), 1e-5 * largest(states[0].q));
    EXPECT_LT(largest_difference(states[0].v, states[k].v), 1e-5 * largest(states[0].v));
  }
}

// Every implicit scheme and enforcement, both factorisations: the same answer.
TEST(Solvers, EveryImplicitSchemeTakesLdlt) {
  for (const SchemeTraits& scheme : scheme_table) {
    if (is_explicit(scheme.kind)) continue;
    for (std::size_t e = 0; e < enforcement_count; ++e) {
      if (!scheme.takes[e]) continue;
      const Problem p(impact({}));
      std::vector<State> states;
      for (const SolverKind solver : {SolverKind::cholesky, SolverKind::ldlt}) {
        const SchemeSettings settings{
            .kind = scheme.kind, .enforcement = static_cast<EnforcementKind>(e), .solver = solver};
        const auto made = make_scheme({p.system, settings, 0.1, stable_step(p.system).omega_max_squared_free});
        // Statics knows no velocities: there nothing moves.
        const History run = march(*made, p.moving({0.1, 0.05, -0.2}), 0.1, 20);
        EXPECT_EQ(made->solver_name(run.state),
                  solver == SolverKind::ldlt ? "LDL^T factorisation" : "Cholesky factorisation");
        EXPECT_TRUE(run.converged) << scheme.name << ", " << enforcement_names[e];
        states.push_back(run.state);
      }
      // 1e-9: as AgreeOnAnImpact
      EXPECT_LT(largest_difference(states[0].v, states[1].v), 1e-9 * std::max(0.1, largest(states[0].v)))
          << scheme.name;
      EXPECT_LT(largest_difference(states[0].q, states[1].q), 1e-9 * std::max(0.1, largest(states[0].q)))
          << scheme.name;
    }
  }
}

}  // namespace
}  // namespace carom::schemes_solver_test
