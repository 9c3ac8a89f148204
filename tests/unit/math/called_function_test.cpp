#include "math/called_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "math/time_function.hpp"

namespace carom::math_called_function_test {
namespace {

constexpr double span = 2.0, w = 7.0;

/// 3 sin(w t) as a function of a program, which TimeFunction multiplies by its table's entry.
TimeFunction sine() {
  return {{0.0}, {3.0}, std::make_shared<const CalledFunction>([](double t) { return std::sin(w * t); }, span)};
}

TEST(CalledFunction, ValueAndDerivative) {
  const TimeFunction f = sine();
  for (const double t : {0.0, 1e-7, 0.3, 1.1, span, 2.5}) {
    EXPECT_EQ(f(t), 3.0 * std::sin(w * t));
    // Differences over h = 2^-19: w^2 h^2 / 3 of truncation, and rounding over h.
    EXPECT_NEAR(f.derivative(t), 3.0 * w * std::cos(w * t), 3.0 * w * 1e-9) << t;
  }
}

TEST(CalledFunction, IntegralsWithinPanelsOverManyAndBehindTheSpan) {
  const TimeFunction f = sine();
  for (const double a : {0.0, 1e-4, 0.3}) {
    for (const double b : {0.30001, 1.7, span, 3.0}) {
      const double first = 3.0 / w * (std::cos(w * a) - std::cos(w * b));
      const double second = 3.0 * ((b - a) * std::cos(w * a) / w - (std::sin(w * b) - std::sin(w * a)) / (w * w));
      EXPECT_NEAR(f.integral(a, b), first, 1e-13) << a << " " << b;
      EXPECT_NEAR(f.second_integral(a, b), second, 1e-13) << a << " " << b;
    }
  }
}

TEST(CalledFunction, WhatItThrowsComesThrough) {
  const CalledFunction f([](double t) -> double { throw CallFailure{std::make_exception_ptr(t)}; }, span);
  EXPECT_THROW(f.at(0.0), CallFailure);
  EXPECT_THROW(f.integral(0.0, 1.0), CallFailure);
  EXPECT_THROW(f.integral(0.0, 1.0), CallFailure) << "made anew when asked again";
}

}  // namespace
}  // namespace carom::math_called_function_test
