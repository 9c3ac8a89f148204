// TRIA6, the quadratic triangle: shape functions and rules.
#pragma once

#include "element/shape_table.hpp"

namespace carom {

struct Tria6 {
  static constexpr int nodes = 6, dimension = 2;

  /// With the area coordinates L: L (2 L - 1) at corners, 4 L_a L_b at middles.
  template <class T>
  static constexpr void values(const T xi[2], T N[6]) {
    const T L[3] = {1.0 - xi[0] - xi[1], xi[0], xi[1]};
    for (int a = 0; a < 3; ++a) {
      N[a] = L[a] * (2.0 * L[a] - 1.0);
      N[3 + a] = 4.0 * L[a] * L[(a + 1) % 3];
    }
  }
  static consteval auto stiffness_rule() { return triangle_rule<3>(); }
  static consteval auto mass_rule() { return triangle_rule<6>(); }
};

/// The same with the points that the radius of rings needs on curved sides.
struct Tria6OfRing : Tria6 {
  static consteval auto stiffness_rule() { return triangle_rule<6>(); }
};

}  // namespace carom
