// What of parts may touch: boundary facets, and the sides of bars.
#pragma once

#include <array>
#include <vector>

#include "base/types.hpp"
#include "mesh/facet.hpp"
#include "model/options.hpp"

namespace carom {

/// Boundary facets of parts, their normals (mesh/facet.hpp) pointing out of the body. The measure of a facet is its
/// area (solid), its length times thickness (plane) or times 2 pi x (axisymmetric), or `thickness` (the end of a bar).
struct Surface {
  std::vector<Facet> facets;
  Section section = Section::solid;
  double thickness = 1.0;
};

/// A bar that touches with its side: round, with round ends.
struct BarSide {
  std::array<Index, 2> node{-1, -1};
  double radius = 0.0;
  Index part = -1;  ///< index in Model::parts
};

}  // namespace carom
