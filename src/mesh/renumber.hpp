// Numbering for locality: nodes in levels from one end of the body to the other, cells along with their nodes.
#pragma once

#include "mesh/mesh.hpp"

namespace carom {

/// The same mesh under new local indices; numbers of the file, groups and node order within cells stay.
/// Nodes: in each connected body (through its cells of highest dimension), breadth-first levels from the nodes at the
/// lower end of the longest side of its bounding box; within a level sorted by the mean place of their neighbours in
/// the level before (after E. Cuthill and J. McKee, Proc. 24th ACM Nat. Conf., 1969; the barycentre instead of the
/// first neighbour keeps rows straight). Cells: by their smallest node, then by the sum of their nodes. A straight
/// block numbered naturally along its longest side comes out as it was. O(n log n) with n of one level.
Mesh renumbered(Mesh mesh);

}  // namespace carom
