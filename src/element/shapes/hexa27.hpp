// HEXA27, the triquadratic hexahedron: shape functions and rules.
#pragma once

#include "element/shapes/hexa20.hpp"

namespace carom {

struct Hexa27 {
  static constexpr int nodes = 27, dimension = 3;

  /// Products of the quadratic Lagrange polynomials; corners, edges, faces -x, +x, -y, +y, -z, +z, centre.
  template <class T>
  static constexpr void values(const T xi[3], T N[27]) {
    for (int a = 0; a < 27; ++a) {
      T product = 1.0;
      for (int i = 0; i < 3; ++i) {
        const double p = place(a, i);
        product = product * (p == 0.0 ? 1.0 - xi[i] * xi[i] : 0.5 * xi[i] * (xi[i] + p));
      }
      N[a] = product;
    }
  }
  static consteval auto stiffness_rule() { return cube_rule<3>(); }
  static consteval auto mass_rule() { return cube_rule<3>(); }

 private:
  /// Parent coordinate i of node a: -1, 0 or 1.
  static constexpr double place(int a, int i) {
    if (a < 8) return Hexa8::position[a][i];
    if (a < 20) return 0.5 * (Hexa8::position[Hexa20::edge[a - 8][0]][i] + Hexa8::position[Hexa20::edge[a - 8][1]][i]);
    if (a == 26 || (a - 20) / 2 != i) return 0.0;
    return a % 2 == 0 ? -1.0 : 1.0;
  }
};

}  // namespace carom
