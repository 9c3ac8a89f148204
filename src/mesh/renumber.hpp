// Numbering for locality: nodes in levels from one end of the body to the other, of large bodies along a curve; cells
// along with their nodes.
#pragma once

#include "mesh/mesh.hpp"

namespace carom {

/// The same mesh under new local indices; numbers of the file, groups and node order within cells stay.
/// Nodes: in each connected body (through the cells that are no pieces of a boundary), breadth-first levels from the
/// nodes at the lower end of the longest side of its bounding box; within a level sorted by the mean place of their
/// neighbours in the level before, along edges where there are some (after E. Cuthill and J. McKee, Proc. 24th ACM Nat.
/// Conf., 1969, with the mean instead of the first neighbour, which keeps rows straight). Cells: by their smallest
/// node, then by the sum of their nodes. A straight block numbered naturally along its longest side comes out as it
/// was.
/// Bodies of more than 4096 nodes are then taken bin by bin, the bins along Hilbert's curve: what follows each other
/// makes lumps, whose frontiers are smaller than those of slabs, and which stay near the processor. Where cells follow
/// each other in straight rows, the bins are columns along the rows. Time grows as the number of nodes times the
/// logarithm of the size of a level.
Mesh renumbered(Mesh mesh);

}  // namespace carom
