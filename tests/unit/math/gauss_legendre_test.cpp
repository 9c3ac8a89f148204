#include "math/gauss_legendre.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::math_gauss_legendre_test {
namespace {

TEST(GaussLegendre, IntegratesMonomialsUpToItsDegree) {
  for (const int n : {1, 2, 3, 5, 16, 40}) {
    const std::vector<QuadraturePoint> rule = gauss_legendre(n);
    for (int degree = 0; degree <= 2 * n; ++degree) {
      double sum = 0.0;
      for (const QuadraturePoint& point : rule) sum += point.weight * std::pow(point.x, degree);
      const double exact = degree % 2 == 1 ? 0.0 : 2.0 / (degree + 1);
      if (degree < 2 * n) {
        EXPECT_NEAR(sum, exact, 1e-14) << n << " points, degree " << degree;  // rounding of 40 terms of size 1
      } else if (n <= 5) {
        EXPECT_GT(std::abs(sum - exact), 1e-4) << n << " points, degree " << degree;
      }
    }
  }
}

TEST(GaussLegendre, TwoPointRule) {
  const std::vector<QuadraturePoint> rule = gauss_legendre(2);
  EXPECT_DOUBLE_EQ(rule[0].x, -1 / std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(rule[1].x, 1 / std::sqrt(3.0));
}

}  // namespace
}  // namespace carom::math_gauss_legendre_test
