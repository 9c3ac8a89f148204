// What results say of a stress beside its components.
#pragma once

#include <algorithm>
#include <functional>

#include "math/principal_axes.hpp"
#include "math/voigt.hpp"

namespace carom {

/// Principal values, the largest first.
inline Vec3 principal_stress(const Voigt& s) {
  Vec3 values = principal_axes({s[0], s[1], s[2]}, {s[3], s[4], s[5]}).values;
  std::ranges::sort(values, std::greater<>());
  return values;
}

/// -tr(sigma) / 3
inline double pressure(const Voigt& s) {
  return -(s[0] + s[1] + s[2]) / 3.0;
}

}  // namespace carom
