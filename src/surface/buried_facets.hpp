// Bodies that start inside of each other, deeper than contact looks.
#pragma once

#include <span>
#include <vector>

#include "model/model.hpp"

namespace carom {

/// A facet of a pair's surfaces that lies inside of a cell of another body.
struct BuriedFacet {
  Facet facet;
  Vec3 position{};  ///< of the point that was looked at
  CellRef cell;     ///< a solid or plane cell of one of the parts
};

/// Facets of the pair's slave and master of which a point lies inside of a solid or, in two dimensions, a plane cell of
/// another body (bodies_of_nodes) at displacement u: cells of its own body do not count, since the straight pieces of
/// curved quadratic faces lie inside of neighbours of their cells. One point of every facet is looked at, off its
/// centre and a thousandth of its size under it, so that surfaces that touch do not count and nodes on the faces of
/// cells do not matter; it is found in the cell by Newton's method. The rows of a pair look one facet deep; this finds
/// what lies deeper, at any depth: what bodies look like that begin on the wrong side of each other. Bars have no
/// inside; contacts that are no pairs have none.
std::vector<BuriedFacet> buried_facets(const Model& model, const ContactDefinition& contact, std::span<const double> u);

}  // namespace carom
