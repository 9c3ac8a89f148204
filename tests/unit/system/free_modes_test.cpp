// Bodies that only contact can hold: their free motions, and how statics goes about them.
#include "system/free_modes.hpp"

#include <gtest/gtest.h>

#include "schemes/statics.hpp"
#include "schemes_fixture.hpp"

namespace carom::schemes_free_modes_test {
namespace {

using namespace test;

Model cube() {
  return one_part(block_mesh({2, 2, 2}, 0.2));
}

std::vector<double> mode(const FreeModes& free, const Problem& p, std::size_t k) {
  std::vector<double> u;
  for (std::size_t n = 0; n < p.solid.node_count(); ++n) {
    const Vec3 v = free.displacement(k, static_cast<Index>(n), {});
    u.insert(u.end(), v.begin(), v.end());
  }
  return u;
}

TEST(FreeModes, AreWhatSupportsLeave) {
  Model model = cube();
  EXPECT_EQ(FreeModes(Problem(model).system).size(), 6U);
  block(model, "XMIN", {0});  // leaves two translations and the turn about x
  EXPECT_EQ(FreeModes(Problem(model).system).size(), 3U);
  block(model, "YMIN", {1});
  EXPECT_EQ(FreeModes(Problem(model).system).size(), 1U);
  block(model, "ZMIN", {2});
  EXPECT_TRUE(FreeModes(Problem(model).system).empty());
}

TEST(FreeModes, MeetNoForceAndNoSupport) {
  Model model = cube();
  block(model, "XMIN", {0});
  const Problem p(model);
  const FreeModes free(p.system);
  std::vector<double> f(p.solid.dof_count());
  for (std::size_t k = 0; k < free.size(); ++k) {
    const std::vector<double> u = mode(free, p, k);
    p.solid.internal_force(u, f);
    const double K = p.solid.tangent_diagonal(u)[0];
    for (std::size_t i = 0; i < f.size(); ++i) {
      EXPECT_NEAR(f[i], 0.0, 1e-13 * K);  // round-off of sums of some dozen terms
      if (p.supports.fixed()[i]) {
        EXPECT_NEAR(u[i], 0.0, 1e-14);
      }
    }
  }
}

TEST(FreeModes, ArePinnedByAsManyFreeDofs) {
  Model model = cube();
  block(model, "XMIN", {0});
  const Problem p(model);
  const FreeModes free(p.system);
  const std::vector<DofSpring> pins = free.pins(0.5);
  ASSERT_EQ(pins.size(), 3U);
  // Every mode moves a pin: the matrix of pins and modes is regular.
  std::vector<std::vector<double>> modes;
  for (std::size_t k = 0; k < 3; ++k) modes.push_back(mode(free, p, k));
  const auto at = [&](std::size_t i, std::size_t k) { return modes[k][pins[i].dof]; };
  const double det = at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) -
                     at(0, 1) * (at(1, 0) * at(2, 2) - at(1, 2) * at(2, 0)) +
                     at(0, 2) * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0));
  EXPECT_GT(std::abs(det), 1e-3);
  for (const DofSpring& pin : pins) {
    EXPECT_FALSE(p.supports.fixed()[pin.dof]);
    EXPECT_EQ(pin.stiffness, free.pins(1.0)[0].stiffness * 0.5);
  }
}

/// 2 x 2 x 2 cells, free, under a pressure of 0.1 on its head, above a plane.
Model pressed_cube(double gap, double mu) {
  Model model = one_part(block_mesh({2, 2, 2}, 0.0), LinearElastic{{.E = 2.0, .nu = 0.3, .rho = 1.5}});
  model.contacts.emplace_back(plane_below(model, gap, 20.0, {20.0, mu}));
  model.loads.emplace_back(Pressure{{faces_of(*model.mesh, "ZMAX")}, 0.1, {}});
  return model;
}

// Uniform pressure, whatever held the body before it touched: free to slide (no friction), or held by friction, which
// uniaxial stress needs none of before the foot spreads.
TEST(StaticsScheme, PressesAFreeBodyOntoAPlane) {
  for (const EnforcementKind e :
       {EnforcementKind::penalty, EnforcementKind::augmented_lagrangian, EnforcementKind::lagrange}) {
    for (const double gap : {0.0, 1e-7, 0.1}) {
      SCOPED_TRACE(std::string(name(e)) + ", gap " + std::to_string(gap));
      const Problem p(pressed_cube(gap, 0.0));
      Statics scheme(p.system, {.enforcement = e, .penetration = 1e-12}, stable_step(p.system).omega_max_squared_free);
      State state = p.moving({}), next;
      scheme.start(state, 1.0);
      const StepReport report = scheme.step(state, {1.0, 1.0, 0.0}, next);
      ASSERT_TRUE(report.converged) << report.failure;
      EXPECT_LE(report.iterations, e == EnforcementKind::penalty ? 2 : 12);
      const ContactResponse& rows = next.forces.rows;
      for (std::size_t r = 0; r < rows.force.size(); ++r)
        EXPECT_NEAR(rows.force[r][0] / rows.rows->measure[r], 0.1, 1e-11);
      const double foot = -gap - (e == EnforcementKind::penalty ? 0.1 / 20.0 : 0.0);
      for (const Index n : p.model.mesh->nodes_of("ZMIN"))
        EXPECT_NEAR(next.q[3 * static_cast<std::size_t>(n) + 2], foot, 1e-10);
    }
  }
}

