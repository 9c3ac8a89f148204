// The point of a surface that a node meets, made of the closest one.
#pragma once

#include "surface/closest_point.hpp"

namespace carom {

/// What the closest point amounts to, in `point`; false: nothing. Beside edges it is the mean over the feet on the
/// facets there (SurfaceSearch).
bool meets(const NodeQuery& query, const ClosestPoint& best, SurfacePoint& point);

}  // namespace carom
