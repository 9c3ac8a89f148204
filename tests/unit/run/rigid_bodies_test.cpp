// Rigid bodies that turn, from the case to the results.
#include <gtest/gtest.h>

#include "run_fixture.hpp"

namespace carom::run_rigid_bodies_test {
namespace {

using namespace test;

/// A free sphere far below the block of the fixture; `rest` gives its inertia.
std::string case_of_sphere(const std::string& rest) {
  return case_of_block(R"(
[[contact]]
name = "ball"
kind = "sphere"
group = "FOOT"
centre = [1.0, 1.0, -9.0]
radius = 1.0
mass = 2.0
)" + rest + R"(
[scheme]
kind = "central_differences"
[time]
end = 2.0
[[probe]]
name = "near"
point = [1.0, 1.0, -9.0]
within = 9.0
quantities = ["velocity"]
)");
}

// About a principal axis a free body spins steadily; the stretched axes ring by (omega / frequency)^2 < 2e-4.
TEST(RigidBodies, AreInTheHistoryAndInTheBooks) {
  const TemporaryCase one(case_of_sphere(R"(
inertia = [0.8, 0.8, 0.8]
velocity = [0.5, 0.0, -1.0]
angular_velocity = [0.0, 0.0, 0.02]
)"));
  ASSERT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
  const auto contact = last_row(one.result("contact.csv")), energy = last_row(one.result("energy.csv"));
  EXPECT_NEAR(contact.at("ball.displacement_x"), 1.0, 1e-13);
  EXPECT_NEAR(contact.at("ball.displacement_z"), -2.0, 1e-13);
  EXPECT_NEAR(contact.at("ball.velocity_z"), -1.0, 1e-13);
  EXPECT_NEAR(contact.at("ball.angular_velocity_z"), 0.02, 2e-4 * 0.02);
  EXPECT_NEAR(contact.at("ball.angular_velocity_x"), 0.0, 1e-13);
  EXPECT_NEAR(energy.at("momentum_z"), -2.0, 1e-13);
  // 1/2 m v^2 + 1/2 I omega^2; about the origin x cross m v and I omega: -9 x ... only z: 1 x 0 - 1 x m 0.5 + I omega
  EXPECT_NEAR(energy.at("kinetic") + energy.at("strain"), 1.25 + 0.5 * 0.8 * 0.0004, 1e-8);
  EXPECT_NEAR(energy.at("angular_momentum_z"), -1.0 * 2.0 * 0.5 + 0.8 * 0.02, 1e-13);
  EXPECT_NE(one.result("summary.json").find("rigid body strain"), std::string::npos);
  // The nearest node of a part is at rest; the nodes of the ball are nearer.
  EXPECT_EQ(last_row(one.result("probes.csv")).at("near.velocity_z"), 0.0);
}

TEST(RigidBodies, WithoutInertiaDoNotTurn) {
  const TemporaryCase one(case_of_sphere("velocity = [0.5, 0.0, -1.0]\n"));
  ASSERT_EQ(one.run(), ExitCode::good);
  const auto contact = last_row(one.result("contact.csv"));
  EXPECT_NEAR(contact.at("ball.velocity_z"), -1.0, 1e-15);
  EXPECT_FALSE(contact.contains("ball.angular_velocity_z"));
  EXPECT_EQ(one.result("summary.json").find("rigid body strain"), std::string::npos);
}

TEST(RigidBodies, WithAnInertiaThatNoBodyHasAreRefused) {
  const CaseError e = case_error(case_of_sphere("inertia = [1.0, 1.0, 2.5]\n"));
  EXPECT_EQ(
      std::string(e.what()).find("case.toml:23:11: contact.inertia: found principal moments of inertia 1, 1, 2.5"), 0U)
      << e.what();
}

}  // namespace
}  // namespace carom::run_rigid_bodies_test
