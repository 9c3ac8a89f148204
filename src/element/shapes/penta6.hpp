// PENTA6, the linear wedge: shape functions and rules.
#pragma once

#include "element/shape_table.hpp"

namespace carom {

struct Penta6 {
  static constexpr int nodes = 6, dimension = 3;

  /// Area coordinates of the triangle times (1 -+ zeta) / 2.
  template <class T>
  static constexpr void values(const T xi[3], T N[6]) {
    const T area[3] = {1.0 - xi[0] - xi[1], xi[0], xi[1]};
    for (int a = 0; a < 3; ++a) {
      N[a] = 0.5 * area[a] * (1.0 - xi[2]);
      N[3 + a] = 0.5 * area[a] * (1.0 + xi[2]);
    }
  }
  static consteval auto stiffness_rule() { return product(triangle_rule<3>(), gauss_rule<2>()); }
  static consteval auto mass_rule() { return product(triangle_rule<6>(), gauss_rule<3>()); }
};

}  // namespace carom
