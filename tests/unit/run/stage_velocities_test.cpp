// Velocities begin with their stage: the first one with inertia, or the one that they are given to.
#include <gtest/gtest.h>

#include "run_fixture.hpp"

namespace carom::run_stage_velocities_test {
namespace {

using namespace test;

/// The block stands on a plane under its weight and a pressure, another of 1 x 1 x 1 (mass 1.5) flies above it.
std::string preload(const std::string& rest) {
  return case_of_block(R"(
[[mesh.block]]
origin = [0.5, 0.5, 4.0]
size = [1.0, 1.0, 1.0]
divisions = [1, 1, 1]
groups = { cells = "FLYER" }
[[part]]
name = "flyer"
cells = "FLYER"
material = "soft"
[[support]]
nodes = "FOOT"
blocked = ["x", "y", "z"]
[[load]]
gravity = [0.0, 0.0, -0.01]
[[load]]
pressure = 0.02
group = "HEAD"
[scheme]
kind = "statics"
[time]
end = 1.0
step = 0.5
[[probe]]
name = "flyer"
group = "FLYER"
quantities = ["displacement", "velocity"]
)" + rest);
}

const char* const flight = R"(
[[stage]]
kind = "newmark"
end = 2.0
step = 0.25
)";

/// A column of the last row.
double at_end(const std::string& csv, const std::string& name) {
  return last_row(csv).at(name);
}

TEST(StageVelocities, OfTheCaseBeginWithTheFirstStageWithInertia) {
  const TemporaryCase one(preload(std::string(R"(
[[initial]]
part = "flyer"
velocity = [0.25, 0.0, 0.5]
)") + flight));
  EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
  const std::string probes = one.result("probes.csv");
  const std::vector<double> t = column(probes, "t"), z = column(probes, "flyer.displacement_z"),
                            x = column(probes, "flyer.displacement_x");
  ASSERT_EQ(z.size(), 7U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(z[i], 0.0);  // neither flies nor falls while there is no inertia
  // v t - g t^2 / 2, which the trapezoidal rule meets exactly
  EXPECT_NEAR(z.back(), 0.5 - 0.005, 1e-13);
  EXPECT_NEAR(x.back(), 0.25, 1e-13);
  const std::string energy = one.result("energy.csv");
  EXPECT_NEAR(at_end(energy, "algorithmic"), column(energy, "algorithmic")[2], 1e-12);
  EXPECT_NEAR(column(energy, "kinetic")[3], 0.75 * (0.0625 + 0.4975 * 0.4975), 1e-12);  // after 0.25 s
}

TEST(StageVelocities, MayBeGivenToAStage) {
  const TemporaryCase one(preload(std::string(flight) + R"(
[[stage]]
kind = "central_differences"
end = 3.0
[[stage.initial]]
part = "flyer"
velocity = [0.0, 0.0, 2.0]
[[initial]]
part = "flyer"
velocity = [0.25, 0.0, 0.5]
)"));
  EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
  const std::string probes = one.result("probes.csv");
  EXPECT_NEAR(last_row(probes).at("flyer.displacement_z"), 0.495 + 2.0 - 0.005, 1e-12);
  EXPECT_NEAR(last_row(probes).at("flyer.displacement_x"), 0.25, 1e-12);
}

// A block of mass 18 rests on a floor: 0.18 of weight in statics, whether it is pushed along the floor later or not; at
// rest its momentum is rounding, to be compared with the impulse of its weight.
TEST(StageVelocities, LetBodiesRestOnWhatTheyTouch) {
  const std::string resting = case_of_block(R"(
[[load]]
gravity = [0.0, 0.0, -0.01]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
friction = 0.3
[scheme]
kind = "statics"
[time]
end = 1.0
step = 0.5
[[stage]]
kind = "generalized_alpha"
end = 2.0
step = 0.02
)");
  const std::string pushed = "[[stage.initial]]\npart = \"body\"\nvelocity = [0.001, 0.0, 0.0]\n";
  for (const std::string& later : {std::string(), pushed}) {
    const TemporaryCase one(resting + later);
    EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
    const std::vector<double> force = column(one.result("contact.csv"), "floor.force_z");
    EXPECT_NEAR(force.at(1), 0.18, 1e-10);  // 1e-10: solver, of sums of some 30 forces
    EXPECT_NEAR(force.at(2), 0.18, 1e-10);
  }
}

// Springs of statics that impulses do not have are gone with it. The block stays, pushed by less than friction holds.
TEST(StageVelocities, StayNoneWhereSpringsOfStaticsEnd) {
  const TemporaryCase one(case_of_block(R"(
[[load]]
gravity = [0.004, 0.0, -0.01]
function = "ramp"
[functions.ramp]
time = [0.0, 1.0]
value = [0.0, 1.0]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
friction = 0.5
[scheme]
kind = "statics"
enforcement = "penalty"
[time]
end = 1.0
step = 0.1
[[stage]]
kind = "cd_lagrange"
end = 2.0
)"));
  EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
  EXPECT_GT(column(one.result("energy.csv"), "contact_stored").at(10), 1e-6);
  EXPECT_LT(at_end(one.result("energy.csv"), "kinetic"), 1e-20);
  EXPECT_NEAR(at_end(one.result("contact.csv"), "floor.force_z"), 0.18, 1e-9);
}

TEST(StageVelocities, AreNoneInStatics) {
  const std::string text = preload(R"(
[[stage]]
kind = "statics"
end = 2.0
step = 1.0
[[stage.initial]]
part = "flyer"
velocity = [0.0, 0.0, 2.0]
)");
  try {
    parse_case(text, "case.toml");
    FAIL() << "no error";
  } catch (const CaseError& error) {
    EXPECT_NE(std::string(error.what()).find("a velocity in statics"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace carom::run_stage_velocities_test
