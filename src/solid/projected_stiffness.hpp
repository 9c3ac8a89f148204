// The stiffness of the bodies on a coarse space, without their matrix.
#pragma once

#include "linalg/block_matrix.hpp"
#include "solid/blocks.hpp"

namespace carom {

/// K(u), summed over the cells, on a coarse space and as it is, from one computation of the cells' matrices:
///   coarse = P^T K P = sum of P_e^T K_e P_e, fixed: bit c of a node's entry takes its component c out of P;
///   fine   = K in single precision, all components in it; null: not wanted, else it has the graph of the nodes.
/// coarse: empty, or of an earlier call, whose graph it keeps. `u` empty: at rest. Every rank has all of the coarse
/// matrix and the rows of its own nodes (share_of) of the fine one. The same bits for any number of threads and ranks.
void project_stiffness(std::span<const SolidCells* const> solids, std::span<const double> u, const PointStep& step,
                       const Interpolation& P, std::span<const std::uint8_t> fixed, BlockMatrix& coarse,
                       BlockMatrix* fine);

}  // namespace carom
