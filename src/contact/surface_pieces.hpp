// Connected pieces of a surface.
#pragma once

#include <span>
#include <vector>

#include "mesh/facet.hpp"

namespace carom {

/// Numbers that are equal for facets of one connected piece of a surface.
std::vector<Index> surface_pieces(std::span<const Facet> facets);

}  // namespace carom
