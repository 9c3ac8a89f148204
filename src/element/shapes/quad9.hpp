// QUAD9, the biquadratic quadrilateral: shape functions.
#pragma once

#include "element/shapes/quad4.hpp"

namespace carom {

struct Quad9 {
  static constexpr int nodes = 9, dimension = 2;

  /// Products of the quadratic Lagrange polynomials; corners, middles of the edges, centre.
  template <class T>
  static constexpr void values(const T xi[2], T N[9]) {
    for (int a = 0; a < 9; ++a) {
      T product = 1.0;
      for (int i = 0; i < 2; ++i) {
        const double p = place(a, i);
        product = product * (p == 0.0 ? 1.0 - xi[i] * xi[i] : 0.5 * xi[i] * (xi[i] + p));
      }
      N[a] = product;
    }
  }

 private:
  /// Parent coordinate i of node a: -1, 0 or 1.
  static constexpr double place(int a, int i) {
    if (a < 4) return Quad4::position[a][i];
    if (a == 8) return 0.0;
    return 0.5 * (Quad4::position[a - 4][i] + Quad4::position[(a - 3) % 4][i]);
  }
};

}  // namespace carom
