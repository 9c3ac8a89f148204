// Head injury criterion, pulse and shock response spectrum of pulses with closed forms.
#include "output/shock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace carom::output_shock_test {
namespace {

constexpr double pi = std::numbers::pi;

/// A sin(pi t / T) within `before` at rest and as much after, dt apart.
std::vector<double> half_sine(double A, double T, double before, double dt) {
  const auto n = static_cast<std::size_t>(std::lround((T + 2.0 * before) / dt)) + 1;
  std::vector<double> a(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = dt * static_cast<double>(i) - before;
    a[i] = t > 0.0 && t < T ? A * std::sin(pi * t / T) : 0.0;
  }
  return a;
}

// a^2.5 times its length, or the window.
TEST(Shock, HeadInjuryOfARectangle) {
  const double dt = 1e-5;
  const std::vector<double> a(1001, 100.0);  // 10 ms
  EXPECT_NEAR(head_injury_criterion(a, dt, 0.015).value, 1000.0, 1e-8);
  const std::vector<double> longer(4001, 100.0);  // 40 ms
  EXPECT_NEAR(head_injury_criterion(longer, dt, 0.015).value, 1500.0, 1e-8);
  const HeadInjury of_36 = head_injury_criterion(longer, dt, 0.036);
  EXPECT_NEAR(of_36.value, 3600.0, 1e-8);
  EXPECT_NEAR(of_36.end - of_36.begin, 0.036, 1e-12);
  EXPECT_EQ(head_injury_criterion(std::vector<double>{}, dt, 0.015).value, 0.0);
  EXPECT_EQ(head_injury_criterion(std::vector(5, 0.0), dt, 0.015).value, 0.0);
}

// Over the middle 2 x T / pi the criterion is A^2.5 (2 T / pi) x^-1.5 sin(x)^2.5, largest where tan x = 5 x / 3: a root
// between 0.9 and 1.2. Windows that are shorter than that lie in the middle.
TEST(Shock, HeadInjuryOfAHalfSine) {
  double low = 0.9, high = 1.2;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (std::tan(x) < 5.0 * x / 3.0 ? low : high) = x;
  }
  const double A = 80.0;
  const auto exact = [&](double T, double x) {
    return std::pow(A, 2.5) * 2.0 * T / pi * std::pow(x, -1.5) * std::pow(std::sin(x), 2.5);
  };
  EXPECT_NEAR(exact(1.0, low) / std::pow(A, 2.5), 0.4146, 5e-5);  // the customary factor
  // The last is so long that ends are looked for in strides first.
  for (const double dt : {1e-5, 1e-6, 1e-7}) {
    const HeadInjury injury = head_injury_criterion(half_sine(A, 0.01, 0.005, dt), dt, 0.015);
    EXPECT_NEAR(injury.value, exact(0.01, low), 3e-6 * injury.value) << dt;  // (pi dt / T)^2 / 12 of the trapezoids
    EXPECT_NEAR(injury.begin, 0.01 - low * 0.01 / pi, 2e-5) << dt;
    EXPECT_NEAR(injury.end, 0.01 + low * 0.01 / pi, 2e-5) << dt;
  }
  const double x = 0.5 * pi * 0.015 / 0.1;
  EXPECT_NEAR(head_injury_criterion(half_sine(A, 0.1, 0.0, 1e-5), 1e-5, 0.015).value, exact(0.1, x),
              1e-6 * exact(0.1, x));
}

// Along a slanted axis, with a free fall before and a smaller second pulse: 2 A T / pi, and T (1 - 2 asin(0.1) / pi).
TEST(Shock, PulseOfAHalfSine) {
  const double A = 500.0, T = 0.004, dt = 1e-6;
  std::vector<double> a = half_sine(A, T, 0.003, dt);
  const std::vector<double> second = half_sine(0.5 * A, T, 0.003, dt);
  a.insert(a.end(), second.begin(), second.end());
  std::array<std::vector<double>, 3> record;
  for (const double value : a) {
    record[0].push_back(0.6 * value);
    record[1].push_back(0.0);
    record[2].push_back(-0.8 * value);
  }
  const ShockPulse pulse = shock_pulse(record, dt);
  EXPECT_NEAR(pulse.peak, A, 1e-9 * A);
  EXPECT_NEAR(pulse.time, 0.005, dt);
  EXPECT_NEAR(pulse.end - pulse.begin, T * (1.0 - 2.0 * std::asin(0.1) / pi), 1e-9);
  EXPECT_NEAR(pulse.velocity_change, 2.0 * A * T / pi, 1e-6 * A * T);  // (pi dt / T)^2 / 12
  EXPECT_EQ(shock_pulse({std::vector(3, 0.0), std::vector(3, 0.0), std::vector(3, 0.0)}, dt).peak, 0.0);
}

// A triangle of three samples, cut by the end of the record: 1 / 2 x 10 x 2 dt, less the half that is missing.
TEST(Shock, PulseAtTheEndsOfARecord) {
  const std::vector<double> zero(4, 0.0);
  const ShockPulse whole = shock_pulse({std::vector{0.0, -10.0, 0.0, 0.0}, zero, zero}, 0.5);
  EXPECT_DOUBLE_EQ(whole.velocity_change, 10.0 * 0.5);
  EXPECT_DOUBLE_EQ(whole.end - whole.begin, 2.0 * 0.9 * 0.5);
  const ShockPulse cut = shock_pulse({std::vector{0.0, 0.0, 0.0, -10.0}, zero, zero}, 0.5);
  EXPECT_DOUBLE_EQ(cut.velocity_change, 0.5 * 10.0 * 0.5);
  EXPECT_DOUBLE_EQ(cut.end, 1.5);
  // From -10 to 30 the line is zero after a quarter of the interval.
  const ShockPulse crossed = shock_pulse({std::vector{-10.0, 30.0, 0.0, 0.0}, zero, zero}, 1.0);
  EXPECT_DOUBLE_EQ(crossed.velocity_change, 0.5 * 30.0 * 0.75 + 0.5 * 30.0);
}

