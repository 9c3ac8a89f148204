// PENTA15, the serendipity wedge: shape functions and rules.
#pragma once

#include "element/shape_table.hpp"

namespace carom {

/// With the area coordinates L of the triangle. Corners: L_a ((2 L_a - 1) (1 -+ zeta) - (1 - zeta^2)) / 2; the middles
/// of the triangles' edges: 2 L_a L_b (1 -+ zeta); those of the edges along zeta: L_a (1 - zeta^2).
struct Penta15 {
  static constexpr int nodes = 15, dimension = 3;

  template <class T>
  static constexpr void values(const T xi[3], T N[15]) {
    const T area[3] = {1.0 - xi[0] - xi[1], xi[0], xi[1]};
    const T inside = 1.0 - xi[2] * xi[2];
    for (int side = 0; side < 2; ++side) {
      const T on_side = side == 0 ? T(1.0 - xi[2]) : T(1.0 + xi[2]);
      for (int a = 0; a < 3; ++a) {
        N[3 * side + a] = 0.5 * area[a] * ((2.0 * area[a] - 1.0) * on_side - inside);
        N[6 + 3 * side + a] = 2.0 * area[a] * area[(a + 1) % 3] * on_side;
      }
    }
    for (int a = 0; a < 3; ++a) N[12 + a] = area[a] * inside;
  }
  /// Exact for the forces of a uniform stress on curved cells too, which have the degrees 4 in the triangle and 5 along
  /// zeta.
  static consteval auto stiffness_rule() { return product(triangle_rule<6>(), gauss_rule<3>()); }
  static consteval auto mass_rule() { return product(triangle_rule<6>(), gauss_rule<3>()); }
};

}  // namespace carom
