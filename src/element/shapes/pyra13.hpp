// PYRA13, the pyramid of second order: shape functions and rules.
#pragma once

#include "element/shapes/pyra5.hpp"

namespace carom {

/// On the base |xi|, |eta| <= 1 - zeta, 0 <= zeta <= 1: rational functions that are those of TRIA6 on the triangles and
/// of QUAD8 on the base (Bedrosian, Int. J. Numer. Methods Eng. 35, 1992; Zgainski, Coulomb and Marechal, IEEE Trans.
/// Magn. 32, 1996). With the functions N5 of PYRA5: corners N5_a (xi xi_a + eta eta_a - 1), the top zeta (2 zeta - 1),
/// the middle of the edge of the base along xi ((1 - zeta)^2 - xi^2) (1 - zeta + eta eta_a) / (2 (1 - zeta)), and of
/// the edge from a to the top 4 zeta N5_a.
struct Pyra13 {
  static constexpr int nodes = 13, dimension = 3;

  template <class T>
  static constexpr void values(const T xi[3], T N[13]) {
    T linear[5];
    Pyra5::values(xi, linear);
    const T s = 1.0 - xi[2];
    for (int a = 0; a < 4; ++a) {
      const double *p = Pyra5::position[a], *q = Pyra5::position[(a + 1) % 4];
      N[a] = linear[a] * (xi[0] * p[0] + xi[1] * p[1] - 1.0);
      N[9 + a] = 4.0 * xi[2] * linear[a];
      const int along = p[0] == q[0] ? 1 : 0, across = 1 - along;
      N[5 + a] = 0.5 * (s * s - xi[along] * xi[along]) * (s + xi[across] * p[across]) / s;
    }
    N[4] = xi[2] * (2.0 * xi[2] - 1.0);
  }
  static consteval auto stiffness_rule() { return pyramid_rule<3, 2>(); }
  static consteval auto mass_rule() { return pyramid_rule<3, 3>(); }
};

}  // namespace carom
