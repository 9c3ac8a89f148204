// QUAD8, the serendipity quadrilateral: shape functions and rules.
#pragma once

#include "element/shapes/quad4.hpp"

namespace carom {

struct Quad8 {
  static constexpr int nodes = 8, dimension = 2;

  /// Corners: (1 + xi xi_a) (1 + eta eta_a) (xi xi_a + eta eta_a - 1) / 4; the middle of an edge along xi:
  /// (1 - xi^2) (1 + eta eta_a) / 2.
  template <class T>
  static constexpr void values(const T xi[2], T N[8]) {
    for (int a = 0; a < 4; ++a) {
      const double* p = Quad4::position[a];
      const double* q = Quad4::position[(a + 1) % 4];
      N[a] = 0.25 * (1.0 + xi[0] * p[0]) * (1.0 + xi[1] * p[1]) * (xi[0] * p[0] + xi[1] * p[1] - 1.0);
      T product = 0.5;
      for (int i = 0; i < 2; ++i) {
        const double middle = 0.5 * (p[i] + q[i]);
        product = product * (middle == 0.0 ? 1.0 - xi[i] * xi[i] : 1.0 + xi[i] * middle);
      }
      N[4 + a] = product;
    }
  }
  static consteval auto stiffness_rule() { return square_rule<3>(); }
  static consteval auto mass_rule() { return square_rule<3>(); }
};

/// The same with two points a direction for the stiffness.
struct ReducedQuad8 : Quad8 {
  static consteval auto stiffness_rule() { return square_rule<2>(); }
};

}  // namespace carom
