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
  int face = 0;  ///< of the cell (cell_faces)
};

/// What belongs to exactly one cell, block after block in the order of their cells: faces of solids (normal outward);
/// edges of plane cells that are not faces of solids (the body on the left if the cell is counter-clockwise); ends of
/// chains of lines that are not edges of other cells. Two faces are the same where their corners are. Quadratic ones
/// are cut into linear facets (face_pieces). Cells that are pieces of a boundary (on_boundary) have no facets of their
/// own, and where a cell ends in one of a higher dimension (a bar in a body) it has none either. Interfaces of zero
/// thickness are left out, so that the facets beside them are outer ones. Time is linear in the number of cells.
std::vector<OuterFacet> outer_facets(const Mesh& mesh);

/// The facets of outer_facets alone.
std::vector<Facet> skin(const Mesh& mesh);

}  // namespace carom
