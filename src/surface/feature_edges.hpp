// The edges of a surface: where sharp ones cross those of other bodies, bodies may meet before any node meets a facet.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "mesh/facet.hpp"

namespace carom {

/// The end of a segment of an edge: a corner, or a node where the edge goes on.
struct EdgeEnd {
  bool goes_on = false;
  double width = 0.0;  ///< a tenth of the shorter segment there, as a part of this one; a fiftieth of this at a corner
};

/// A segment of an edge, between two nodes of the mesh.
struct FeatureEdge {
  std::array<Index, 2> node{};
  std::array<Facet, 2> facet{};  ///< the first has its nodes in this order, the second in the other
  double turn = 0.0;             ///< angle between the outward normals of both, negative in a notch
  double measure = 0.0;          ///< share of area: that of each facet over the number of its nodes
  std::array<EdgeEnd, 2> end{};  ///< at node[0] and node[1]
  bool is_sharp = false;         ///< see meeting_edges.hpp; feature_edges leaves it false
  bool is_fold = false;          ///< a diagonal along which a flat facet may bend
};

/// The facets of `skin` that are not in the surface.
std::vector<Facet> facets_beside(std::span<const Facet> surface, std::span<const Facet> skin);

/// The edges between two facets of three or four nodes that turn by more than `least_turn`, by increasing numbers of
/// their nodes. One of the facets at least is of the surface; where that ends, the other one is looked for in `beside`
/// (the skin of the mesh; facets of the surface may be in it). Edges with a third facet have no inside and are left
/// out. Warped quadrilaterals, whose halves turn by more than half a degree, have an edge along the diagonal that
/// sticks out. An edge goes on at a node where exactly one other edge leaves it straight on, to a thousandth: the line
/// of a segment of a curved edge sticks out of the body beyond the segment's end. X: reference configuration.
std::vector<FeatureEdge> feature_edges(std::span<const Vec3> X, std::span<const Facet> surface,
                                       std::span<const Facet> beside, double least_turn);

/// Both diagonals of the quadrilaterals that are flat, by increasing numbers of their nodes: where these bend, one of
/// them sticks out.
std::vector<FeatureEdge> fold_edges(std::span<const Vec3> X, std::span<const Facet> surface);

/// True when a facet of the surface has an edge that no other one shares.
bool has_open_edges(std::span<const Facet> surface);

}  // namespace carom
