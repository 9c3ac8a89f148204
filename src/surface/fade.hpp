// The step by which factors of contact grow from nothing to one.
#pragma once

namespace carom {

/// S(u) = u^2 (3 - 2 u), 0 below u = 0 and 1 above 1, and half the slope of its logarithm: that of log f by u, where S
/// is a part of f^2.
struct Fade {
  double value = 1.0, slope = 0.0;
};

inline Fade fade(double u) {
  if (u >= 1.0) return {1.0, 0.0};
  if (!(u > 0.0)) return {0.0, 0.0};
  return {u * u * (3.0 - 2.0 * u), 1.0 / u - 1.0 / (3.0 - 2.0 * u)};
}

}  // namespace carom
