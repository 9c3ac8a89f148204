// Orientation of solid cells: turned where the Jacobian is negative, refused where nothing helps.
#pragma once

#include <span>

#include "mesh/mesh.hpp"

namespace carom {

/// Turns every solid cell whose corner Jacobians are all negative (mirrored_order), counts the turned ones and finds
/// the worst Jacobian ratio; fills MeshReport.turned, worst_jacobian, worst_cell. Interfaces of zero thickness are
/// kept as they stand and do not count. In a mesh without three-dimensional cells whose nodes have one z, the plane
/// cells are the solids, and counter-clockwise is positive. Quadratic cells are judged by their corners. Throws
/// CaseError, naming cell and centroid, for a cell with repeated nodes, without volume, or with Jacobians of both
/// signs.
void orient_cells(Mesh& mesh);

/// How a plane cell with these corners (three or four) in the x-y plane turns: +1 when the z component of the product
/// of the edges is clearly positive at all corners (counter-clockwise), -1 when it is clearly negative (clockwise),
/// else 0 (folded, or without area at a corner).
int plane_turn(const Mesh& mesh, std::span<const Index> corners);

/// True when two opposite faces of this hexahedron or pentahedron, or opposite edges of this QUAD4, coincide: each pair
/// of their corners is at most 1e-6 of the cell's size apart (coordinates written in single precision still coincide)
/// and the nodes are distinct.
bool has_zero_thickness(const Mesh& mesh, CellType type, std::span<const Index> nodes);

}  // namespace carom
