// Gauss-Legendre quadrature of any order on a line.
#pragma once

#include <vector>

namespace carom {

struct QuadraturePoint {
  double x = 0.0;       ///< in (-1, 1)
  double weight = 0.0;  ///< the weights sum to 2
};

/// The n-point rule on [-1, 1], n >= 1, exact for polynomials of degree 2 n - 1; points increase. Roots of P_n by
/// Newton's method from the asymptotic estimate cos(pi (i - 1/4) / (n + 1/2)) (Davis and Rabinowitz, Methods of
/// Numerical Integration, 2nd ed., section 2.7).
std::vector<QuadraturePoint> gauss_legendre(int n);

}  // namespace carom
