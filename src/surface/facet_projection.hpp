// Closest point on a facet, and intersection of a facet with a ray.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "base/types.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {

enum class ProjectionSite : std::uint8_t { interior, edge, vertex };

/// Closest point of a facet to a point x.
struct Projection {
  double xi = 0.0, eta = 0.0;
  std::array<double, 4> N{};
  Vec3 point{};           ///< sum of N_a x_a
  Vec3 a_1{}, a_2{};      ///< the facet's tangents there, see FacetFrame
  Vec3 normal{};          ///< and its unit outward normal; zero for a facet that is a point
  double gap = 0.0;       ///< (x - point) . normal: positive on the outer side
  double distance = 0.0;  ///< |x - point|
  ProjectionSite site = ProjectionSite::interior;
  int feature = -1;  ///< local edge a (from node a to the next) or local node a where the point lies; -1 inside
};

/// Global minimum of |x - x(xi, eta)| over the facet; no allocation.
/// Segment and triangle: closed form (Ericson, Real-Time Collision Detection, 2005, section 5.1.5). Quadrilateral:
/// Newton's method on the box [-1, 1]^2; its result is taken when it is proven to be the global minimum (see the
/// source), which it is for all but points beyond the reach of the curvature and badly distorted facets; otherwise
/// every stationary point is found from the quintic in xi that is left after the elimination of eta, and the best one
/// taken. The closest point of a surface is the one of least distance over its facets: there are no holes at edges and
/// corners.
Projection project(const PlacedFacet& facet, const Vec3& x);

/// Contact normal and signed gap of a point against a surface: grad_x gap = normal and, for the node a of the facet,
/// grad_{x_a} gap = -N_a normal.
struct SignedDistance {
  Vec3 normal{};
  double gap = 0.0;
};

/// Signed distance of x to a surface of which `closest` is the closest facet's projection. Inside a facet: the facet's
/// normal. On an edge or vertex: +-(x - point) / distance with the sign of (x - point) . average, so that the gap is
/// |gap| = distance and its gradient is exact; at distances up to `tiny` the direction is lost in round-off and
/// the average itself is taken. average: unit averaged normal of the surface at the point (averaged_normal).
SignedDistance signed_distance(const Projection& closest, const Vec3& x, const Vec3& average, double tiny);

/// Interpolated nodal normals (see nodal_normals), of length 1: sum of N_a normals[facet[a]], normalised; the facet's
/// own normal where the sum is zero.
Vec3 averaged_normal(const Projection& projection, const Facet& facet, std::span<const Vec3> normals);

/// Foot of the perpendicular from x on the facet continued beyond its edges, by Newton's method from a near point.
ParentPoint perpendicular_foot(const PlacedFacet& facet, const Vec3& x, ParentPoint at);

/// The place where a line meets a facet.
struct RayHit {
  double xi = 0.0, eta = 0.0;
  double distance = 0.0;  ///< along the direction; negative behind the start
};

/// Intersection of the line start + distance * direction (unit vector) with a facet that is not a point; both
/// directions count, the hit of least |distance| is returned. Closed form: for triangles and segments from the linear
/// equations, for quadrilaterals from the quadratic equation in xi of the facet seen along the line (Ramsey, Potter and
/// Hansen, J. Graphics Tools 9(3), 2004), with Newton steps to round it off. Parent coordinates may leave the facet by
/// `slack`, so that lines through a common edge of two facets do not slip between them; they are returned as they are.
/// Nothing when the line misses the facet or runs along it.
std::optional<RayHit> intersect(const PlacedFacet& facet, const Vec3& start, const Vec3& direction,
                                double slack = 1e-10);

}  // namespace carom
