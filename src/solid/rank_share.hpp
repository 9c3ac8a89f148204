// What a rank computes of the cells, so that its nodes have the same sums as in a run on one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "parallel/ranks.hpp"
#include "solid/blocks.hpp"

namespace carom {

/// What a rank has to do in one chunk of cells.
struct ChunkDuty {
  std::size_t chunk = 0;
  std::vector<Chunk> runs;  ///< the cells that it computes: whole batches, all of them if it is its own
};

/// A rank owns nodes that follow each other (share_of), and the chunks whose first cell has its lowest node among them.
/// It computes its own chunks, and of others the batches that its nodes stand in: cells between ranks are computed by
/// several of them. So each node's sum is made by its owner, cell by cell in the order of a run on one rank, whatever
/// the number of ranks, and no partial sums travel.
struct RankShare {
  std::vector<ChunkDuty> duties;          ///< by colour
  std::vector<std::size_t> colour_begin;  ///< as SolidCells::colour_begin
  Exchange by_chunk, history;             ///< an entry for each chunk, and the history
  std::vector<std::uint8_t> is_own;       ///< by chunk
  std::size_t cells = 0;                  ///< how many the rank computes
  std::vector<EntryRange> held_history;   ///< of these cells, in their order
};

/// Of the calling thread's rank; nothing where it is the only one.
std::optional<RankShare> rank_share(const SolidCells& cells);

/// Marks the nodes of the cells that the rank computes.
void mark_computed(const SolidCells& cells, const RankShare& share, std::span<std::uint8_t> held);

}  // namespace carom
