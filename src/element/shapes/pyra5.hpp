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
  static consteval auto stiffness_rule() { return pyramid_rule<2, 2>(); }
  static consteval auto mass_rule() { return pyramid_rule<3, 2>(); }
};

}  // namespace carom
