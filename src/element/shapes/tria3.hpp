// TRIA3, the linear triangle: shape functions and rules.
#pragma once

#include "element/shape_table.hpp"

namespace carom {

struct Tria3 {
  static constexpr int nodes = 3, dimension = 2;

  /// The area coordinates.
  template <class T>
  static constexpr void values(const T xi[2], T N[3]) {
    N[0] = 1.0 - xi[0] - xi[1];
    N[1] = xi[0];
    N[2] = xi[1];
  }
  static consteval auto stiffness_rule() { return triangle_rule<1>(); }
  static consteval auto mass_rule() { return triangle_rule<6>(); }
};

}  // namespace carom
