// The search for the points where nodes touch a surface: the closest point that counts, through edges and corners, and
// crossings within a step.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "surface/broad_phase.hpp"
#include "surface/node_normals.hpp"
#include "surface/node_query.hpp"
#include "surface/search_range.hpp"
#include "surface/surface_point.hpp"
#include "surface/target_surface.hpp"

namespace carom {

/// Closest points of nodes on a surface of segments, triangles and quadrilaterals.
///
/// A facet within `reach` counts for a node if it does not contain the node, is no neighbour of a facet that does, and
/// has a normal (at its centre) that opposes the node's own averaged normal, n_s . n_m < `opposed`, where the node has
/// one. The node meets the closest point of the facets that count. Where these belong to several bodies
/// (SearchRange::body) it meets the one with the least gap, so that a node inside one body is not held off by another
/// that is nearer in front of it. Behind a facet the search looks to the facet's depth only, so that nodes do not touch
/// the far side of their own thin plate. On an edge or corner the sign of the gap is that of the pseudonormal (sum of
/// the normals of the facets there, at corners weighted by their angles), which is right at all edges and corners of
/// closed surfaces (Baerentzen and Aanaes, IEEE Trans. Vis. Comput. Graphics 11(3), 2005).
///
/// Beside an edge the node meets every facet f there that counts and is turned by at most 60 degrees: with g_f the
/// distance from f continued beyond its edges, d_f that from f itself, g that from the nearest facet continued, b_f
/// SearchRange::width and c_f a quarter of it, the weights are (1 - (d_f^2 - g_f^2) / b_f^2)^2 (1 - (g_f - g)^2 /
/// c_f^2)^2 over their sum. So gap and gradient pass from facet to facet without a jump, alike from all sides and
/// whatever the order of the facets; and a facet far behind which the node is, as beside a sharp edge, does not make it
/// deep. In the plane a node that points between the two sides of a corner, however sharp, meets both in the same way:
/// corners that meet symmetrically push each other back along the axis of symmetry. (In space edges do that:
/// edge_rows.hpp.)
///
/// Where the surface goes on with facets that do not count, a node that was behind the facet's plane at x_begin without
/// having been behind the surface is no deeper than it is behind those: where that is the way out, the row pushes it
/// out sideways, its facet -1. So a node that enters sideways begins at the surface, and those that have come through
/// the front stay with it. The sides may be taken as moved out by a fiftieth of the facet's size: nodes on the common
/// rim of two aligned bodies are not lost, which needs it where rows hold them with a gap of zero, and at the start.
/// With springs a node that a facet ceases to count for would be deep at once.
///
/// Where the surface ends, or the node has come through the front, it touches nothing behind it and beside it; but the
/// facets are continued by a tenth of their size (SearchRange::width), on which a gap below zero fades: it is
/// multiplied by (1 - t^2 / width^2)^2, t the distance beside the facet.
///
/// A node that was behind a facet at x_begin stays behind the surface there, however deep it goes, until it comes out
/// in front or leaves it sideways: unless it is behind what the search finds, its closest point is looked for from that
/// facet on, from neighbour to nearer neighbour, without the limits of reach and depth.
///
/// A node that was in front of a facet at x_begin and is behind it at x, having gone through it, meets that facet
/// however deep it is, unless its closest point says already that it is behind the surface. Facets are taken as moving
/// without turning within the step.
class SurfaceSearch {
 public:
  /// `own`: the facets that the nodes belong to, for their averaged normals; nodes on none have no normal.
  SurfaceSearch(std::vector<Index> nodes, std::vector<Facet> own, std::vector<Facet> facets, SearchRange range);
  SurfaceSearch(const SurfaceSearch&) = delete;
  SurfaceSearch& operator=(const SurfaceSearch&) = delete;

  /// Brings the search up to date. The positions must stay until the last find; displacement = x - x_begin. behind: by
  /// node of nodes() the facet that it was behind at x_begin, -1: none; empty: none was.
  void update(std::span<const Vec3> x_begin, std::span<const Vec3> x, std::span<const Vec3> displacement,
              std::vector<Index> behind = {});
  /// Memory that one thread needs for its calls of find.
  struct Space {
    SurfacePoint found, other, side;
    std::vector<Index> candidates;
    std::vector<double> box_distance;
  };
  /// The point that nodes()[q] meets, or null. It stands in the space until the next call. May be called from many
  /// threads.
  const SurfacePoint* find(std::size_t q, Space& space) const;

  std::span<const Index> nodes() const { return nodes_; }
  /// What nodes()[q] would meet on other sides of the body that it is in, were they the nearest: on facets that do not
  /// go on in the nearest of `met`, behind which it is no more than twice as deep and has its foot; of facets that go
  /// on in each other the nearest. In the plane none, where a node at a corner meets both of its sides.
  std::vector<SurfacePoint> other_sides(std::size_t q, const SurfacePoint& met, Space& space) const;
  std::span<const Facet> facets() const { return broad_phase_.targets(); }
  long builds() const { return broad_phase_.builds(); }

 private:
  Index body_of(Index f) const { return range_.body_of(facets()[f][0]); }
  std::span<const Index> by_body(std::span<const Index> candidates, Space& space) const;
  NodeQuery query_of(std::size_t q, std::span<const Index> candidates, Index behind, Space& space) const;
  bool find_nearest(const NodeQuery& query, Space& space) const;

  std::vector<Index> nodes_;
  SearchRange range_;
  BroadPhase broad_phase_;
  TargetSurface surface_;
  NodeNormals normals_;
  std::vector<std::vector<Index>> excluded_;  ///< by query, increasing: neighbours of the node's own facets
  std::vector<Index> behind_;
  long active_since_ = -1;  ///< the build of the lists that surface_ and normals_ have been made ready for
  double least_depth_;
  bool is_fast_ = false;  ///< something may have crossed a facet without being near it now
};

}  // namespace carom
