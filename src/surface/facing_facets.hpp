// Facets of the two surfaces of a pair that look at each other at the start.
#pragma once

#include <vector>

#include "model/model.hpp"

namespace carom {

/// The facets of a pair that can touch while the bodies turn little and none passes by the other: those that look at
/// one of the other side at least. Facets a and b look at each other where their normals oppose each other as contact
/// asks for (n_a . n_b < -0.1) and each lies, by a node at least, before the plane of the other, or behind it by no
/// more than a quarter of both their sizes (from the centre to the farthest node). Facets of `self`, and ends of bars,
/// are all there; so are all facets where none look at each other.
struct FacingFacets {
  std::vector<Facet> slave, master;
};

/// The facets of a pair that look at each other at the initial displacements.
FacingFacets facing_facets(const Model& model, const PairContact& pair);

/// The model whose pairs have these facets only.
Model with_facing_facets(Model model);

}  // namespace carom