TEST(StaticsScheme, HoldsAFreeBodyByFriction) {
  for (const EnforcementKind e : {EnforcementKind::penalty, EnforcementKind::lagrange}) {
    SCOPED_TRACE(name(e));
    Model model = pressed_cube(0.0, 0.5);
    model.loads.emplace_back(Gravity{{1e-3, 0.0, 0.0}, {}});  // 1.5e-3 of pressure over the height, below 0.5 x 0.1
    const Problem p(model);
    Statics scheme(p.system, {.enforcement = e}, stable_step(p.system).omega_max_squared_free);
    State state = p.moving({}), next;
    scheme.start(state, 1.0);
    const StepReport report = scheme.step(state, {1.0, 1.0, 0.0}, next);
    ASSERT_TRUE(report.converged) << report.failure;
    double along = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < next.q.size(); i += 3) {
      along += next.forces.contact[i];
      weight += next.forces.external[i];
    }
    EXPECT_NEAR(along, -weight, 1e-10 * weight);
  }
}

// A neo-Hookean block that only contact and friction hold, under 5 % of Young's modulus: its own tangent resists
// turning by less than nothing. The floor bears the whole pressure, and nothing sideways, by the equilibrium of the
// block.
TEST(StaticsScheme, PressesAFiniteStrainBlockThatFrictionHolds) {
  Model model = one_part(block_mesh({3, 3, 3}, 0.0), NeoHookean{{.E = 2.0, .nu = 0.3, .rho = 1.5}});
  model.contacts.emplace_back(plane_below(model, 0.0, 20.0, {20.0, 0.3}));
  model.loads.emplace_back(Pressure{{faces_of(*model.mesh, "ZMAX")}, 0.1, {}});
  const Problem p(model);
  Statics scheme(p.system, {.enforcement = EnforcementKind::lagrange}, stable_step(p.system).omega_max_squared_free);
  State state = p.moving({}), next;
  scheme.start(state, 1.0);
  const StepReport report = scheme.step(state, {1.0, 1.0, 0.0}, next);
  ASSERT_TRUE(report.converged) << report.failure;
  Vec3 floor{}, load{};
  for (std::size_t i = 0; i < next.q.size(); ++i) {
    floor[i % 3] += next.forces.contact[i];
    load[i % 3] += next.forces.external[i];
  }
  EXPECT_LT(load[2], 0.0);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(floor[c], -load[c], 1e-8 * -load[2]);  // what statics is solved to
}

TEST(FreeModes, NeedInertiaWhereStressesTurnThem) {
  Model model = one_part(block_mesh({2, 2, 2}, 0.0), NeoHookean{{.E = 2.0, .nu = 0.0, .rho = 1.5}});
  const Problem p(model);
  const FreeModes free(p.system);
  std::vector<double> u(p.solid.dof_count(), 0.0);
  EXPECT_LT(free.inertia_for_turns(u, {}), 1e-12);  // unstressed: rounding
  for (const double strain : {0.05, -0.05}) {
    for (std::size_t n = 0; n < p.solid.node_count(); ++n) u[3 * n + 2] = strain * model.mesh->coordinates[n][2];
    // In tension turns are resisted; compressed they are not.
    if (strain > 0.0)
      EXPECT_LT(free.inertia_for_turns(u, {}), 1e-12);
    else
      EXPECT_GT(free.inertia_for_turns(u, {}), 0.1);
  }
}

TEST(StaticsScheme, SaysWhatNothingHolds) {
  Model model = pressed_cube(0.0, 0.0);
  model.loads.emplace_back(Gravity{{1.0, 0.0, 0.0}, {}});  // it slides
  const Problem p(model);
  Statics scheme(p.system, {}, stable_step(p.system).omega_max_squared_free);
  State state = p.moving({}), next;
  scheme.start(state, 1.0);
  const StepReport report = scheme.step(state, {1.0, 1.0, 0.0}, next);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.failure.find("no support and no contact holds the body"), std::string::npos) << report.failure;
  EXPECT_NE(report.failure.find("along (1"), std::string::npos) << report.failure;
}

}  // namespace
}  // namespace carom::schemes_free_modes_test
