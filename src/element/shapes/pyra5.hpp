// PYRA5, the linear pyramid: shape functions and rules.
#pragma once

#include "element/shape_table.hpp"

namespace carom {

/// On the base |xi|, |eta| <= 1 - zeta, 0 <= zeta <= 1, whose rational functions are linear on the triangles and
/// bilinear on the base (Bedrosian, Int. J. Numer. Methods Eng. 35, 1992).
struct Pyra5 {
  static constexpr int nodes = 5, dimension = 3;
  static constexpr double position[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

  /// N_a = ((1 + xi xi_a) (1 + eta eta_a) - zeta + xi_a eta_a xi eta zeta / (1 - zeta)) / 4, N_4 = zeta
  template <class T>
  static constexpr void values(const T xi[3], T N[5]) {
    const T twist = xi[0] * xi[1] * xi[2] / (1.0 - xi[2]);
    for (int a = 0; a < 4; ++a) {
      const double *p = position[a], sign = p[0] * p[1];
      N[a] = 0.25 * ((1.0 + xi[0] * p[0]) * (1.0 + xi[1] * p[1]) - xi[2] + sign * twist);
    }
    N[4] = xi[2];
  }
  static consteval auto stiffness_rule() { return rule<2>(); }
  static consteval auto mass_rule() { return rule<3>(); }

 private:
  /// Conical product: n x n Gauss points over the base, shrunk by s = 1 - zeta, times the two points of the weight s^2
  /// on [0, 1] (exact to degree 3 in s), the roots of s^2 - 4/3 s + 2/5.
  template <int n>
  static consteval Rule<2 * n * n, 3> rule() {
    constexpr double s[2] = {0.45584815598877472, 0.87748517734455862};
    constexpr double w_1 = (0.25 - s[0] / 3.0) / (s[1] - s[0]), w[2] = {1.0 / 3.0 - w_1, w_1};
    const auto base = square_rule<n>();
    Rule<2 * n * n, 3> result;
    for (int k = 0; k < 2; ++k)
      for (int p = 0; p < n * n; ++p) {
        const int q = p + n * n * k;
        result.weight[q] = w[k] * base.weight[p];
        for (int i = 0; i < 2; ++i) result.xi[q][i] = s[k] * base.xi[p][i];
        result.xi[q][2] = 1.0 - s[k];
      }
    return result;
  }
};

}  // namespace carom
