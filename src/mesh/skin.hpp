// The outer surface of the cells that may be solids.
#pragma once

#include <functional>
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

/// A face that two cells share; of cells of several dimensions or of zero thickness none does (see outer_facets).
struct SharedFace {
  CellRef cell;
  int face = 0;
  CellRef other;
  int other_face = 0;
};

/// The faces that a wanted cell shares with another one, by that cell; twice if both are wanted.
std::vector<SharedFace> shared_faces(const Mesh& mesh, const std::function<bool(const CellRef&)>& is_wanted);

/// Appends the linear facets of a face of a cell, normals outward.
void append_facets(const Mesh& mesh, const CellRef& cell, int face, std::vector<OuterFacet>& facets);

/// The facets of outer_facets alone.
std::vector<Facet> skin(const Mesh& mesh);

}  // namespace carom
