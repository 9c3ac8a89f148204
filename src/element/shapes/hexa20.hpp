// HEXA20, the serendipity hexahedron: shape functions and rules.
#pragma once

#include "element/shapes/hexa8.hpp"

namespace carom {

struct Hexa20 {
  static constexpr int nodes = 20, dimension = 3;
  static constexpr int edge[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                      {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

  /// Corners: (1 + xi xi_a) (1 + eta eta_a) (1 + zeta zeta_a) (xi xi_a + eta eta_a + zeta zeta_a - 2) / 8; the middle
  /// of an edge along xi: (1 - xi^2) (1 + eta eta_a) (1 + zeta zeta_a) / 4.
  template <class T>
  static constexpr void values(const T xi[3], T N[20]) {
    for (int a = 0; a < 8; ++a) {
      const double* p = Hexa8::position[a];
      N[a] = 0.125 * (1.0 + xi[0] * p[0]) * (1.0 + xi[1] * p[1]) * (1.0 + xi[2] * p[2]) *
             (xi[0] * p[0] + xi[1] * p[1] + xi[2] * p[2] - 2.0);
    }
    for (int e = 0; e < 12; ++e) {
      T product = 0.25;
      for (int i = 0; i < 3; ++i) {
        const double p = 0.5 * (Hexa8::position[edge[e][0]][i] + Hexa8::position[edge[e][1]][i]);
        product = product * (p == 0.0 ? 1.0 - xi[i] * xi[i] : 1.0 + xi[i] * p);
      }
      N[8 + e] = product;
    }
  }
  static consteval auto stiffness_rule() { return cube_rule<3>(); }
  static consteval auto mass_rule() { return cube_rule<3>(); }
};

/// The same with two points a direction for the stiffness.
struct ReducedHexa20 : Hexa20 {
  static consteval auto stiffness_rule() { return cube_rule<2>(); }
};

}  // namespace carom
