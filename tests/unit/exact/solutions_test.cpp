#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "energy/energy_terms.hpp"
#include "exact/solution.hpp"

namespace carom::exact_solutions_test {
namespace {

constexpr ExactCase given{.until = 3.0, .lowest = 0.0, .parts = 2, .pressed_part = 1};

/// Numbers with which every solution moves, touches and rubs within a second or two: bodies of size, mass, modulus and
/// speed 1 or near it, a wall that is stiff against the bar, and friction that lets the blocks slide.
double moving(const std::string& key) {
  if (key == "stiffness") return 20.0;
  if (key == "friction" || key == "poisson") return 0.25;
  if (key == "angle" || key == "gap") return 0.1;
  if (key == "second.speed") return -0.7;
  return 1.0;
}

std::vector<std::string> keys_of(const ExactSolution& solution) {
  std::vector<std::string> keys;
  for (const ExactParameter& parameter : solution.parameters) keys.push_back(parameter.key);
  for (const ExactBody& body : solution.bodies)
    for (const ExactParameter& parameter : body.parameters) keys.push_back(body.key + "." + parameter.key);
  return keys;
}

ExactValues moving_values(const ExactSolution& solution) {
  ExactValues values;
  for (const std::string& key : keys_of(solution)) values[key] = moving(key);
  return values;
}

/// All that the solution says, at some places and times.
std::vector<double> said(const ExactSolution& solution, const ExactValues& values) {
  const ExactMotion motion = solution.motion(values, given);
  std::vector<ExactCurve> curves{motion.force, motion.obstacle_velocity};
  if (motion.at) {
    for (const ExactPlace& place : {ExactPlace{0.3, 0}, ExactPlace{1.6, 1}}) {
      const ExactPoint point = motion.at(place);
      curves.insert(curves.end(), {point.displacement, point.velocity, point.stress});
    }
  }
  for (const auto& [term, value] : motion.energies) curves.push_back(value);
  std::vector<double> all;
  for (const ExactCurve& curve : curves)
    for (const double t : {0.2, 0.5, 1.1, 1.9, 2.7})
      if (curve) all.push_back(curve(t));
  return all;
}

TEST(ExactSolutions, EveryNumberThatARowAsksForChangesWhatItSays) {
  for (const ExactSolution& solution : exact_solutions()) {
    const std::vector<double> before = said(solution, moving_values(solution));
    EXPECT_FALSE(before.empty()) << solution.name;
    for (const std::string& key : keys_of(solution)) {
      ExactValues values = moving_values(solution);
      values[key] *= 1.1;
      EXPECT_NE(said(solution, values), before) << solution.name << ": " << key;
    }
  }
}

TEST(ExactSolutions, HaveNamesOfTheirOwnAndTermsOfTheLedger) {
  std::set<std::string> names, terms;
  for (const EnergyTerm& term : energy_terms) terms.emplace(term.name);
  for (const ExactSolution& solution : exact_solutions()) {
    EXPECT_TRUE(names.insert(solution.name).second) << solution.name;
    EXPECT_EQ(&exact_solution(solution.name), &solution);
    for (const auto& [term, value] : solution.motion(moving_values(solution), given).energies)
      EXPECT_TRUE(terms.contains(term)) << solution.name << ": " << term;
  }
}

/// By symmetry (and by Newton's third law): two bars that fly at each other press on each of them with the same force.
TEST(ExactSolutions, TheForceOfTwoBarsIsOnThePartThatIsPressed) {
  const ExactSolution& bars = exact_solution("two_bars");
  ExactCase other = given;
  other.pressed_part = 0;
  const double touching = 0.5;  // the gap of 0.1 closes at 1.7, so after 0.06
  const double on_second = bars.motion(moving_values(bars), given).force(touching);
  EXPECT_GT(on_second, 0.0);
  EXPECT_EQ(bars.motion(moving_values(bars), other).force(touching), -on_second);
}

}  // namespace
}  // namespace carom::exact_solutions_test
