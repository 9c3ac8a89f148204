// The facets that nodes may be near: what many queries ask of each.
#pragma once

#include <span>
#include <vector>

#include "surface/box_tree.hpp"
#include "surface/broad_phase.hpp"
#include "surface/facet_set.hpp"

namespace carom {

/// The facets on the lists of a broad phase, with the bounds and normals of one configuration.
class ActiveFacets {
 public:
  /// Those on the lists as they are now.
  void choose(const BroadPhase& lists);
  /// To the positions x; facets: all of the surface.
  void move_to(std::span<const Facet> facets, std::span<const Vec3> x);

  bool has(Index f) const { return active_.contains(f); }
  /// Precondition of both: has(f).
  const Bounds& bounds(Index f) const { return bounds_[f]; }
  /// Unit normal at the centre.
  const Vec3& normal(Index f) const { return normals_[f]; }

 private:
  FacetSet active_;
  std::vector<Bounds> bounds_;  ///< both by facet
  std::vector<Vec3> normals_;
};

}  // namespace carom
