// Swift's hardening at single points: its equation, its work, the largest rate.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "material_points.hpp"

namespace carom::test::material_swift_test {
namespace {

constexpr double E = 200.0, nu = 0.3, G = E / (2 * (1 + nu)), yield = 1.0, pre_strain = 0.01, exponent = 0.2;
constexpr double round_off = 1e-13;  // some hundred operations on numbers near 1
const double root_3 = std::sqrt(3.0);

double sigma_y(double alpha) {
  return yield * std::pow(1.0 + alpha / pre_strain, exponent);
}

// sqrt(3) tau = sigma_y(alpha) and gamma = tau / G + sqrt(3) alpha, in one step or in many; the work is the integral.
TEST(Swift, ShearMeetsItsEquationInAnyNumberOfSteps) {
  const PointLaw law(swift(E, nu));
  const double gamma = 0.3;
  for (const int steps : {1, 10, 1000}) {
    std::vector<double> history = law.rest();
    Answer answer{};
    for (int i = 1; i <= steps; ++i) {
      answer = law.update({0, 0, 0, gamma * i / steps, 0, 0}, history);
      history = answer.history;
    }
    const double alpha = history[6], left = std::pow(1.0 + alpha / pre_strain, exponent + 1.0) - 1.0;
    EXPECT_GT(alpha, 0.1);
    EXPECT_NEAR(root_3 * answer.stress[3], sigma_y(alpha), round_off);
    EXPECT_NEAR(answer.stress[3] / G + root_3 * alpha, gamma, round_off);
    EXPECT_NEAR(answer.dissipation, yield * pre_strain / (exponent + 1.0) * left, round_off);
    EXPECT_NEAR(answer.energy, 0.5 * answer.stress[3] * answer.stress[3] / G, round_off);
  }
}

// Steps of any size, from rest and from far; with the exponents 0 and 1 the curve is straight.
TEST(Swift, ReturnMeetsTheYieldStress) {
  for (const double n : {0.0, 0.1, 0.5, 1.0})
    for (const double e : {1e-6, 1e-3, 1.0}) {
      const Swift curve{yield, e, n};
      for (const double alpha : {0.0, 1e-7, 0.01, 2.0})
        for (const double beyond : {1e-9, 0.1, 3.0, 200.0}) {
          const double own[2] = {alpha, 0.0}, begin = curve.begin(own).stress, trial = begin + beyond;
          RadialReturn<double> at_end{1.0, 1.0, {alpha, 0.0, 0.0}};
          curve.flow(curve.begin(own), 3 * G, trial, 0.0, at_end);
          const double end = yield * std::pow(1.0 + at_end.variables[0] / e, n);
          // the rounding of alpha, which the slope of the curve sees
          EXPECT_NEAR(at_end.share * trial, end, 1e-14 * trial + 1e-15 * alpha * n * end / (e + alpha)) << n << e;
          EXPECT_EQ(at_end.variables[1], 0.0) << "no time, no rate";
        }
    }
}

// A path of strain that closes gives back what is not dissipated: the work, by the trapezoidal rule, is the change of
// stored and dissipated energy, to the square of its 20,000 steps.
TEST(Swift, WorkOnAClosedPathIsStoredOrDissipated) {
  const PointLaw law(swift(E, nu));
  std::vector<double> history = law.rest();
  Answer before{};
  const int steps = 20000;
  double work = 0.0;
  for (int i = 1; i <= steps; ++i) {
    const double turn = 2 * std::acos(-1.0) * i / steps, s = std::sin(turn), c = 1 - std::cos(turn);
    const Answer now = law.update({0.02 * s, -0.01 * c, 0.005 * s, 0.03 * c, -0.01 * s, 0.02 * s}, history);
    for (std::size_t k = 0; k < 6; ++k)
      work += 0.5 * (now.stress[k] + before.stress[k]) * (now.strain[k] - before.strain[k]);
    before = now;
    history = now.history;
  }
  EXPECT_GT(before.dissipation, 0.1);
  EXPECT_NEAR(work, before.energy + before.dissipation, 1e-6);
}

// Of steps with known increments of alpha; one that is elastic or slower leaves it.
TEST(Swift, RemembersTheLargestRate) {
  const PointLaw law(swift(E, nu));
  std::vector<double> history = law.rest();
  double largest = 0.0;
  for (const auto& [gamma, dt] : {std::pair{0.02, 0.5}, {0.05, 0.1}, {0.06, 1.0}, {0.055, 1e-9}, {0.07, 1e-3}}) {
    const Answer answer = law.update({0, 0, 0, gamma, 0, 0}, history, dt);
    largest = std::max(largest, (answer.history[6] - history[6]) / dt);
    EXPECT_NEAR(answer.history[7], largest, 1e-13 * largest / dt);  // the rounding of a difference, over dt
    history = answer.history;
  }
  EXPECT_GT(largest, 1.0);
}

}  // namespace
}  // namespace carom::test::material_swift_test
