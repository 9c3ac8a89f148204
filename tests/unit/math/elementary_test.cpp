#include "math/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace carom::math_elementary_test {
namespace {

/// The largest error of function(x) against reference(x), over the rounding of the result, of many x in all lanes.
template <class Real, class Function, class Reference, class Random>
long double worst(const Function& function, const Reference& reference, const Random& random) {
  std::mt19937 generator(1);
  long double largest = 0.0;
  for (int i = 0; i < 200000 / lanes<Real>; ++i) {
    double x[lanes<Real>], y[lanes<Real>];
    for (double& lane : x) lane = random(generator);
    store(y, Real(function(load<Real>(x))));
    for (int l = 0; l < lanes<Real>; ++l) {
      const long double exact = reference(static_cast<long double>(x[l]));
      const long double error = std::abs(y[l] - exact) / (0x1p-52L * std::abs(exact));
      if (!(error <= largest)) largest = error;
    }
  }
  return largest;
}

auto between(double low, double high) {
  return [=](std::mt19937& g) { return std::uniform_real_distribution<double>(low, high)(g); };
}
/// Of either sign, or positive, from 10^low to 10^high.
auto of_size(double low, double high, bool is_signed = true) {
  return [=](std::mt19937& g) {
    const double size = std::pow(10.0, std::uniform_real_distribution<double>(low, high)(g));
    return is_signed && g() % 2 == 0 ? -size : size;
  };
}

template <class Real>
class Elementary : public testing::Test {};
using Numbers = testing::Types<double, Pack2, Pack4, Pack8>;
TYPED_TEST_SUITE(Elementary, Numbers);

TYPED_TEST(Elementary, LogarithmsAreOfRoundOff) {
  using Real = TypeParam;
  const auto near_1 = [](const Real& q) {
    Real log, rest;
    logarithm(q, log, rest);
    return log;
  };
  const auto log1p = [](long double q) { return std::log1p(q); };
  EXPECT_LE(worst<Real>(near_1, log1p, of_size(-18.0, std::log10(0.9999))), 2.0);
  EXPECT_LE(worst<Real>(near_1, log1p, between(-0.9999, 2.0)), 2.0);
  EXPECT_LE(worst<Real>(near_1, log1p, of_size(-3.0, 300.0, false)), 2.0);
  const auto rest = [](const Real& q) {
    Real log, rest_of_it;
    logarithm(q, log, rest_of_it);
    return rest_of_it;
  };
  // Beyond those that are near it is a difference, which loses the digits of q / rest, at most 6. Nearer to 0 the long
  // double does so as well.
  EXPECT_LE(worst<Real>(
                rest, [](long double q) { return q - std::log1p(q); }, of_size(-2.0, std::log10(0.33))),
            10.0);
  EXPECT_LE(worst<Real>(
                rest, [](long double q) { return q - std::log1p(q); }, between(0.51, 100.0)),
            10.0);
  const auto any = [](const Real& x) { return natural_logarithm(x); };
  const auto log = [](long double x) { return std::log(x); };
  EXPECT_LE(worst<Real>(any, log, of_size(-307.0, 308.0, false)), 1.5);
  EXPECT_LE(worst<Real>(any, log, between(0.5, 2.0)), 2.0);
}

TYPED_TEST(Elementary, ExponentialsAreOfRoundOff) {
  using Real = TypeParam;
  const auto less_one = [](const Real& x) { return exponential_less_one(x); };
  const auto expm1 = [](long double x) { return std::expm1(x); };
  EXPECT_LE(worst<Real>(less_one, expm1, of_size(-18.0, 0.0)), 3.0);
  EXPECT_LE(worst<Real>(less_one, expm1, between(-50.0, 708.0)), 3.0);
  const auto whole = [](const Real& x) { return exponential(x); };
  EXPECT_LE(worst<Real>(
                whole, [](long double x) { return std::exp(x); }, between(-708.0, 708.0)),
            2.0);
  EXPECT_LE(worst<Real>(
                whole, [](long double x) { return std::exp(x); }, of_size(-18.0, 0.0)),
            2.0);
}

// On top of the errors of both functions comes the rounding of n ln(x), and the logarithm's own, times n ln(x).
TYPED_TEST(Elementary, PowersAreOfRoundOff) {
  using Real = TypeParam;
  for (const double n : {0.02, 0.3, 1.0, 1.09, 3.0}) {
    const auto function = [&](const Real& x) { return power(x, n); };
    const auto reference = [&](long double x) { return std::pow(x, static_cast<long double>(n)); };
    for (const double size : {0.5, 3.0, 12.0})
      EXPECT_LE(worst<Real>(function, reference, of_size(-size, 0.5, false)), 3.0 + 1.5 * n * std::log(10.0) * size);
  }
}

// What is no number stays none, and nothing becomes one.
TYPED_TEST(Elementary, WhatHasNoValueHasNone) {
  using Real = TypeParam;
  const double nan = std::nan("");
  Real log, rest;
  for (const double q : {-1.0, -1.5, -1e300, nan}) {
    logarithm(Real(Real{} + q), log, rest);
    double lane[lanes<Real>];
    store(lane, log);
    for (const double value : lane) EXPECT_TRUE(std::isnan(value)) << q;
  }
  double lane[lanes<Real>];
  store(lane, exponential(Real(Real{} + nan)));
  for (const double value : lane) EXPECT_TRUE(std::isnan(value));
  store(lane, exponential_less_one(Real(Real{} - 1e9)));
  for (const double value : lane) EXPECT_EQ(value, -1.0);
}

}  // namespace
}  // namespace carom::math_elementary_test
