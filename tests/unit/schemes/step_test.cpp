// Single steps: failures that leave no trace, contact at the edge of a step, and the limit of stability.
#include <gtest/gtest.h>

#include <limits>

#include "schemes_fixture.hpp"

namespace carom::schemes_step_test {
namespace {

using namespace test;

/// A block that flies towards a plane 0.05 below at speed 0.2: it touches at t = 0.25.
Model flying(const Friction& friction = {}) {
  Model model = one_part(block_mesh({2, 2, 2}, 0.0));
  model.contacts.emplace_back(plane_below(model, 0.05, 20.0, friction));
  return model;
}
constexpr Vec3 fall{0.0, 0.0, -0.2};

/// Falls obliquely and turns: sliding along curved paths is not linear, so that it needs several iterations.
State oblique(const Problem& p) {
  State state = p.moving(fall);
  for (std::size_t n = 0; n < p.model.mesh->node_count(); ++n) {
    const Vec3& x = p.model.mesh->coordinates[n];
    state.v[3 * n] = 0.15 - 0.1 * x[1];
    state.v[3 * n + 1] = 0.1 * x[0];
    state.v[3 * n + 2] -= 0.1 * x[0];
  }
  return state;
}

// Two iterations are enough where nothing slides.
TEST(FailedStep, LeavesStateAndSchemeAsTheyWere) {
  for (const SolverKind solver : {SolverKind::cholesky, SolverKind::conjugate_gradients, SolverKind::multigrid}) {
    const Problem p(flying({10.0, 0.3}));
    const ImplicitSettings settings{.max_iterations = 2, .solver = solver};
    const double h = 0.4, half = 0.1;
    const auto scheme = newmark(p, h, {}, settings), fresh = newmark(p, half, {}, settings);
    State state = oblique(p), same = state, next, expected;
    scheme->start(state, h);
    fresh->start(same, half);
    const State kept = state;
    const StepReport failed = scheme->step(state, {h, h, 1e-12}, next);
    EXPECT_FALSE(failed.converged);
    EXPECT_FALSE(failed.failure.empty());
    EXPECT_EQ(state, kept);
    const StepReport again = scheme->step(state, {half, half, 1e-12}, next);
    const StepReport once = fresh->step(same, {half, half, 1e-12}, expected);
    ASSERT_TRUE(again.converged && once.converged) << again.failure << once.failure;
    EXPECT_GT(once.iterations, 0);
    EXPECT_TRUE(next == expected);  // bit by bit
    EXPECT_EQ(again.books.energy.kinetic, once.books.energy.kinetic);
  }
}

TEST(FailedStep, NamesTheRowsThatHaveNotSettled) {
  const Problem p(flying({10.0, 0.3}));
  const auto scheme = newmark(p, 0.4, {}, {.max_iterations = 1});
  State state = oblique(p), next;
  scheme->start(state, 0.4);
  const std::string failure = scheme->step(state, {0.4, 0.4, 1e-12}, next).failure;
  const std::string start = "the contact state does not settle in 1 iterations; these rows cycle: row ";
  EXPECT_EQ(failure.substr(0, start.size()), start);
  EXPECT_NE(failure.find(", 0) slip -> stick"), std::string::npos) << failure;  // the foot is at z = 0
}

TEST(FailedStep, SaysThatForcesAreNotFinite) {
  const Problem p(flying(), MassKind::lumped);
  const double h = 0.01;
  for (const auto& scheme : {newmark(p, h), central(p)}) {
    State state = p.moving(fall), next;
    scheme->start(state, h);
    state.v[5] = std::numeric_limits<double>::quiet_NaN();
    const StepReport report = scheme->step(state, {h, h, 1e-12}, next);
    // Lumped central differences carry on: their run is ended by the energy, which is not finite.
    if (report.converged) {
      EXPECT_FALSE(std::isfinite(report.books.energy.kinetic));
    } else {
      EXPECT_NE(report.failure.find("not finite"), std::string::npos) << report.failure;
    }
  }
}

// Gap 0.05 and speed 0.2 close the gap at t = 0.25: at the end of step 1 and of step 2 for these steps, up to the last
// bit, which decides nothing: both sides give the same motion to round-off.
TEST(Contact, MayCloseExactlyAtTheEndOfAStep) {
  for (const double h : {0.25, 0.125, 0.05}) {
    std::vector<State> states;
    for (const double shift : {-1e-15, 0.0, 1e-15}) {
      Model model = one_part(block_mesh({2, 2, 2}, 0.0));
      model.contacts.emplace_back(plane_below(model, 0.05 + shift, 20.0));
      const Problem p(model);
      const History run = march(*newmark(p, h), p.moving(fall), h, 20);
      ASSERT_TRUE(run.converged);
      EXPECT_LT(run.imbalance, 1e-10 * run.ledger.scale());
      states.push_back(run.state);
    }
    // 1e-15 of gap through 20 steps of a stable scheme, with a margin of 1000; velocities are of order 0.2.
    EXPECT_LT(largest_difference(states[0].v, states[1].v), 1e-12);
    EXPECT_LT(largest_difference(states[2].v, states[1].v), 1e-12);
  }
}

/// A block on node springs of 1 at a penetration of 1 that nodal forces of 1 hold in balance: closed while |u| < 1.
Model resting() {
  Model model = one_part(block_mesh({2, 2, 2}, 0.1));
  ObstacleContact bed;
  bed.name = "bed";
  bed.shape = Plane{{0, 0, 1.0}, {0, 0, 1}};
  bed.measure = RowMeasure::per_node;
  bed.nodes = model.mesh->nodes_of("ZMIN");
  bed.law.eps_N = 1.0;
  model.contacts.emplace_back(bed);
  model.loads.emplace_back(NodalForce{model.mesh->nodes_of("ZMIN"), {0, 0, -1.0}, {}});
  return model;
}

Model hanging() {
  Model model = one_part(block_mesh({2, 2, 2}, 0.1));
  block(model, "ZMIN", {0, 1, 2});
  return model;
}

/// Largest displacement reached in n steps of central differences from random velocities of 1e-8; stops at 1e-2.
double growth(const Problem& p, double h, int n) {
  const auto scheme = central(p);
  State state = p.moving({}), next;
  state.v = random_vector(p.solid.dof_count(), 5);
  for (double& v : state.v) v *= 1e-8;
  scheme->start(state, h);
  for (int i = 1; i <= n && largest(state.q) < 1e-2; ++i) {
    scheme->step(state, {i * h, h, 0.0}, next);
    std::swap(state, next);
  }
  return largest(state.q);
}

TEST(StableStep, IsTheLimitOfCentralDifferences) {
  for (const MassKind kind : {MassKind::lumped, MassKind::consistent}) {
    for (const Model& model : {hanging(), resting()}) {
      const Problem p(model, kind);
      const double stable = stable_step(p.system).dt;
      // Bounded: 1e-8 over the lowest frequencies of order 0.1 to 1, and a drift of 1e-8 x 2000 steps of order 0.5.
      EXPECT_LT(growth(p, 0.999 * stable, 2000), 1e-4);
      EXPECT_GE(growth(p, 1.05 * stable, 2000), 1e-2);
    }
  }
}

TEST(StableStep, FallsWithStiffContactAndDamping) {
  Model stiff = hanging(), damped = hanging();
  stiff.contacts.emplace_back(plane_below(stiff, 0.0, 1000.0));
  stiff.motions.clear();
  damped.contacts.emplace_back(StopContact{"stop", damped.mesh->nodes_of("ZMAX"), {0, 0, -1}, 0.1, 1.0, 5.0});
  const Problem with_wall(stiff, MassKind::lumped), with_damper(damped, MassKind::lumped);
  const StableStep wall = stable_step(with_wall.system), damper = stable_step(with_damper.system);
  EXPECT_LT(wall.dt, 0.3 * wall.dt_free);
  EXPECT_LT(damper.dt, 0.5 * damper.dt_free);
}

}  // namespace
}  // namespace carom::schemes_step_test
