#include "output/cfc_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace carom::output_cfc_filter_test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Complex gain of the filter at `frequency`, from the middle half of a long sine (whole periods in the data).
std::complex<double> gain(double frequency, double dt, double cfc) {
  const auto period = static_cast<std::size_t>(std::lround(1.0 / (frequency * dt)));
  const double omega = 2.0 * kPi / static_cast<double>(period);
  std::vector<double> x(period * 40);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(omega * static_cast<double>(i));
  const std::vector<double> y = cfc_filter(x, dt, cfc);
  std::complex<double> sum = 0.0;
  for (std::size_t i = period * 10; i < period * 30; ++i) {
    sum += y[i] * std::exp(std::complex<double>(0.0, -omega * static_cast<double>(i)));
  }
  return sum * std::complex<double>(0.0, 2.0) / static_cast<double>(period * 20);
}

double decibel(double amplitude) {
  return 20.0 * std::log10(amplitude);
}

/// The analog filter behind J211's coefficients: |H|^2 of a 2-pole Butterworth of corner 2.0775 cfc, warped by the
/// bilinear transform, is 1 / (1 + (tan(w T/2) / wa)^4); two passes square the amplitude.
double expected_gain(double frequency, double dt, double cfc) {
  const double ratio = std::tan(kPi * frequency * dt) / std::tan(kPi * 2.0775 * cfc * dt);
  return 1.0 / (1.0 + std::pow(ratio, 4));
}

TEST(CfcFilter, GainIsTheFormulas) {
  const double dt = 1e-5, cfc = 1000.0;
  for (const double frequency : {100.0, 1000.0, 2000.0, 5000.0}) {
    // Truncation of the decaying transients of the ends: far below 1e-6 after ten periods.
    EXPECT_NEAR(std::abs(gain(frequency, dt, cfc)), expected_gain(frequency, dt, cfc), 1e-6) << frequency;
  }
}

TEST(CfcFilter, GainLiesInTheCorridorOfJ211) {
  // SAE J211-1, figure 1: within 0.5 dB in the pass band, +0.5 to -1 dB at F_H = cfc, +0.5 to -4 dB at F_N = 1.65 cfc,
  // which is the class's 3 dB frequency (100, 300, 1000, 1650 Hz), and at least 40 dB down in the stop band.
  for (const double cfc : {60.0, 180.0, 600.0, 1000.0}) {
    const double dt = 1.0 / (1000.0 * cfc);
    const double low = decibel(std::abs(gain(0.1 * cfc, dt, cfc)));
    EXPECT_GT(low, -0.5);
    EXPECT_LT(low, 0.5);
    const double at_class = decibel(std::abs(gain(cfc, dt, cfc)));
    EXPECT_GT(at_class, -1.0);
    EXPECT_LT(at_class, 0.5);
    const double at_corner = decibel(std::abs(gain(1.65 * cfc, dt, cfc)));
    EXPECT_NEAR(at_corner, -3.0, 0.1);  // the formula gives -2.91 dB
    EXPECT_LT(decibel(std::abs(gain(10.0 * cfc, dt, cfc))), -40.0);
  }
}

TEST(CfcFilter, PhaseIsZero) {
  // A zero-phase gain is a positive real number; 1e-6 as above.
  const std::complex<double> g = gain(1000.0, 1e-5, 1000.0);
  EXPECT_NEAR(std::arg(g), 0.0, 1e-6);
}

TEST(CfcFilter, ConstantStaysConstant) {
  const std::vector<double> x(200, 3.7);
  // The coefficients add to 1 up to round-off, 400 steps of recursion: 1e-12 relative.
  for (const double y : cfc_filter(x, 1e-5, 1000.0)) EXPECT_NEAR(y, 3.7, 3.7e-12);
}

TEST(CfcFilter, SymmetricPulseStaysSymmetric) {
  std::vector<double> x(2001, 0.0);
  for (int i = -50; i <= 50; ++i) x[static_cast<std::size_t>(1000 + i)] = std::cos(kPi * i / 100.0);
  const std::vector<double> y = cfc_filter(x, 1e-5, 600.0);
  const auto peak = std::max_element(y.begin(), y.end()) - y.begin();
  EXPECT_EQ(peak, 1000);
  // The forward-backward transients that leave the record are of the order of exp(-2 pi 2.0775 600 0.01 / sqrt 2).
  for (std::size_t i = 1; i <= 500; ++i) EXPECT_NEAR(y[1000 - i], y[1000 + i], 1e-9);
}

