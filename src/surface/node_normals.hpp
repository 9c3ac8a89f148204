// Averaged normals of the nodes that look for a surface.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "surface/broad_phase.hpp"
#include "surface/facet_set.hpp"

namespace carom {

/// Normals at nodes, averaged over the facets of their own that these belong to, weighted by their areas. Area vectors
/// of facets at nodes that are near something are computed once for all nodes.
class NodeNormals {
 public:
  /// node_count: above the numbers of all nodes.
  NodeNormals(std::span<const Index> nodes, std::vector<Facet> own, std::size_t node_count);

  std::span<const Facet> own() const { return own_; }
  /// The nodes, which are the queries of the broad phase, that have something on its lists as they are now.
  void choose(const BroadPhase& lists);
  /// To the positions x, which must stay until the last at().
  void move_to(std::span<const Vec3> x);
  /// Of the node in place q, of length 1; zero where it has no facets.
  Vec3 at(std::size_t q) const;

 private:
  std::span<const Index> facets_of(std::size_t q) const {
    return std::span(at_).subspan(begin_[q], begin_[q + 1] - begin_[q]);
  }

  std::vector<Facet> own_;
  std::vector<std::size_t> begin_{0};  ///< the facets of the node in place q: own_[at_[begin_[q]]] ...
  std::vector<Index> at_;
  FacetSet active_;          ///< at nodes that are near something
  std::vector<Vec3> areas_;  ///< area vectors of active facets
  std::span<const Vec3> x_;
};

}  // namespace carom
