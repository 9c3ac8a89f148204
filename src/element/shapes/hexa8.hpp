// HEXA8, the trilinear hexahedron: shape functions and rules.
#pragma once

#include "element/shape_table.hpp"

namespace carom {

struct Hexa8 {
  static constexpr int nodes = 8, dimension = 3;
  static constexpr double position[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                            {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

  /// N_a = (1 + xi xi_a) (1 + eta eta_a) (1 + zeta zeta_a) / 8
  template <class T>
  static constexpr void values(const T xi[3], T N[8]) {
    for (int a = 0; a < 8; ++a) {
      const double* p = position[a];
      N[a] = 0.125 * (1.0 + xi[0] * p[0]) * (1.0 + xi[1] * p[1]) * (1.0 + xi[2] * p[2]);
    }
  }
  static consteval auto stiffness_rule() { return cube_rule<2>(); }
  static consteval auto mass_rule() { return cube_rule<3>(); }

  /// Nodal values of xi eta, eta zeta, zeta xi and xi eta zeta, the fields without strain at the centre (Flanagan and
  /// Belytschko, Int. J. Numer. Methods Eng. 17, 1981).
  static constexpr int modes = 4;
  static constexpr double hourglass[4][8] = {{1, -1, 1, -1, 1, -1, 1, -1},
                                             {1, 1, -1, -1, -1, -1, 1, 1},
                                             {1, -1, -1, 1, -1, 1, 1, -1},
                                             {-1, 1, -1, 1, 1, -1, 1, -1}};
};

}  // namespace carom
