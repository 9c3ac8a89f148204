// Which facets of a surface are neighbours.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "surface/facet_projection.hpp"

namespace carom {

inline bool has_node(const Facet& facet, Index node) {
  return std::find(facet.begin(), facet.end(), node) != facet.end();
}

/// By node, up to node_count, the facets that it belongs to, increasing.
std::vector<std::vector<Index>> facets_of_nodes(std::span<const Facet> facets, std::size_t node_count);

/// The facets at each node of a surface, and so those beyond an edge.
class SurfaceTopology {
 public:
  /// The facets outlive it. node_count: above the number of every node that is asked for.
  SurfaceTopology(std::span<const Facet> facets, std::size_t node_count);

  std::span<const Facet> facets() const { return facets_; }
  /// Of all facets, each once, increasing.
  std::span<const Index> nodes() const { return nodes_; }
  std::size_t node_count() const { return facets_at_.size(); }
  /// The facets at a node.
  std::span<const Index> at(Index node) const { return facets_at_[node]; }
  /// The facets at the corner p of facet f, or at the first node of its edge p.
  std::span<const Index> around(Index f, const Projection& p) const {
    return at(facets_[f][static_cast<std::size_t>(p.feature)]);
  }
  /// True when g, one of those around, has the corner or the whole edge of facet f where p is.
  bool is_at(Index g, Index f, const Projection& p) const;
  /// True when another facet lies beyond the edge or end of facet f where p is.
  bool goes_on(Index f, const Projection& p) const;
  /// Of each of these nodes, the facets that share a node with a facet that it belongs to, be that one of the surface
  /// or of `own`; increasing.
  std::vector<std::vector<Index>> neighbours(std::span<const Index> nodes, std::span<const Facet> own) const;

 private:
  std::span<const Facet> facets_;
  std::vector<std::vector<Index>> facets_at_;  ///< by node
  std::vector<Index> nodes_;
};

}  // namespace carom
