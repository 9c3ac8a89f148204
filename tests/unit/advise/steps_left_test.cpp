// Steps that are still to be made, as the line of progress counts them.
#include "advise/steps_left.hpp"

#include <gtest/gtest.h>

#include "march/march.hpp"
#include "run_fixture.hpp"

namespace carom::advise_steps_left_test {
namespace {

using namespace test;

/// What is left after each step.
class Counted : public Observer {
 public:
  Counted(const Simulation& simulation, double end) : left_(simulation, end) {}
  void see(const StepView& view) override {
    if (view.step > 0) seen.push_back(left_.after(view));
  }
  std::vector<double> seen;

 private:
  StepsLeft left_;
};

std::vector<double> left_after_each_step(const std::string& rest) {
  const Simulation simulation(parse_case(case_of_block(rest), "case.toml"));
  March march(simulation);
  Counted counted(simulation, simulation.end());
  march.add(counted);
  march.start();
  while (!march.at_end()) march.step();
  return counted.seen;
}

// Two steps over 99 % of the time, then ten: progress by the time would be at 50 % after the first and at 99 % after
// the second.
TEST(StepsLeft, AreThoseOfStagesToComeAsWell) {
  const std::vector<double> left = left_after_each_step(
      "[scheme]\nkind = \"newmark\"\n[time]\nend = 0.99\nstep = 0.495\n"
      "[[stage]]\nkind = \"newmark\"\nend = 1.0\nstep = 0.001\n");
  ASSERT_EQ(left.size(), 12U);
  for (std::size_t k = 0; k < left.size(); ++k) EXPECT_NEAR(left[k], 11.0 - static_cast<double>(k), 1e-9) << k;
}

// Steps that a contact's springs have shortened: what is left is counted in them, not in those of the start.
TEST(StepsLeft, AreLikeTheLastOnes) {
  const std::vector<double> left = left_after_each_step(
      "[[contact]]\nname = \"wall\"\nkind = \"plane\"\ngroup = \"HEAD\"\npoint = [0.0, 0.0, 3.1]\n"
      "normal = [0.0, 0.0, -1.0]\n[[initial]]\npart = \"body\"\nvelocity = [0.0, 0.0, 1.0]\n"
      "[scheme]\nkind = \"central_differences\"\n[time]\nend = 20.0\n");
  const std::size_t steps = left.size();
  for (std::size_t k = steps / 2; k < steps; ++k)
    EXPECT_NEAR(left[k], static_cast<double>(steps - 1 - k), 0.1 * static_cast<double>(steps)) << k << " of " << steps;
  EXPECT_EQ(left.back(), 0.0);
}

}  // namespace
}  // namespace carom::advise_steps_left_test
