#include "surface/surface_topology.hpp"

#include <algorithm>

namespace carom {

std::vector<std::vector<Index>> facets_of_nodes(std::span<const Facet> facets, std::size_t node_count) {
  std::vector<std::vector<Index>> facets_at(node_count);
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const Index n : facets[f]) facets_at[n].push_back(static_cast<Index>(f));
  return facets_at;
}

SurfaceTopology::SurfaceTopology(std::span<const Facet> facets, std::size_t node_count)
    : facets_(facets), facets_at_(facets_of_nodes(facets, node_count)) {
  for (std::size_t n = 0; n < facets_at_.size(); ++n)
    if (!facets_at_[n].empty()) nodes_.push_back(static_cast<Index>(n));
}

bool SurfaceTopology::is_at(Index g, Index f, const Projection& p) const {
  const Facet& facet = facets_[f];
  const auto next = (static_cast<std::size_t>(p.feature) + 1) % static_cast<std::size_t>(facet.size);
  return p.site != ProjectionSite::edge || has_node(facets_[g], facet[next]);
}

bool SurfaceTopology::goes_on(Index f, const Projection& p) const {
  return std::ranges::any_of(around(f, p), [&](Index g) { return g != f && is_at(g, f, p); });
}

std::vector<std::vector<Index>> SurfaceTopology::neighbours(std::span<const Index> nodes,
                                                            std::span<const Facet> own) const {
  std::vector<std::vector<Index>> ring(facets_at_.size());  // nodes of the facets that a node belongs to
  for (const std::span<const Facet> all : {facets_, own})
    for (const Facet& facet : all)
      for (const Index n : facet) ring[n].insert(ring[n].end(), facet.begin(), facet.end());
  std::vector<std::vector<Index>> lists(nodes.size());
  for (std::size_t q = 0; q < nodes.size(); ++q) {
    std::vector<Index>& list = lists[q];
    for (const Index n : ring[nodes[q]]) list.insert(list.end(), facets_at_[n].begin(), facets_at_[n].end());
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return lists;
}

}  // namespace carom
