// Facets that a node goes through within a step.
#pragma once

#include <optional>

#include "surface/node_query.hpp"

namespace carom {

/// The facet that the node has gone through first, from the front to the back. Facets move without turning.
std::optional<Index> crossed_facet(const NodeQuery& query);

}  // namespace carom
