// Which edges of two surfaces make rows with which.
#pragma once

#include <vector>

#include "contact/smooth_surface.hpp"
#include "model/model.hpp"
#include "surface/edge_pair.hpp"
#include "surface/feature_edges.hpp"

namespace carom {

/// Which pairs of edges make rows. Lengths are parts of the larger mean facet size of both surfaces.
struct EdgeRule {
  PairFactor factor;  ///< border: of two sharp edges; `moves` of others
  double least_factor;
  bool from_the_front;   ///< what has come from the front counts, else all to the depth of either edge
  double reach, margin;  ///< gap to which rows are made; margin of the search
};

/// Edges of one surface and those of the other that they may make rows with.
struct MeetingEdges {
  EdgeRule rule;
  double size;   ///< the larger mean facet size of both surfaces
  bool is_self;  ///< the surfaces are one
  bool is_back;  ///< `first` is of the contact's second surface
  std::vector<FeatureEdge> first, second;
  std::vector<double> depth_1, depth_2;  ///< by edge, half the thickness behind it; of PairFactor::held none
};

/// See edge_rows.hpp for the rules. With multipliers of implicit steps edges of more than 30 degrees with each other;
/// else the sharp edges of the first surface with all of the second, then the sharp ones of the second with those of
/// the first that are not. Lists in which no edges meet are left out. smooth: of the contact, null where it is seen as
/// facets.
std::vector<MeetingEdges> meeting_edges(const Model& model, const PairContact& contact, const SmoothSides* smooth);

}  // namespace carom
