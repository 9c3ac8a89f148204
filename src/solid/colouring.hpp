// Chunks of cells that may run at the same time.
#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// Greedy colouring: chunks of one colour share no node. chunk_nodes[c]: the nodes of chunk c, repetitions allowed.
/// Returns the colour of each chunk, 0-based.
std::vector<int> colour_chunks(std::size_t node_count, std::span<const std::vector<Index>> chunk_nodes);

}  // namespace carom
