// The bilinear surface of a quadrilateral: closest point and intersection with a line, in parent coordinates.
#pragma once

#include <array>

#include "base/types.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {

/// x(xi, eta) = m + p xi + q eta + c xi eta: the surface of a quadrilateral, or with c = 0 of a triangle.
struct BilinearPatch {
  Vec3 m{}, p{}, q{}, c{};

  /// Facet of three or four nodes, in its parent coordinates.
  explicit BilinearPatch(const PlacedFacet& facet);

  Vec3 at(double xi, double eta) const;
  Vec3 tangent_1(double eta) const;  ///< dx/dxi
  Vec3 tangent_2(double xi) const;   ///< dx/deta
};

/// Global minimum of |x - x(xi, eta)| over the quadrilateral [-1, 1]^2; coordinates on the boundary are exactly -1
/// or 1.
ParentPoint closest_point(const BilinearPatch& patch, const Vec3& x);

/// The part of closest_point that needs no start and no convergence, exposed for its test: the best of all stationary
/// points inside and on the edges, from the roots of the quintic; good to about the square root of the round-off.
ParentPoint closest_of_stationary_points(const BilinearPatch& patch, const Vec3& x);

/// The at most two points of the bilinear surface with the x and y coordinates s and t (inverse of the surface seen
/// along the z axis); returns their number. Closed form (Ramsey, Potter and Hansen, J. Graphics Tools 9(3), 2004) with
/// Newton steps to round it off. Points beyond |xi| = 2 or |eta| = 2 are left out.
int points_over(const BilinearPatch& patch, double s, double t, std::array<ParentPoint, 2>& points);

}  // namespace carom
