#include "math/gauss_legendre.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace carom {

namespace {

struct LegendreValue {
  double p;   ///< P_n(x)
  double dp;  ///< dP_n/dx
};

LegendreValue legendre(int n, double x) {
  double previous = 1.0, p = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
    previous = p;
    p = next;
  }
  return {p, n * (x * p - previous) / (x * x - 1.0)};
}

}  // namespace

std::vector<QuadraturePoint> gauss_legendre(int n) {
  std::vector<QuadraturePoint> points(static_cast<std::size_t>(n));
  for (int i = 1; i <= n; ++i) {
    double x = -std::cos(std::numbers::pi * (i - 0.25) / (n + 0.5));
    for (int iteration = 0; iteration < 10; ++iteration) {
      const LegendreValue value = legendre(n, x);
      x -= value.p / value.dp;
    }
    const double dp = legendre(n, x).dp;
    points[static_cast<std::size_t>(i - 1)] = {x, 2.0 / ((1.0 - x * x) * dp * dp)};
  }
  return points;
}

}  // namespace carom
