// The last stage of every reader: from file order to the mesh the solver sees.
#pragma once

#include "mesh/mesh.hpp"

namespace carom {

/// Sorts the groups, turns and checks the solid cells (orient_cells) and renumbers for locality (renumbered).
/// Throws CaseError for a cell that cannot be mended.
Mesh finished(Mesh mesh);

}  // namespace carom
