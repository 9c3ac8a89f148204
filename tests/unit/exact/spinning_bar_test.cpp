#include "exact/spinning_bar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace carom::exact_spinning_bar_test {
namespace {

constexpr double pi = std::numbers::pi;
const SpinningBarData data{.half_length = 1.5, .modulus = 8, .density = 2, .spin = 0.1};  // c = 2

/// Tip over w^2 L^3 / c^2 at the time x L / c, by the modes sin((n + 1/2) pi x / L) of the bar in a frame that is held
/// to turn at w = eps c / L, where the pull also grows with u.
double tip_by_modes(double time, double eps) {
  double sum = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const double k = (n + 0.5) * pi, frequency = std::sqrt(k * k - eps * eps);
    sum += 2 / (k * k) * (1 - std::cos(frequency * time)) / (frequency * frequency);
  }
  return sum;
}

TEST(SpinningBar, TipReachesTwiceItsStaticPlace) {
  const SpinningBar bar(data);
  const double scale = 0.01 * std::pow(1.5, 3) / 4;
  EXPECT_NEAR(bar.displacement(1.5, 1.5) / scale, 2.0 / 3, 1e-15);  // 2 L / c = 1.5
  // Modes beyond 20000 leave 2 / (pi^4 3 n^3) = 1e-15.
  for (const double t : {0.2, 0.9, 1.5, 2.4, 5.0})
    EXPECT_NEAR(bar.displacement(1.5, t) / scale, tip_by_modes(t * 2 / 1.5, 0.0), 1e-12) << t;
  // With the growing pull at w L / c = 0.05, as the header says; five digits.
  EXPECT_NEAR(tip_by_modes(2.0, 0.05), 0.66733, 0.5e-5);
}

TEST(SpinningBar, WaveEquationAndBoundariesHold) {
  const SpinningBar bar(data);
  const double h = 1e-3;
  int compared = 0;
  for (int i = 1; i < 20; ++i)
    for (int j = 1; j < 60; ++j) {
      const double x = 1.5 * i / 20, t = 0.0513 * j;
      EXPECT_NEAR(bar.displacement(0, t), 0.0, 1e-16);
      EXPECT_NEAR(bar.stress(1.5, t), 0.0, 1e-16);
      // Central differences: h^2 / 6 times w^2 c (velocity), 8 w^2 / c^2 (stress), 3e-9 at most.
      EXPECT_NEAR((bar.displacement(x, t + h) - bar.displacement(x, t - h)) / (2 * h), bar.velocity(x, t), 1e-8);
      EXPECT_NEAR(8 * (bar.displacement(x + h, t) - bar.displacement(x - h, t)) / (2 * h), bar.stress(x, t), 1e-8);
      // U''' jumps where x +- c t is an odd multiple of L; elsewhere U is a cubic.
      const auto near_kink = [&](double s) { return std::abs(std::remainder(s - 1.5, 3.0)) < 4 * h; };
      if (near_kink(x + 2 * t) || near_kink(x - 2 * t)) continue;
      ++compared;
      const double inertia = 2 * (bar.velocity(x, t + h) - bar.velocity(x, t - h)) / (2 * h);
      const double force = (bar.stress(x + h, t) - bar.stress(x - h, t)) / (2 * h);
      EXPECT_NEAR(inertia, force + 2 * 0.01 * x, 1e-11) << x << ' ' << t;
    }
  EXPECT_GT(compared, 1000);
}

TEST(SpinningBar, WrongDataAreRefused) {
  SpinningBarData wrong = data;
  wrong.density = 0;
  EXPECT_THROW(SpinningBar{wrong}, std::invalid_argument);
  wrong = data;
  wrong.spin = NAN;
  EXPECT_THROW(SpinningBar{wrong}, std::invalid_argument);
}

}  // namespace
}  // namespace carom::exact_spinning_bar_test
