// Boundary facets of parts.
#pragma once

#include <vector>

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

}  // namespace carom
