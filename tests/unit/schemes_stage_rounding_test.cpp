// What an implicit stage takes for rounding.
#include <gtest/gtest.h>

#include <cstddef>

#include "enforcement/exact_port.hpp"
#include "schemes/implicit_stage.hpp"
#include "schemes_fixture.hpp"

namespace carom::schemes_stage_rounding_test {
namespace {

using namespace test;

/// M y + F(x) = 0 with x = x_hat + y, of a block of edges of 1 that has been shifted by 1. F is no force of its cells:
/// c against each component of the motion, whichever way it goes, so that none is in balance.
StageReport unbalanced(double E, double c) {
  LinearElastic material = unit_material;
  material.E = E;
  const Problem p(one_part(block_mesh({1, 1, 1}, 0.0), material), MassKind::lumped);
  State begin = p.moving({});
  begin.q.assign(begin.q.size(), 1.0);
  const StageForce force{[&](const PointStep& /*step*/, State& end) {
                           for (std::size_t i = 0; i < end.q.size(); ++i)
                             end.forces.internal[i] = end.q[i] > begin.q[i] ? c : -c;
                         },
                         [](std::span<const double> x) { return x; }, 0.0};
  ImplicitStage stage(p.system, {.enforcement = EnforcementKind::lagrange}, 0.0, 1.0,
                      std::make_unique<ProjectionPort>(p.system), force);
  stage.start(begin, 0);
  State end = begin;
  const std::vector<double> zero(begin.q.size(), 0.0);
  end.a = zero;
  return stage.solve({.s = 1.0, .x_hat = begin.q, .v_hat = zero, .known = zero}, begin, 1e-24, end);
}

// Where the force of a stage is not that of the cells, as in the projection of contact-stabilised Newmark, their
// stiffness times the rounding of the displacements is none of its rounding. Here that is 1e-4 for E = 1e12, and the
// residual stays at c = 1e-6, which may be all of the force that the stage has. The rounding of the force itself is
// 1e-21. (A projection whose contact did not settle was taken for solved so, and its step made energy.)
TEST(ImplicitStage, TakesNoRoundingOfCellsForThatOfAnotherForce) {
  for (const double E : {1.0, 1e12}) {
    const StageReport report = unbalanced(E, 1e-6);
    EXPECT_FALSE(report.converged) << E;
    EXPECT_NE(report.failure.find("no equilibrium"), std::string::npos) << E << report.failure;
  }
}

}  // namespace
}  // namespace carom::schemes_stage_rounding_test
