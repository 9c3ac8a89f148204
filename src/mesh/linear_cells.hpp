// Meshes of second order taken as meshes of first order.
#pragma once

#include "mesh/mesh.hpp"

namespace carom {

/// The cells of the corners: HEXA20 and HEXA27 become HEXA8, TETRA10 TETRA4 and so on. Nodes that were only in the
/// middle of cells are dropped, also from groups, with the points on them; all other nodes, cells and groups keep their
/// numbers and names. Curved edges become straight.
Mesh linear_cells(Mesh mesh);

}  // namespace carom