/// The relative motion z of an oscillator on a base with A sin(W t), from rest, as
///   z = e^(-d t) (c cos w_d t + s sin w_d t) + p sin W t + q cos W t,  z'' + 2 d z' + w^2 z = -A sin W t,
/// and after T freely; the absolute acceleration is -(2 d z' + w^2 z).
class HalfSineResponse {
 public:
  HalfSineResponse(double A, double T, double f, double Q)
      : W_(pi / T), w_(2.0 * pi * f), d_(0.5 * w_ / Q), w_d_(std::sqrt(w_ * w_ - d_ * d_)) {
    const double r = w_ * w_ - W_ * W_, m = 2.0 * d_ * W_, D = r * r + m * m;
    p_ = -A * r / D;
    q_ = A * m / D;
    first_ = {-q_, (-p_ * W_ - d_ * q_) / w_d_};
    const auto [z, v] = during(T);
    second_ = {z, (v + d_ * z) / w_d_};
  }
  /// Largest |absolute acceleration| up to T and over a period after it.
  double largest(double T) const {
    double most = 0.0;
    constexpr int n = 20000;
    for (int i = 0; i <= n; ++i) most = std::max(most, acceleration(during(T * i / n)));
    for (int i = 0; i <= n; ++i) most = std::max(most, acceleration(free(second_, 2.0 * pi / w_d_ * i / n)));
    return most;
  }

 private:
  struct Pair {
    double z, v;
  };
  Pair free(const Pair& of, double t) const {
    const double c = std::cos(w_d_ * t), s = std::sin(w_d_ * t), e = std::exp(-d_ * t);
    const double z = e * (of.z * c + of.v * s);
    return {z, -d_ * z + e * w_d_ * (of.v * c - of.z * s)};
  }
  Pair during(double t) const {
    const Pair f = free(first_, t);
    return {f.z + p_ * std::sin(W_ * t) + q_ * std::cos(W_ * t),
            f.v + W_ * (p_ * std::cos(W_ * t) - q_ * std::sin(W_ * t))};
  }
  double acceleration(const Pair& at) const { return std::abs(2.0 * d_ * at.v + w_ * w_ * at.z); }

  double W_, w_, d_, w_d_, p_ = 0.0, q_ = 0.0;
  Pair first_{}, second_{};  ///< c and s
};

// Frequencies below and above that of the pulse, where the residual and where the primary response is the largest.
TEST(Shock, SpectrumOfAHalfSineIsThatOfItsOscillators) {
  const double A = 300.0, T = 0.002, dt = T / 4000.0;
  const std::vector<double> a = half_sine(A, T, 0.0, dt);
  for (const double Q : {2.0, 10.0, 50.0})
    for (const double fT : {0.02, 0.1, 0.25, 0.49, 0.8, 1.0, 1.7, 3.3, 8.0}) {
      const double expected = HalfSineResponse(A, T, fT / T, Q).largest(T);
      const double found = shock_response_spectrum(a, dt, std::vector{fT / T}, Q)[0];
      EXPECT_NEAR(found, expected, 2e-6 * expected + 2e-6 * A) << "Q " << Q << ", f T " << fT;  // samples at peaks
    }
}

// Without damping, b = 1 / (2 f T): residual 2 A b / (1 - b^2) cos(pi / (2 b)) (the primary is smaller for f T < 1/2);
// for f T = 1 the primary is (sin x - sin(2 x) / 2) / (3/4) at x = 2 pi / 3: sqrt(3) (C. M. Harris, Shock and Vibration
// Handbook, ch. 8).
TEST(Shock, SpectrumOfAHalfSineWithoutDamping) {
  const double A = 300.0, T = 0.002, dt = T / 4000.0;
  const std::vector<double> spectrum =
      shock_response_spectrum(half_sine(A, T, 0.0, dt), dt, std::vector{0.25 / T, 1.0 / T}, 1e7);
  EXPECT_NEAR(spectrum[0], A * 2.0 * 2.0 / 3.0 * std::cos(pi / 4.0), 1e-6 * A);
  EXPECT_NEAR(spectrum[1], A * std::sqrt(3.0), 1e-5 * A);
}

// Stiff oscillators follow the base, soft ones are only given its change of velocity: 2 pi f dv.
TEST(Shock, SpectrumHasItsAsymptotes) {
  const double A = 300.0, T = 0.002, dt = T / 20000.0, dv = 2.0 * A * T / pi;
  const std::vector<double> a = half_sine(A, T, 0.001, dt);
  EXPECT_NEAR(shock_response_spectrum(a, dt, std::vector{200.0 / T}, 10.0)[0], A, 2e-3 * A);
  const double f = 1e-4 / T;
  EXPECT_NEAR(shock_response_spectrum(a, dt, std::vector{f}, 1e7)[0], 2.0 * pi * f * dv, 1e-5 * 2.0 * pi * f * dv);
}

TEST(Shock, FrequenciesAreTwelfthsOfOctaves) {
  const std::vector<double> f = spectrum_frequencies(0.1, 64.0);  // 1 Hz to 64 Hz: 6 octaves
  ASSERT_EQ(f.size(), 73U);
  EXPECT_DOUBLE_EQ(f.front(), 1.0);
  EXPECT_DOUBLE_EQ(f[12], 2.0);
  EXPECT_DOUBLE_EQ(f.back(), 64.0);
}

}  // namespace
}  // namespace carom::output_shock_test
