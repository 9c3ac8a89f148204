// The stiffness of the bodies on a coarse space, without their matrix.
#pragma once

#include "linalg/block_matrix.hpp"
#include "solid/blocks.hpp"

namespace carom {

/// P^T K(u) P summed over the cells, P^T K P = sum of P_e^T K_e P_e. fixed: bit c of a node's entry takes its component
/// c out of P. `u` empty: at rest. Threaded, the same bits for any thread count.
BlockMatrix projected_stiffness(const SolidCells& solid, std::span<const double> u, const PointStep& step,
                                const Interpolation& P, std::span<const std::uint8_t> fixed);

}  // namespace carom
