// TETRA4, the linear tetrahedron: shape functions and rules.
#pragma once

#include "element/shape_table.hpp"

namespace carom {

struct Tetra4 {
  static constexpr int nodes = 4, dimension = 3;

  /// The volume coordinates.
  template <class T>
  static constexpr void values(const T xi[3], T N[4]) {
    N[0] = 1.0 - xi[0] - xi[1] - xi[2];
    N[1] = xi[0];
    N[2] = xi[1];
    N[3] = xi[2];
  }
  static consteval auto stiffness_rule() { return tetrahedron_rule<1>(); }
  static consteval auto mass_rule() { return tetrahedron_rule<4>(); }
};

}  // namespace carom
