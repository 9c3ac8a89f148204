// Prescribed motions are met exactly, and contradictions are refused.
#include <gtest/gtest.h>

#include "schemes_fixture.hpp"

namespace carom::schemes_motion_test {
namespace {

using namespace test;

const TimeFunction moving_function{{0.0, 1.0, 2.5, 4.0}, {0.1, 0.5, -0.3, 0.2}};

Model driven(MotionKind kind) {
  Model model = one_part(block_mesh({2, 2, 2}, 0.1));
  model.motions.push_back({"drive", model.mesh->nodes_of("ZMIN"), 2, kind, moving_function});
  block(model, "XMIN", {0});
  return model;
}

/// Component of the driven dofs of a vector, all alike.
double driven_value(const Problem& p, const std::vector<double>& x) {
  const std::vector<Index> nodes = p.model.mesh->nodes_of("ZMIN");
  const double value = x[3 * static_cast<std::size_t>(nodes[0]) + 2];
  for (const Index n : nodes) EXPECT_EQ(x[3 * static_cast<std::size_t>(n) + 2], value);
  return value;
}

constexpr double round_off = 1e-12;  // accelerations are differences divided by h^2 = 1e-3: 1e-16 / 1e-3, and sums

TEST(PrescribedMotion, IsMetByNewmark) {
  for (const MotionKind kind : {MotionKind::displacement, MotionKind::velocity, MotionKind::acceleration}) {
    const Problem p(driven(kind));
    const double h = 0.05;
    march(*newmark(p, h), p.moving({}), h, 90, [&](const State& state) {
      const std::vector<double>& x = kind == MotionKind::displacement ? state.q
                                     : kind == MotionKind::velocity   ? state.v
                                                                      : state.a;
      EXPECT_NEAR(driven_value(p, x), moving_function(state.t), round_off);
      for (const Index n : p.model.mesh->nodes_of("XMIN")) EXPECT_EQ(state.q[3 * static_cast<std::size_t>(n)], 0.0);
    });
  }
}

TEST(PrescribedMotion, IsMetByCentralDifferences) {
  for (const MassKind mass : {MassKind::lumped, MassKind::consistent}) {
    for (const MotionKind kind : {MotionKind::displacement, MotionKind::velocity, MotionKind::acceleration}) {
      const Problem p(driven(kind), mass);
      const double h = 0.05;
      ASSERT_LT(h, stable_step(p.system).dt);
      double q_before = 0.0;
      march(*central(p), p.moving({}), h, 90, [&](const State& state) {
        const double q = driven_value(p, state.q);
        if (kind == MotionKind::displacement) {
          EXPECT_NEAR(q, moving_function(state.t), round_off);
        } else if (kind == MotionKind::acceleration) {
          // those of the halves of the steps; 0.4 is the steepest slope
          EXPECT_NEAR(driven_value(p, state.a), moving_function(state.t), 0.5 * h * 0.4);
          EXPECT_NEAR(q, moving_function.second_integral(0.0, state.t), round_off);
        } else if (state.t > 0.0) {  // velocities live at the middle of the steps
          EXPECT_NEAR((q - q_before) / h, moving_function(state.t - 0.5 * h), round_off);
        }
        q_before = q;
      });
    }
  }
}

TEST(PrescribedMotion, OfOneDofMustBeOne) {
  Model model = driven(MotionKind::displacement);
  model.motions.push_back({"other", {0}, 2, MotionKind::velocity, moving_function});
  try {
    const Problem p(model);
    FAIL() << "no error";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "node 1 has two different motions along z: from \"drive\" and from \"other\"");
  }
}

TEST(PrescribedMotion, BlockedTwiceIsBlocked) {
  Model model = one_part(block_mesh({1, 1, 1}, 0.0));
  block(model, "XMIN", {0});
  block(model, "ZMIN", {0});
  const Problem p(model);
  EXPECT_EQ(p.supports.prescribed().size(), 6U);  // two edges share two nodes
}

}  // namespace
}  // namespace carom::schemes_motion_test
