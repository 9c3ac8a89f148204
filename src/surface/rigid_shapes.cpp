#include "surface/rigid_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "math/vec3.hpp"

namespace carom {
namespace {

/// Distance from a point or an axis: r runs from there to the point, its direction is `any` where r = 0.
SignedDistance from_centre(const Vec3& r, double radius, bool inside, const Vec3& any) {
  const double length = norm(r);
  const Vec3 outward = length > 0.0 ? scaled(r, 1.0 / length) : any;
  if (inside) return {scaled(outward, -1.0), radius - length};
  return {outward, length - radius};
}

}  // namespace

SignedDistance signed_distance(const Plane& plane, const Vec3& x) {
  return {plane.normal, dot(plane.normal, subtract(x, plane.point))};
}

SignedDistance signed_distance(const Sphere& sphere, const Vec3& x) {
  return from_centre(subtract(x, sphere.centre), sphere.radius, sphere.inside, {0.0, 0.0, 1.0});
}

SignedDistance signed_distance(const Cylinder& cylinder, const Vec3& x) {
  const Vec3 r = subtract(x, cylinder.point);
  const Vec3& axis = cylinder.axis;
  const Vec3 any = normalized(cross(axis, std::abs(axis[0]) < 0.5 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0}));
  return from_centre(subtract(r, scaled(axis, dot(r, axis))), cylinder.radius, cylinder.inside, any);
}

SignedDistance distance_to_face(const Box& box, const Vec3& x, Index face) {
  const auto c = static_cast<std::size_t>(face / 2);
  Vec3 normal{};
  normal[c] = face % 2 == 1 ? 1.0 : -1.0;
  return {normal, face % 2 == 1 ? x[c] - box.upper[c] : box.lower[c] - x[c]};
}

Index nearest_face(const Box& box, const Vec3& x) {
  Index nearest = 0;
  for (Index face = 1; face < 6; ++face) {
    const double gap = distance_to_face(box, x, face).gap, best = distance_to_face(box, x, nearest).gap;
    const bool is_opposite = face % 2 == 1 && face == nearest + 1;  // in the middle between two the upper one counts
    if (gap > best || (gap == best && is_opposite)) nearest = face;
  }
  return nearest;
}

SignedDistance signed_distance(const Box& box, const Vec3& x) {
  Vec3 outside{};
  for (std::size_t c = 0; c < 3; ++c) outside[c] = x[c] - std::clamp(x[c], box.lower[c], box.upper[c]);
  const double distance = norm(outside);
  if (distance > 0.0) return {scaled(outside, 1.0 / distance), distance};
  return distance_to_face(box, x, nearest_face(box, x));
}

}  // namespace carom
