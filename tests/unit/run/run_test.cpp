// The loop over the steps: times, halving, alarms, and what a failed run leaves behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "march/step_control.hpp"
#include "run_fixture.hpp"

namespace carom::run_test {
namespace {

using namespace test;

TEST(StepControl, ReachesExactMultiplesOfTheStep) {
  StepControl control(0.0, 2e-6, 70, StepControl::Halving::allowed);
  int steps = 0;
  while (!control.at_end()) {
    ++steps;
    EXPECT_EQ(control.t_end_of_step(), steps * 2e-6);
    control.accept();
  }
  EXPECT_EQ(steps, 70);
}

TEST(StepControl, HalvesAndGrowsBackOntoTheGrid) {
  StepControl control(0.0, 1.0, 3, StepControl::Halving::allowed);
  EXPECT_TRUE(control.halve());
  EXPECT_TRUE(control.halve());
  EXPECT_EQ(control.dt(), 0.25);
  EXPECT_EQ(control.t_end_of_step(), 0.25);
  std::vector<double> times;
  double largest_step = 0.0;
  while (!control.at_end()) {
    times.push_back(control.t_end_of_step());
    largest_step = std::max(largest_step, control.dt());
    control.accept();
  }
  // Grows after four successes where the time is a multiple of the longer step: 4 quarters, then halves.
  EXPECT_EQ(times, (std::vector<double>{0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0}));
  EXPECT_EQ(largest_step, 0.5);
}

TEST(StepControl, GivesUpAtTheSmallestStepOrAtOnceWhereTheCaseFixesIt) {
  StepControl control(0.0, 1.0, 1, StepControl::Halving::allowed);
  int halvings = 0;
  while (control.halve()) ++halvings;
  EXPECT_EQ(halvings, 16);
  EXPECT_EQ(control.dt(), 1.0 / 65536);
  EXPECT_FALSE(StepControl(0.0, 1.0, 1, StepControl::Halving::forbidden).halve());
}

/// Slides over a rough plane in one direction while it turns: the contact state needs several iterations.
std::string sliding_case(const std::string& time) {
  return case_of_block(R"(
[[initial]]
part = "body"
velocity = [0.0075, 0.0025, -0.01]
[[initial]]
nodes = "HEAD"
velocity = [0.0025, 0.0075, -0.005]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, -0.0025]
normal = [0.0, 0.0, 1.0]
stiffness = 20.0
tangential_stiffness = 10.0
friction = 0.3
[scheme]
kind = "newmark"
[solver]
max_contact_iterations = 4
[time]
end = 4.0
step = 0.8
)" + time);
}

TEST(Run, HalvesStepsThatFailAndArrivesExactly) {
  const TemporaryCase one(sliding_case(""));
  EXPECT_NE(one.run(), ExitCode::run_failed) << one.result("summary.json");
  const std::string energy = one.result("energy.csv");
  const std::vector<double> dt = column(energy, "dt"), time = column(energy, "time"),
                            imbalance = column(energy, "imbalance"), kinetic = column(energy, "kinetic");
  ASSERT_GT(dt.size(), 6U);
  EXPECT_LE(*std::min_element(dt.begin() + 1, dt.end()), 0.4);
  EXPECT_EQ(time.back(), 4.0);
  EXPECT_LT(std::abs(imbalance.back()), 1e-10 * kinetic.front());
}

TEST(Run, FailsWhereTheCaseFixesTheStep) {
  const TemporaryCase one(sliding_case("fixed = true\n"));
  EXPECT_EQ(one.run(), ExitCode::run_failed);
  const std::string summary = one.result("summary.json");
  EXPECT_NE(summary.find("\"outcome\": \"error\""), std::string::npos) << summary;
  EXPECT_NE(summary.find("step 1 from t = 0 failed: "), std::string::npos) << summary;
  EXPECT_NE(summary.find("the case fixes the step, so it was not halved"), std::string::npos) << summary;
  EXPECT_EQ(column(one.result("energy.csv"), "time"), std::vector<double>{0.0});  // what was computed is there
  EXPECT_FALSE(one.result("report.html").empty());
}

// With beta = 0.05 Newmark is stable for omega h <= 2 / sqrt(1 - 4 beta) = 2.24 only (Hughes, The Finite Element
// Method, section 9.1.2); here omega h is above 4.
TEST(Run, StopsWhenTheEnergyGrowsAndNamesTheWorstPlace) {
  const TemporaryCase one(case_of_block(R"(
[[initial]]
nodes = "HEAD"
velocity = [0.0, 0.0, 0.1]
[scheme]
kind = "newmark"
beta = 0.05
[time]
end = 100.0
step = 2.0
fixed = true
)"));
  EXPECT_EQ(one.run(), ExitCode::run_failed);
  const std::string summary = one.result("summary.json"), energy = one.result("energy.csv");
  EXPECT_NE(summary.find("the mechanical energy has grown by "), std::string::npos) << summary;
  EXPECT_NE(summary.find("worst node "), std::string::npos) << summary;
  EXPECT_NE(summary.find(", in cell "), std::string::npos) << summary;
  const std::vector<double> kinetic = column(energy, "kinetic"), strain = column(energy, "strain");
  ASSERT_GT(kinetic.size(), 1U);
  EXPECT_LT(column(energy, "time").back(), 100.0);
  EXPECT_GT(kinetic.back() + strain.back(), 1.05 * kinetic.front());
  EXPECT_LE(kinetic[kinetic.size() - 2] + strain[strain.size() - 2], 1.05 * kinetic.front());
  EXPECT_NE(one.result("fields.xdmf").find("</Xdmf>"), std::string::npos);
}

TEST(Run, StopsWhenNumbersOverflow) {
  for (const char* scheme : {"kind = \"newmark\"", "kind = \"central_differences\""}) {
    const TemporaryCase one(case_of_block(R"(
[[load]]
group = "HEAD"
force = [0.0, 0.0, 1e300]
[scheme]
)" + std::string(scheme) + "\n[time]\nend = 1.0\nstep = 0.1\n"));
    EXPECT_EQ(one.run(), ExitCode::run_failed);
    EXPECT_NE(one.result("summary.json").find("not finite"), std::string::npos) << one.result("summary.json");
  }
}

// At rest, then loaded by a ramp: the first steps begin with no force, no motion and no energy.
TEST(Run, ABodyAtRestFollowsALoadThatGrowsFromZero) {
  const TemporaryCase one(case_of_block(R"(
[functions.ramp]
time = [0.0, 2.0]
value = [0.0, 1.0]
[[load]]
gravity = [0.0, 0.0, -0.5]
function = "ramp"
[scheme]
kind = "newmark"
[time]
end = 2.0
step = 0.01
fixed = true
[[probe]]
name = "head"
group = "HEAD"
quantities = ["velocity"]
[[check]]
quantity = "velocity_z"
place = "head"
value = -0.5
tolerance = 1e-9
source = "free fall under 0.5 t / 2: v = 0.5 t^2 / 4 at t = 2; the trapezoidal rule is exact for a ramp"
)"));
  EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
}

}  // namespace
}  // namespace carom::run_test
