// The dual base of two tangents of a facet and a direction out of its plane.
#pragma once

#include "math/vec3.hpp"

namespace carom {

/// Coefficients beta^alpha = t . dual_alpha of t = beta^1 a_1 + beta^2 a_2 + gamma n, for tangents a_alpha of a facet
/// and a direction n out of its plane: dual_1 = a_2 x n / V, dual_2 = n x a_1 / V, V = n . a_1 x a_2.
struct TangentDual {
  Vec3 dual_1{}, dual_2{};
};
inline TangentDual tangent_dual(const Vec3& a_1, const Vec3& a_2, const Vec3& n) {
  const double scale = 1.0 / dot(n, cross(a_1, a_2));
  return {scaled(cross(a_2, n), scale), scaled(cross(n, a_1), scale)};
}

}  // namespace carom
