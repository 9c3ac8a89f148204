// Finer meshes: every cell cut in halves along each of its directions.
#pragma once

#include "mesh/mesh.hpp"

namespace carom {

/// Each HEXA8, PENTA6 and TETRA4 becomes 8, QUAD4 and TRIA3 4, LINE2 2 cells; new nodes are the means of the corners of
/// their edge, face or cell, so that faces stay where they were. Cell groups hold the cells that theirs became; a node
/// group takes the new nodes of the edges and faces of cells all of whose corners it holds. Nodes keep their numbers,
/// new ones count on; new cells have the number of the one they came from. Throws CaseError naming the file for cells
/// of other types than these and POINT1, and for HEXA8 of zero thickness, which no halves replace.
Mesh split_cells(Mesh mesh);

}  // namespace carom
