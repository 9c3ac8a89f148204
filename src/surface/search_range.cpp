#include "surface/search_range.hpp"

#include "surface/facet_geometry.hpp"

namespace carom {

std::vector<double> edge_widths(std::span<const Vec3> coordinates, std::span<const Facet> facets) {
  std::vector<double> widths;
  for (const Facet& facet : facets) widths.push_back(SearchRange::rim_slack * facet_size(place(facet, coordinates)));
  return widths;
}

}  // namespace carom
