// The surface that nodes may touch, where it is within a step.
#pragma once

#include <cstddef>
#include <span>

#include "surface/active_facets.hpp"
#include "surface/broad_phase.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/facet_projection.hpp"
#include "surface/surface_topology.hpp"

namespace carom {

/// Positions of all nodes at both ends of a step; displacement = x - x_begin.
struct StepMotion {
  std::span<const Vec3> x_begin, x, displacement;
};

/// Facets with their neighbours, where they are at both ends of a step.
class TargetSurface {
 public:
  /// The facets outlive it. node_count: above the numbers of all nodes.
  TargetSurface(std::span<const Facet> facets, std::size_t node_count) : topology_(facets, node_count) {}

  /// The positions must stay until the last question.
  void move_to(const StepMotion& motion) { motion_ = motion; }
  /// What many queries ask for is computed once for the facets on the lists as they are now,
  void choose_active(const BroadPhase& lists) { active_.choose(lists); }
  /// each time that they have moved.
  void place_active() { active_.move_to(facets(), motion_.x); }

  const SurfaceTopology& topology() const { return topology_; }
  const StepMotion& motion() const { return motion_; }
  std::span<const Facet> facets() const { return topology_.facets(); }
  const Facet& facet(Index f) const { return facets()[f]; }
  PlacedFacet placed(Index f) const { return place(facet(f), motion_.x); }
  PlacedFacet placed_at_begin(Index f) const { return place(facet(f), motion_.x_begin); }
  /// Of a facet on the lists.
  const Bounds& bounds(Index f) const { return active_.bounds(f); }
  /// Unit normal at the centre.
  Vec3 normal(Index f) const { return active_.has(f) ? active_.normal(f) : direction(area_vector(placed(f))); }
  /// Unit normal at a closest point p on an edge or corner of facet f: along the sum of the normals of the facets
  /// there, at corners weighted by their angles.
  Vec3 pseudonormal(Index f, const Projection& p) const;

 private:
  SurfaceTopology topology_;
  ActiveFacets active_;
  StepMotion motion_;
};

}  // namespace carom
