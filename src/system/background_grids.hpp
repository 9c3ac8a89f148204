// Grids of boxes laid over the bodies, for coarse spaces that know nothing of the cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linalg/block_matrix.hpp"
#include "solid/solid.hpp"

namespace carom {

/// Interpolations from grid to grid, the finest first: levels[0] leads from the corners of the first grid's boxes to
/// the nodes, levels[l] from those of the next grid to those of the one before. Fields on a grid are trilinear, so that
/// they hold every linear field of a body exactly, its rigid motions among them, and those of each grid are among those
/// of the one before. A body is what cells connect, or a free node alone; each has grids of its own, along the axes,
/// with its lowest corner for origin: on a regular mesh the corners are every second node. The boxes of the first grid
/// are two cells wide (one, where cells have nodes on their edges); from grid to grid the widths double that are the
/// smallest ones or near, so that flat boxes become cubes first; a body that is one box thick keeps its boxes unless
/// they are thousands. fixed: bit c of a node's entry for its component c; nodes without cells of which nothing moves
/// have no part. Ends when there are at most `enough` corners, or when another grid would have nearly as many.
/// (Auxiliary grids: Xu, Computing 56, 1996.)
std::vector<Interpolation> background_grids(const Mesh& mesh, const Solid& solid, std::span<const std::uint8_t> fixed,
                                            std::size_t enough);

}  // namespace carom
