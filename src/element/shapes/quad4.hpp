// QUAD4, the bilinear quadrilateral: shape functions and rules.
#pragma once

#include "element/shape_table.hpp"

namespace carom {

struct Quad4 {
  static constexpr int nodes = 4, dimension = 2;
  static constexpr double position[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

  /// N_a = (1 + xi xi_a) (1 + eta eta_a) / 4
  template <class T>
  static constexpr void values(const T xi[2], T N[4]) {
    for (int a = 0; a < 4; ++a) N[a] = 0.25 * (1.0 + xi[0] * position[a][0]) * (1.0 + xi[1] * position[a][1]);
  }
  static consteval auto stiffness_rule() { return square_rule<2>(); }
  static consteval auto mass_rule() { return square_rule<3>(); }

  /// Nodal values of xi eta, the field without strain at the centre.
  static constexpr int modes = 1;
  static constexpr double hourglass[1][4] = {{1, -1, 1, -1}};
};

}  // namespace carom
