// Signed distance of points to rigid shapes.
#pragma once

#include "model/model.hpp"
#include "surface/facet_projection.hpp"

namespace carom {

/// Gap and unit normal of a point against a shape at rest; the normal points to the side where bodies stay, and
/// grad gap = normal wherever the gap is smooth. On the axis of a cylinder and at the centre of a sphere some normal is
/// taken. Plane::normal and Cylinder::axis are unit vectors.
///   plane:            g = n . (x - point)
///   sphere, cylinder: g = +-(r - radius), n = +-r / |r|, r from the centre or axis; minus inside
///   box:              outside the distance to the nearest face, edge or corner; inside minus the least distance to a
///                     face, whose normal it takes.
SignedDistance signed_distance(const Plane& plane, const Vec3& x);
SignedDistance signed_distance(const Sphere& sphere, const Vec3& x);
SignedDistance signed_distance(const Cylinder& cylinder, const Vec3& x);
SignedDistance signed_distance(const Box& box, const Vec3& x);

/// Faces of a box: 2 c is that at lower[c], 2 c + 1 that at upper[c]. Of a point inside, the nearest one; the distance
/// of any point from the plane of one.
Index nearest_face(const Box& box, const Vec3& x);
SignedDistance distance_to_face(const Box& box, const Vec3& x, Index face);

}  // namespace carom
