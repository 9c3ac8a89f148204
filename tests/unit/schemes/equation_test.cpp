// Linear equations between displacements, in every scheme with every enforcement that it takes.
#include <gtest/gtest.h>

#include <string>

#include "model/compatibility.hpp"
#include "schemes/scheme_table.hpp"
#include "tie_fixture.hpp"

namespace carom::schemes_equation_test {
namespace {

using namespace test;

MassKind mass_of(SchemeKind scheme) {
  return is_explicit(scheme) ? MassKind::lumped : MassKind::consistent;
}
std::unique_ptr<Scheme> scheme_on(const Problem& p, SchemeKind kind, EnforcementKind enforcement, double h) {
  const SchemeSettings settings{.kind = kind, .enforcement = enforcement, .solver = SolverKind::cholesky};
  return make_scheme({p.system, settings, h, stable_step(p.system).omega_max_squared_free});
}
double step_of(const Problem& p, SchemeKind kind) {
  return is_explicit(kind) ? 0.5 * stable_step(p.system).dt_free : 0.1;
}
std::vector<SchemeTraits> schemes_with_mass() {
  std::vector<SchemeTraits> all(scheme_table.begin(), scheme_table.end());
  std::erase_if(all, [](const SchemeTraits& t) { return t.kind == SchemeKind::modified_mass; });
  return all;
}

class Equations : public testing::TestWithParam<SchemeTraits> {
 protected:
  template <class Try>
  void with_each_enforcement(const Try& attempt) {
    for (const EnforcementTraits& enforcement : enforcement_table) {
      if (!takes(GetParam().kind, enforcement.kind)) continue;
      SCOPED_TRACE(std::string(enforcement.name));
      attempt(GetParam().kind, enforcement.kind);
    }
  }
};

Mesh one_block() {
  StructuredBlock block;
  block.size = {2.0, 1.0, 1.0};
  block.divisions = {4, 2, 2};
  block.face_groups = {"XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX"};
  return make_structured_blocks({block});
}

Index node_at(const Model& model, const Vec3& X) {
  for (std::size_t n = 0; n < model.mesh->node_count(); ++n)
    if (norm(subtract(model.mesh->coordinates[n], X)) < 1e-9) return static_cast<Index>(n);
  return -1;
}

double value(const LinearEquation& equation, std::span<const double> x) {
  double sum = 0.0;
  for (const LinearEquation::Term& term : equation.terms)
    sum += term.coefficient * x[3 * static_cast<std::size_t>(term.node) + static_cast<std::size_t>(term.component)];
  return sum;
}
double largest_value(const Model& model, std::span<const double> x) {
  double most = 0.0;
  for (const LinearEquation& equation : model.equations) most = std::max(most, std::abs(value(equation, x)));
  return most;
}

/// The end x = 2 of a block moves as one along x, and is rounded off by what else hangs on it: 2 u_y = 3 u_z of one
/// node.
Model with_rigid_end() {
  Model model = one_part(one_block());
  const std::vector<Index> end = model.mesh->nodes_of("XMAX");
  for (std::size_t k = 1; k < end.size(); ++k)
    model.equations.push_back({"end", {{end[k], 0, 1.0}, {end[0], 0, -1.0}}});
  const Index corner = node_at(model, {2.0, 1.0, 1.0});
  model.equations.push_back({"slope", {{corner, 1, 2.0}, {corner, 2, -3.0}}});
  return model;
}

// Held at one end and pulled askew: the equations hold to rounding; the equation that couples two components of a node
// does no work, so that the energies balance.
TEST_P(Equations, HoldToRoundingWithoutWork) {
  with_each_enforcement([](SchemeKind kind, EnforcementKind enforcement) {
    Model model = with_rigid_end();
    block(model, "XMIN", {0, 1, 2});
    model.loads.push_back(NodalForce{{node_at(model, {2.0, 1.0, 1.0})}, {0.03, 0.01, -0.02}, {{0.0, 1.0}, {0.0, 1.0}}});
    const Problem p(std::move(model), mass_of(kind));
    const double h = step_of(p, kind);
    const History run = march(*scheme_on(p, kind, enforcement, h), p.moving({}), h, static_cast<int>(3.0 / h));
    ASSERT_TRUE(run.converged) << run.failure;
    ASSERT_GT(largest(run.state.q), 1e-2);
    EXPECT_LT(largest_value(p.model, run.state.q), 1e-13);
    EXPECT_EQ(run.ledger.now().impact, 0.0);
    EXPECT_EQ(run.ledger.now().friction, 0.0);
    EXPECT_EQ(run.ledger.now().contact_stored, 0.0);
    EXPECT_LT(run.imbalance, 1e-10 * run.ledger.scale());
    EXPECT_LT(run.linear_momentum_error, 1e-9 * std::sqrt(2.0 * p.mass.total() * run.ledger.scale()));
  });
}

// A periodic cell in flight: opposite nodes along y and z part by nothing, and the sum of coefficients being zero, the
// momentum stays.
TEST_P(Equations, OfAPeriodicCellKeepMomentum) {
  if (GetParam().kind == SchemeKind::statics) GTEST_SKIP() << "without inertia";
  with_each_enforcement([](SchemeKind kind, EnforcementKind enforcement) {
    Model model = one_part(one_block());
    for (std::size_t n = 0; n < model.mesh->node_count(); ++n) {
      const Vec3& X = model.mesh->coordinates[n];
      for (int c = 0; c < 3; ++c) {
        const auto master = [&](const Vec3& at) { return node_at(model, at); };
        if (X[1] == 1.0)
          model.equations.push_back({"y", {{static_cast<Index>(n), c, 1.0}, {master({X[0], 0.0, X[2]}), c, -1.0}}});
        else if (X[2] == 1.0)
          model.equations.push_back({"z", {{static_cast<Index>(n), c, 1.0}, {master({X[0], X[1], 0.0}), c, -1.0}}});
      }
    }
    const Problem p(std::move(model), mass_of(kind));
    State begin = p.moving({0.1, -0.2, 0.05});
    for (std::size_t n = 0; n < p.model.mesh->node_count(); ++n)
      begin.v[3 * n] += 0.1 * (p.model.mesh->coordinates[n][0] - 1.0);
    const double h = step_of(p, kind);
    const History run = march(*scheme_on(p, kind, enforcement, h), begin, h, static_cast<int>(3.0 / h));
    ASSERT_TRUE(run.converged) << run.failure;
    EXPECT_LT(largest_value(p.model, run.state.q), 1e-13);
    EXPECT_LT(largest_value(p.model, run.state.v), 1e-12);
    EXPECT_LT(run.imbalance, 1e-10 * run.ledger.scale());
    EXPECT_LT(run.linear_momentum_error, 1e-10 * std::sqrt(2.0 * p.mass.total() * run.ledger.scale()));
    // The sides cannot narrow: uniaxial strain, of which only the mean moves.
    for (std::size_t n = 0; n < p.model.mesh->node_count(); ++n)
      EXPECT_NEAR(run.state.q[3 * n + 1], -0.2 * run.state.t, 1e-9);
  });
}

// One end of a block is driven at a constant acceleration, which then stops, and the other follows as twice as far:
// what is imposed is a coefficient like another. Explicit schemes see the jump of the acceleration a step late, and
// take it back at the rate of their ties (both roots at 0.05 of a step): some steps' worth of it.
TEST_P(Equations, FollowADrivenNode) {
  if (GetParam().kind == SchemeKind::tchamwa_wielgosz || GetParam().kind == SchemeKind::nonsmooth_generalized_alpha)
    GTEST_SKIP() << "refused: build/stage.cpp";
  with_each_enforcement([](SchemeKind kind, EnforcementKind enforcement) {
    Model model = one_part(one_block());
    const std::vector<Index> begin = model.mesh->nodes_of("XMIN");
    model.motions.push_back({"driven", begin, 0, MotionKind::velocity, {{0.0, 1.5, 10.0}, {0.0, 0.03, 0.03}}});
    block(model, "XMIN", {1, 2});
    for (const Index n : model.mesh->nodes_of("XMAX"))
      model.equations.push_back({"end", {{n, 0, 1.0}, {begin.front(), 0, -2.0}}});
    const Problem p(std::move(model), mass_of(kind));
    const double h = step_of(p, kind);
    double smooth = 0.0, after = 0.0;
    const auto look = [&](const State& now) {
      double& most = now.t < 1.5 ? smooth : after;
      most = std::max(most, largest_value(p.model, now.q));
    };
    const History run = march(*scheme_on(p, kind, enforcement, h), p.moving({}), h, static_cast<int>(3.0 / h), look);
    ASSERT_TRUE(run.converged) << run.failure;
    ASSERT_GT(largest(run.state.q), 0.1);
    EXPECT_LT(smooth, 1e-12);
    const double jump = 0.02 * h * h;
    EXPECT_LT(after / jump, is_explicit(kind) ? 8.0 : 1e-9);
    EXPECT_LT(run.imbalance, 1e-9 * run.ledger.scale());
  });
}

// A block falls on a plane with a face that equations keep plane, so that one of its rows would do: contact and
// equations at the same nodes.
TEST_P(Equations, StandBesideContactAtTheirNodes) {
  if (GetParam().kind == SchemeKind::statics) GTEST_SKIP() << "without inertia";
  with_each_enforcement([](SchemeKind kind, EnforcementKind enforcement) {
    Model model = one_part(one_block());
    const std::vector<Index> foot = model.mesh->nodes_of("ZMIN");
    for (std::size_t k = 1; k < foot.size(); ++k)
      model.equations.push_back({"foot", {{foot[k], 2, 1.0}, {foot[0], 2, -1.0}}});
    model.contacts.emplace_back(plane_below(model, 0.01, 20.0));
    const Problem p(std::move(model), mass_of(kind));
    const double h = is_explicit(kind) ? 0.3 * stable_step(p.system).dt : 0.02;
    double touched = 0.0, deepest = 0.0, broken = 0.0;
    const auto look = [&](const State& now) {
      const ContactResponse& response = now.forces.rows;
      for (std::size_t r = 0; r < response.force.size(); ++r)
        if (response.rows->source[r] >= 0) touched = std::max(touched, response.force[r][0]);
      for (const Index n : p.model.mesh->nodes_of("ZMIN"))
        deepest = std::max(deepest, -0.01 - now.q[3 * static_cast<std::size_t>(n) + 2]);
      broken = std::max(broken, largest_value(p.model, now.q));
    };
    const History run =
        march(*scheme_on(p, kind, enforcement, h), p.moving({0.0, 0.0, -0.05}), h, static_cast<int>(3.0 / h), look);
    ASSERT_TRUE(run.converged) << run.failure;
    EXPECT_GT(touched, 0.0);
    EXPECT_LT(deepest, 0.0112);  // of a rigid one: v (m / k)^1/2 = 0.05 (2 / 40)^1/2
    EXPECT_LT(broken, 1e-12);
    EXPECT_LT(run.imbalance, 1e-9 * run.ledger.scale());
    EXPECT_LT(run.linear_momentum_error, 1e-9 * std::sqrt(2.0 * p.mass.total() * run.ledger.scale()));
  });
}

INSTANTIATE_TEST_SUITE_P(AllSchemes, Equations, testing::ValuesIn(schemes_with_mass()),
                         [](const auto& of) { return std::string(of.param.name); });

// Statics: a bar under a force at its end, of which u_x(end) = 3 u_x(middle) is asked. Alone it would be 2. With
// the stiffness k of each half, the force F at the end and l, which the equation adds there, and -3 l in the middle,
//   k (2 u_m - u_e) = -3 l,  k (u_e - u_m) = F + l,  u_e = 3 u_m  =>  u_m = 3 F / (5 k),  l = F / 5.
TEST(EquationStatics, LeverOfABarHasAKnownAnswer) {
  for (const EnforcementKind enforcement :
       {EnforcementKind::penalty, EnforcementKind::augmented_lagrangian, EnforcementKind::lagrange}) {
    SCOPED_TRACE(static_cast<int>(enforcement));
    StructuredBlock bar;
    bar.size = {2.0, 1.0, 1.0};
    bar.divisions = {2, 1, 1};
    bar.face_groups = {"XMIN", "XMAX", "", "", "", ""};
    Model model = one_part(make_structured_blocks({bar}));
    model.parts[0].material = LinearElastic{{.E = 5.0, .nu = 0.0, .rho = 1.0}};
    block(model, "XMIN", {0, 1, 2});
    const std::vector<Index> end = model.mesh->nodes_of("XMAX");
    for (const Index n : end) {
      const Vec3& X = model.mesh->coordinates[static_cast<std::size_t>(n)];
      model.equations.push_back({"lever", {{n, 0, -1.0}, {node_at(model, {1.0, X[1], X[2]}), 0, 3.0}}});
    }
    model.loads.push_back(NodalForce{end, {0.25, 0.0, 0.0}, {{0.0, 1.0}, {0.0, 1.0}}});
    const Problem p(std::move(model));
    const History run = march(*scheme_on(p, SchemeKind::statics, enforcement, 1.0), p.moving({}), 1.0, 1);
    ASSERT_TRUE(run.converged) << run.failure;
    const double u = 3.0 / (5.0 * 5.0);  // F = 1, k = E A / 1 = 5
    for (const Index n : end) EXPECT_NEAR(run.state.q[3 * static_cast<std::size_t>(n)], 3.0 * u, 1e-12);
    const ContactResponse& rows = run.state.forces.rows;
    ASSERT_EQ(rows.rows->size(), 4U);
    for (const Vec3& force : rows.force) EXPECT_NEAR(force[0], 0.2 * 0.25, 1e-11);
  }
}

}  // namespace
}  // namespace carom::schemes_equation_test