// A record that ends amid a vibration of ten times the class, at whatever phase. The mirror image of a zero has a kink,
// of which the filter leaves 2 h(0) / w, h(0) = pi f_c / sqrt(2) being its impulse response: f_c / (sqrt(2) f) = 0.147
// (and as much again of a hundredth, the gain of 40 dB). Held to its last value, as by point reflection, it would be 1.
TEST(CfcFilter, EndsAmidAVibrationAreNotHeldToTheirLastValues) {
  const double dt = 1e-6, cfc = 1000.0;
  for (double phase = 0.0; phase < 2.0 * kPi; phase += 0.3) {
    std::vector<double> x;
    for (int i = 0; i < 3000; ++i) x.push_back(std::sin(2.0 * kPi * 10.0 * cfc * dt * (i - 2999) + phase));
    for (const double y : cfc_filter(x, dt, cfc)) EXPECT_NEAR(y, 0.0, 0.147 + 0.02) << phase;
  }
}

TEST(CfcFilter, ShortRecords) {
  EXPECT_TRUE(cfc_filter({}, 1e-5, 1000.0).empty());
  EXPECT_NEAR(cfc_filter(std::vector{2.0}, 1e-5, 1000.0).at(0), 2.0, 2e-12);
  EXPECT_EQ(cfc_filter(std::vector{2.0, 2.5, 3.0}, 1e-5, 1000.0).size(), 3U);
}

TEST(CfcFilter, TooCoarseSamplingIsRefused) {
  const std::vector<double> x(100, 1.0);
  EXPECT_NO_THROW(cfc_filter(x, 1e-4, 1000.0));  // exactly 10 samples per cycle of the class: allowed
  try {
    cfc_filter(x, 2e-4, 1000.0);
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "CFC 1000 needs a sample at least every 0.0001 s (10 times the class); found one every 0.0002 s");
  }
  EXPECT_THROW(cfc_filter(x, 0.0, 1000.0), std::invalid_argument);
  EXPECT_THROW(cfc_filter(x, 1e-4, -1.0), std::invalid_argument);
  EXPECT_THROW(cfc_filter(x, std::nan(""), 60.0), std::invalid_argument);
}

// A sine of 50 Hz on steps that change by up to 4: on equal intervals, and through the filter, it is the sine but for
// the parabola between two rows, h^2 w^2 / 8 = 8e-5 for h = 1e-4 s / 1.25 and less elsewhere.
TEST(CfcFilter, RecordsOfChangingStepsAreResampledFirst) {
  std::vector<double> time{0.0}, values;
  for (int i = 0; time.back() < 0.1; ++i) time.push_back(std::min(0.1, time.back() + (i % 3 == 0 ? 8e-5 : 2e-5)));
  const double w = 2.0 * std::numbers::pi * 50.0;
  values.reserve(time.size());
  for (const double t : time) values.push_back(std::sin(w * t));
  const std::vector<double> at = equal_times(time, 1000.0);
  EXPECT_EQ(at.front(), 0.0);
  EXPECT_EQ(at.back(), 0.1);
  EXPECT_NEAR(at[1], 2e-5, 1e-9);
  const std::vector<double> even = resampled(time, values, at);
  const std::vector<double> filtered = cfc_filter(even, at[1], 1000.0);
  for (std::size_t i = 0; i < at.size(); ++i) {
    EXPECT_NEAR(even[i], std::sin(w * at[i]), 8e-5);
    EXPECT_NEAR(filtered[i], std::sin(w * at[i]), 5e-4);  // and 1e-4 of the passband's own at 50 of 1650 Hz
  }
}

TEST(CfcFilter, EqualStepsStayAsTheyAre) {
  std::vector<double> time, values;
  for (int i = 0; i <= 1000; ++i) {
    time.push_back(3.7e-4 * i);
    values.push_back(std::cos(0.1 * i * i));
  }
  const std::vector<double> at = equal_times(time, 60.0);
  ASSERT_EQ(at.size(), time.size());
  const std::vector<double> even = resampled(time, values, at);
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_NEAR(even[i], values[i], 1e-9);  // round-off of 0.37 over 3.7e-4
}

TEST(CfcFilter, IntervalsAreNoFinerThanTheClassNeeds) {
  const std::vector<double> time{0.0, 1e-9, 1e-3, 2e-3, 0.1};
  EXPECT_EQ(equal_times(time, 60.0).size(), 6001U);  // 1/1000 of 1/60 s
}

}  // namespace
}  // namespace carom::output_cfc_filter_test
