#include "contact/rigid_shapes.hpp"

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

SignedDistance signed_distance(const Box& box, const Vec3& x) {
  Vec3 outside{}, normal{};
  double nearest = -INFINITY;  // least negative distance to a face
  for (std::size_t c = 0; c < 3; ++c) {
    outside[c] = x[c] - std::clamp(x[c], box.lower[c], box.upper[c]);
    const double below = box.lower[c] - x[c], above = x[c] - box.upper[c];
    if (std::max(below, above) <= nearest) continue;
    nearest = std::max(below, above);
    normal = {};
    normal[c] = above >= below ? 1.0 : -1.0;
  }
  const double distance = norm(outside);
  if (distance > 0.0) return {scaled(outside, 1.0 / distance), distance};
  return {normal, nearest};
}

}  // namespace carom
