// Vector algebra on Vec3.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "base/types.hpp"

namespace carom {

/// a . b
constexpr double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// a x b
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The vector at a node, of a dof vector.
inline Vec3 vector_at(std::span<const double> x, std::size_t node) {
  return {x[3 * node], x[3 * node + 1], x[3 * node + 2]};
}

/// a + b
constexpr Vec3 add(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// a - b
constexpr Vec3 subtract(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// s a
constexpr Vec3 scaled(const Vec3& a, double s) {
  return {s * a[0], s * a[1], s * a[2]};
}

/// |a|, without overflow or underflow of the squares
inline double norm(const Vec3& a) {
  return std::hypot(a[0], a[1], a[2]);
}

/// a / |a|; not a number when a = 0 (the caller checks norm(a) > 0).
inline Vec3 normalized(const Vec3& a) {
  const double length = norm(a);
  return {a[0] / length, a[1] / length, a[2] / length};
}

}  // namespace carom
