// LINE3, the quadratic segment: shape functions.
#pragma once

namespace carom {

struct Line3 {
  static constexpr int nodes = 3, dimension = 1;

  /// xi (xi -+ 1) / 2 at the ends, 1 - xi^2 in the middle.
  template <class T>
  static constexpr void values(const T xi[1], T N[3]) {
    N[0] = 0.5 * xi[0] * (xi[0] - 1.0);
    N[1] = 0.5 * xi[0] * (xi[0] + 1.0);
    N[2] = 1.0 - xi[0] * xi[0];
  }
};

}  // namespace carom
