// Marches: the same steps alone, one after the other and side by side; what observers see.
#include "march/march.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "run_fixture.hpp"

namespace carom::run_march_test {
namespace {

std::string dropped(const std::string& scheme) {
  return test::case_of_block(R"([[contact]]
name = "floor"
group = "FOOT"
kind = "plane"
point = [0.0, 0.0, -0.01]
normal = [0.0, 0.0, 1.0]
friction = 0.3
[[initial]]
part = "body"
velocity = [0.05, 0.0, -0.1]
)" + scheme);
}

const char* const kPenalty = R"([scheme]
kind = "newmark"
enforcement = "penalty"
[time]
end = 0.5
step = 0.02
)";
const char* const kImpulses = R"([scheme]
kind = "cd_lagrange"
[time]
end = 0.5
)";

std::vector<State> states(March& march) {
  std::vector<State> list;
  march.start();
  while (!march.at_end() && !march.has_failed()) {
    march.step();
    list.push_back(march.state());
  }
  return list;
}

TEST(March, ManyInOneProcessMakeTheSameSteps) {
  const Simulation implicit(parse_case(dropped(kPenalty), "a.toml"));
  const Simulation explicit_steps(parse_case(dropped(kImpulses), "b.toml"));
  March first(implicit), other(explicit_steps);
  const std::vector<State> alone = states(first), other_alone = states(other);
  ASSERT_GE(alone.size(), 25U);
  March again(implicit);
  EXPECT_EQ(states(again), alone);  // one after the other

  // Side by side: two of one simulation, apart by five steps, and one of another.
  March ahead(implicit), behind(implicit), beside(explicit_steps);
  ahead.start();
  behind.start();
  beside.start();
  for (int i = 0; i < 5; ++i) ahead.step();
  for (std::size_t i = 0; i < alone.size(); ++i) {
    if (!ahead.at_end()) ahead.step();
    if (!beside.at_end()) beside.step();
    behind.step();
    ASSERT_EQ(behind.state(), alone[i]) << i;
  }
  EXPECT_TRUE(ahead.at_end());
  EXPECT_EQ(ahead.state(), alone.back());
  while (!beside.at_end()) beside.step();
  EXPECT_EQ(beside.state(), other_alone.back());
}

TEST(March, KeepsNoCaseOfItsCaller) {
  auto given = std::make_unique<Case>(parse_case(dropped(kPenalty), "a.toml"));
  const Simulation simulation(*given);
  March first(simulation);
  const std::vector<State> before = states(first);
  given.reset();
  March second(simulation);
  EXPECT_EQ(states(second), before);
}

class Noted : public Observer {
 public:
  void see(const StepView& view) override {
    steps.push_back(view.step);
    times.push_back(view.state.t);
    if (view.ends_stage) stage_ends.push_back(view.step);
    if (view.is_last()) lasts.push_back(view.step);
  }
  void leave(const StepView& view) override { left = view.step; }

  std::vector<long long> steps, stage_ends, lasts;
  std::vector<double> times;
  long long left = -1;
};

TEST(March, ObserversSeeEveryStepOnce) {
  const std::string text = dropped(kPenalty) + "[[stage]]\nkind = \"hht\"\nend = 1.0\nstep = 0.1\n";
  const Simulation simulation(parse_case(text, "case.toml"));
  March march(simulation);
  Noted noted;
  march.add(noted);
  march.start();
  while (!march.at_end()) march.step();
  ASSERT_EQ(noted.steps.size(), static_cast<std::size_t>(march.steps()) + 1);
  for (std::size_t i = 0; i < noted.steps.size(); ++i) EXPECT_EQ(noted.steps[i], static_cast<long long>(i));
  EXPECT_EQ(noted.times.front(), 0.0);
  EXPECT_EQ(noted.times.back(), 1.0);
  ASSERT_EQ(noted.stage_ends.size(), 2U);
  EXPECT_EQ(noted.times[static_cast<std::size_t>(noted.stage_ends[0])], 0.5);
  EXPECT_EQ(noted.lasts, std::vector<long long>{march.steps()});
  EXPECT_EQ(noted.left, -1);
  march.leave();
  EXPECT_EQ(noted.left, march.steps());
}

}  // namespace
}  // namespace carom::run_march_test
