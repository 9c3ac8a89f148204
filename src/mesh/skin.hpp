// The outer surface of the cells that may be solids.
#pragma once

#include <vector>

#include "mesh/facet.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// A facet of the skin and the cell it belongs to.
struct OuterFacet {
  Facet facet;
  CellRef cell;
};

/// What belongs to exactly one cell, block after block in the order of their cells: faces of HEXA8 (normal outward);
/// edges of QUAD4 that are not faces of solids (the body on the left if the cell is counter-clockwise); ends of chains
/// of LINE2 that are not edges of other cells. Cells that are pieces of a boundary (on_boundary) have no facets of
/// their own, and where a cell ends in one of a higher dimension (a bar in a body) it has none either. Interfaces of
/// zero thickness are left out, so that the facets beside them are outer ones. Time is linear in the number of cells.
std::vector<OuterFacet> outer_facets(const Mesh& mesh);

/// The facets of outer_facets alone.
std::vector<Facet> skin(const Mesh& mesh);

}  // namespace carom
