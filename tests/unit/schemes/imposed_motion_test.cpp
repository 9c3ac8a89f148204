// Imposed motions are the exact integrals of their functions in every scheme, and their work is booked.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "schemes/scheme_table.hpp"
#include "schemes_explicit_fixture.hpp"

namespace carom::schemes_imposed_motion_test {
namespace {

using namespace test;

TEST(TimeFunction, IsIntegratedPieceByPiece) {
  const TimeFunction f{{1.0, 2.0, 2.0, 4.0}, {1.0, 3.0, -1.0, 0.0}};
  // 1 before; 1 + 2 (t - 1); a jump to -1 at 2; -1 + (t - 2)/2; 0 after.
  EXPECT_DOUBLE_EQ(f.integral(0.0, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(f.integral(0.5, 1.5), 0.5 + 0.75);
  EXPECT_DOUBLE_EQ(f.integral(0.0, 6.0), 1.0 + 2.0 - 1.0);
  EXPECT_DOUBLE_EQ(f.integral(2.0, 3.0), -0.75);
  EXPECT_EQ(f.integral(3.0, 3.0), 0.0);
  EXPECT_EQ(f.integral(5.0, 9.0), 0.0);
  // (2 - s) over [0, 1] is 3/2; (2 - s)(2 s - 1) over [1, 2] is 1/2 + 1/3.
  EXPECT_DOUBLE_EQ(f.second_integral(0.0, 2.0), 1.5 + 5.0 / 6.0);
  // Second integrals add up: that of [0, 6], in parts, by the first integrals.
  EXPECT_NEAR(f.second_integral(0.0, 6.0),
              f.second_integral(0.0, 2.7) + 3.3 * f.integral(0.0, 2.7) + f.second_integral(2.7, 6.0), 1e-14);
  const TimeFunction constant{{0.0}, {3.0}};
  EXPECT_DOUBLE_EQ(constant.integral(-1.0, 2.0), 9.0);
  EXPECT_DOUBLE_EQ(constant.second_integral(1.0, 3.0), 6.0);
}

TEST(TimeFunction, HasTwoValuesWhereItJumps) {
  const TimeFunction f{{1.0, 2.0, 2.0, 4.0}, {1.0, 3.0, -1.0, 0.0}};
  EXPECT_EQ(f(2.0), -1.0);
  EXPECT_EQ(f(2.0, JumpSide::before), 3.0);
  EXPECT_NEAR(f(2.0 * (1.0 + 1e-15), JumpSide::before), 3.0, 1e-13);  // rounding of times that are added up
  for (const double t : {0.5, 1.0, 1.5, 3.0, 4.0, 5.0}) EXPECT_EQ(f(t, JumpSide::before), f(t)) << t;
}

struct Named {
  const char* name;
  TimeFunction function;
};

/// Steps of a tenth: kinks and jumps on and between them, and a pulse that no end of a step sees.
const std::array<Named, 5> functions{{
    {"ramp", {{0.0, 1.0}, {0.0, 1.0}}},
    {"jump on a step", {{0.5, 0.5}, {0.0, 1.0}}},
    {"jump at the end", {{1.0, 1.0}, {0.0, 1.0}}},
    {"jump between steps", {{0.55, 0.55}, {0.2, 1.0}}},
    {"pulse", {{0.52, 0.55, 0.58}, {0.0, 1.0, 0.0}}},
}};

/// A column of two cells whose foot is driven; E so low that a tenth is a stable step. Another node of mass zero is
/// driven as an obstacle's carrier is. What turns does so about the y axis, which travels by half of the function.
Model driven(MotionKind kind, const TimeFunction& f) {
  Mesh mesh = block_mesh({1, 1, 3}, 0.1);
  mesh.coordinates.push_back({0.0, 0.0, -3.0});
  mesh.node_numbers.push_back(1000);
  const auto carrier = static_cast<Index>(mesh.coordinates.size() - 1);
  Model model = one_part(std::move(mesh));
  model.motions.push_back({"foot", model.mesh->nodes_of("ZMIN"), 2, kind, f});
  model.motions.push_back({"carrier", {carrier}, 0, kind, f});
  if (kind != MotionKind::rotation) return model;
  TimeFunction travel = f;
  for (double& value : travel.value) value *= 0.5;
  for (PrescribedMotion& motion : model.motions)
    motion.rotation = ImposedRotation{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, travel};
  return model;
}

/// Along the component of a motion, of a node that is at X and, if `carrier`, moves along x.
double exact(MotionKind kind, const TimeFunction& f, double t, const Vec3& X, bool carrier) {
  switch (kind) {
    case MotionKind::displacement:
      return f(t);
    case MotionKind::velocity:
      return f.integral(0.0, t);
    case MotionKind::acceleration:
      return f.second_integral(0.0, t);
    case MotionKind::rotation:
      break;
  }
  // x = X cos a + Z sin a, z = Z cos a - X sin a
  const double angle = f.integral(0.0, t), c = std::cos(angle), s = std::sin(angle);
  return 0.5 * angle + (carrier ? X[0] * c + X[2] * s - X[0] : X[2] * c - X[0] * s - X[2]);
}
double exact_velocity(MotionKind kind, const TimeFunction& f, double t, const Vec3& X, bool carrier) {
  switch (kind) {
    case MotionKind::displacement:
      return f.derivative(t);
    case MotionKind::velocity:
      return f(t);
    case MotionKind::acceleration:
      return f.integral(0.0, t);
    case MotionKind::rotation:
      break;
  }
  const double angle = f.integral(0.0, t), c = std::cos(angle), s = std::sin(angle);
  return f(t) * (0.5 + (carrier ? X[2] * c - X[0] * s : -X[2] * s - X[0] * c));
}

template <class P>
void expect_exact_motion(const P& p, const SchemeSettings& settings, MotionKind kind, const TimeFunction& f) {
  const double h = 0.1;
  const std::vector<Vec3>& X = p.model.mesh->coordinates;
  // of at most twelve sums of numbers below 1; of products with coordinates up to 3
  const double round_off = kind == MotionKind::rotation ? 5e-15 : 1e-15;
  const auto scheme = make_scheme({p.system, settings, h, 100.0});
  const auto foot = 3 * static_cast<std::size_t>(p.model.mesh->nodes_of("ZMIN")[0]) + 2;
  State state, next;
  state.q.assign(p.solid.dof_count(), 0.0);
  state.v = state.q;
  const std::size_t carrier = state.q.size() - 3;
  scheme->start(state, h);
  EnergyLedger ledger(state.forces.stored, state.forces.total_momentum, 1.0);
  double momentum = 0.0;
  for (int i = 1; i <= 12; ++i) {
    const StepReport report = scheme->step(state, {i * h, h, 1e-14}, next);
    ASSERT_TRUE(report.converged) << report.failure;
    std::swap(state, next);
    ledger.add(report.books, state.forces.total_momentum);
    EXPECT_NEAR(state.q[foot], exact(kind, f, state.t, X[foot / 3], false), round_off) << state.t;
    EXPECT_NEAR(state.q[carrier], exact(kind, f, state.t, X[carrier / 3], true), round_off) << state.t;
    momentum = std::max(momentum, std::abs(ledger.momentum_error().linear[2]));
  }
  const double scale = std::max(ledger.scale(), 1e-3);
  EXPECT_LT(std::abs(ledger.imbalance()), 1e-10 * scale);
  if (settings.kind == SchemeKind::statics) return;
  EXPECT_LT(momentum, 1e-10);
  EXPECT_NEAR(state.v[foot], exact_velocity(kind, f, 1.2, X[foot / 3], false), round_off);
  EXPECT_NEAR(state.v[carrier], exact_velocity(kind, f, 1.2, X[carrier / 3], true), round_off);
}

class ImposedMotionOf : public testing::TestWithParam<SchemeTraits> {};

TEST_P(ImposedMotionOf, IsTheExactIntegral) {
  SchemeSettings settings{.kind = GetParam().kind};
  for (std::size_t e = 0; e < enforcement_count; ++e) {
    if (GetParam().takes[e]) settings.enforcement = static_cast<EnforcementKind>(e);
  }
  for (const MotionKind kind :
       {MotionKind::displacement, MotionKind::velocity, MotionKind::acceleration, MotionKind::rotation}) {
    for (const auto& [name, f] : functions) {
      SCOPED_TRACE(std::string(name) + ", kind " + std::to_string(static_cast<int>(kind)));
      if (settings.kind == SchemeKind::modified_mass) {
        expect_exact_motion(ModifiedProblem(driven(kind, f)), settings, kind, f);
        continue;
      }
      for (const MassKind mass : {MassKind::lumped, MassKind::consistent})
        expect_exact_motion(Problem(driven(kind, f), mass), settings, kind, f);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllSchemes, ImposedMotionOf, testing::ValuesIn(scheme_table),
                         [](const auto& scheme) { return std::string(scheme.param.name); });

/// Newmark 1/4, 1/2 forgets nothing: carried on by its rule, the acceleration of a support would change its sign after
/// every kink for ever, and that of its neighbours through the consistent mass.
TEST(ImposedMotion, DoesNotRingAfterAKink) {
  const TimeFunction f{{0.0, 0.5, 0.5, 0.8}, {0.0, 0.0, 1.0, 0.4}};
  for (const MotionKind kind : {MotionKind::displacement, MotionKind::velocity}) {
    const Problem p(driven(kind, f));
    const auto foot = 3 * static_cast<std::size_t>(p.model.mesh->nodes_of("ZMIN")[0]) + 2;
    const SchemeSettings settings{};  // Newmark 1/4, 1/2
    const auto scheme = make_scheme({p.system, settings, 0.1, 100.0});
    march(*scheme, p.moving({}), 0.1, 20, [&](const State& state) {
      if (state.t < 0.95) return;
      EXPECT_NEAR(state.a[foot], 0.0, 1e-13);
      // Without inertia of its own the support gives what the cells pull: the reaction holds no more than M a of
      // its neighbours and the internal force.
      double inertia = 0.0;
      for (std::size_t i = 2; i < state.a.size(); i += 3)
        inertia = std::max(inertia, std::abs(state.forces.inertia[i]));
      EXPECT_LT(inertia, 2.0);
    });
  }
}

/// Where the acceleration is imposed, the velocity that the nodes begin with is kept: v t + a t^2 / 2.
TEST(ImposedMotion, OfAnAccelerationBeginsWithTheVelocityGiven) {
  const TimeFunction f{{0.0}, {0.5}};
  Model model = driven(MotionKind::acceleration, f);
  const std::vector<Index> foot = model.mesh->nodes_of("ZMIN");
  for (const std::size_t given : {std::size_t{1}, foot.size()}) {
    model.initial = {{foot, {}, std::vector<Vec3>(given, {0.0, 0.0, 0.25}), 0}};
    const Problem p(model);
    const SchemeSettings settings{};
    const auto scheme = make_scheme({p.system, settings, 0.1, 100.0});
    march(*scheme, p.moving({0.0, 0.0, 0.25}), 0.1, 10, [&](const State& state) {
      const double exact = 0.25 * state.t + f.second_integral(0.0, state.t);
      for (const Index n : foot) EXPECT_NEAR(state.q[3 * static_cast<std::size_t>(n) + 2], exact, 1e-15);
    });
  }
}

/// The work of a support that starts a body at once is its kinetic energy, whatever the step: nothing for the scheme.
TEST(ImposedMotion, WorkOfAJumpIsTheKineticEnergy) {
  const TimeFunction f{{0.25, 0.25}, {0.0, 2.0}};
  for (const double h : {0.1, 0.04}) {
    Model model = one_part(block_mesh({1, 1, 1}, 0.0));
    model.motions.push_back({"all", model.mesh->nodes_of("BLOCK"), 2, MotionKind::velocity, f});
    const Problem p(model);
    const SchemeSettings settings{};
    const auto scheme = make_scheme({p.system, settings, h, 100.0});
    const History run = march(*scheme, p.moving({}), h, static_cast<int>(1.0 / h + 0.5));
    const EnergyTerms now = run.ledger.now();
    EXPECT_NEAR(now.kinetic, 3.0, 1e-12);  // 1/2 m v^2 with m = 1.5
    EXPECT_NEAR(now.support_work, 3.0, 1e-12);
    EXPECT_NEAR(now.algorithmic, 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace carom::schemes_imposed_motion_test
