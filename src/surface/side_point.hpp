// Sides of a body beside the face that a node meets: the way out for a node that has come in from there.
#pragma once

#include <optional>

#include "surface/node_query.hpp"

namespace carom {

/// The closest point of the facets beside one that counts which do not.
struct SidePoint {
  Index facet = -1;
  Projection projection{};
  SignedDistance at{};  ///< of the sides as they are moved out
  double slack = 0.0;   ///< by how much
};

/// Where the node is behind or before the neighbours of f that face away from it; nothing where f has none, and for a
/// node that has come through f or was in front of it at x_begin.
std::optional<SidePoint> side_at(const NodeQuery& query, Index f);

}  // namespace carom
