// The closest point of a surface to a node, of the facets that count for it.
#pragma once

#include <optional>

#include "surface/node_query.hpp"
#include "surface/surface_point.hpp"

namespace carom {

/// The closest point so far.
struct ClosestPoint {
  double distance;
  Index facet = -1;  ///< -1: none that counts
  Projection projection{};
  bool is_continued = false;  ///< beyond a rim, a little
  bool is_beside = false;     ///< beyond a rim, farther
  std::optional<Rim> rim{};   ///< where it is continued beyond the end of the surface
};

/// Of the candidates within reach, the nearest by its bounds first, so that few have to be projected on.
ClosestPoint closest_point(const NodeQuery& query);

/// That which the facet `from` and ever nearer neighbours lead to.
ClosestPoint followed_point(const NodeQuery& query, Index from);

}  // namespace carom
