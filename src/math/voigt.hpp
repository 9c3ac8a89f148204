// Symmetric tensors by their components xx, yy, zz, xy, yz, zx.
#pragma once

#include <array>
#include <cmath>

namespace carom {

using Voigt = std::array<double, 6>;

/// Equivalent stress of von Mises: sqrt(3/2 s : s), s the deviator.
inline double von_mises(const Voigt& stress) {
  const auto& [xx, yy, zz, xy, yz, zx] = stress;
  const double a = xx - yy, b = yy - zz, c = zz - xx;
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * (xy * xy + yz * yz + zx * zx));
}

}  // namespace carom
