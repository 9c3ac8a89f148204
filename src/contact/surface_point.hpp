// What a node meets of a surface, put together from feet on its facets.
#pragma once

#include <array>

#include "contact/facet_projection.hpp"
#include "contact/surface_search.hpp"

namespace carom {

/// A foot at the facet's closest point, alone.
FacetFoot foot_at(Index f, const Projection& p, const Vec3& normal, double gap);

/// Multiplies the weight of a foot by (1 - z^2 / b^2)^2, z = g - g_0 the difference of its gap to that of the nearest
/// facet; false where nothing is left. `gradient` and `at_closest` are those of the weight without the change of z.
bool fade_unlike(FacetFoot& foot, double b, const FacetFoot& nearest);

/// Makes the point the mean over its feet, the nearest first, whose gradients are those of their weights.
void take_mean(SurfacePoint& met);

/// Makes the point one of facet f alone.
void take_only(Index f, const Projection& p, const SignedDistance& at, SurfacePoint& met);

/// The closest point of a facet's end, and how far the facet is continued beyond it.
struct Rim {
  Vec3 point{};
  std::array<double, 4> N{};
  double width = 0.0;
};

/// Multiplies the gap of a point beyond the end of facet f by (1 - t^2 / w^2)^2, t^2 = |x - p|^2 - g^2 the distance
/// from the end's closest point p along the facet, g the gap from the facet: so that it begins at zero at t = w,
/// without a kink at either end. The gradient is exact.
void fade(Index f, const Projection& p, const Rim& rim, const Vec3& x, SurfacePoint& met);

}  // namespace carom
