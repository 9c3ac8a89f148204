#include "solid/rank_share.hpp"

#include <algorithm>

namespace carom {
namespace {

Index lowest_node(const SolidCells& cells, const Chunk& chunk) {
  return std::ranges::min(cells.nodes_of(at(cells.blocks[at(chunk.block)].first + chunk.first)));
}

/// The batches of a chunk that have a node in the range.
std::vector<Chunk> batches_at(const SolidCells& cells, const Chunk& chunk, const EntryRange& nodes) {
  const Block& block = cells.blocks[at(chunk.block)];
  const auto is_own = [&](Index n) { return at(n) >= nodes.begin && at(n) < nodes.end; };
  std::vector<Chunk> runs;
  for (Index first = 0; first < chunk.cells; first += block.stages.lanes) {
    const Index count = std::min<Index>(block.stages.lanes, chunk.cells - first);
    bool is_needed = false;
    for (Index c = 0; c < count && !is_needed; ++c)
      is_needed = std::ranges::any_of(cells.nodes_of(at(block.first + chunk.first + first + c)), is_own);
    if (!is_needed) continue;
    if (!runs.empty() && runs.back().first + runs.back().cells == chunk.first + first)
      runs.back().cells += count;
    else
      runs.push_back({chunk.block, chunk.first + first, count});
  }
  return runs;
}

EntryRange history_of(const SolidCells& cells, const Chunk& chunk) {
  const Block& block = cells.blocks[at(chunk.block)];
  const std::size_t each = block.history_per_cell(), lanes = block.lanes(),
                    filled = (at(chunk.cells) + lanes - 1) / lanes * lanes,
                    begin = block.history_first + each * at(chunk.first);
  return {begin, begin + each * filled};
}

std::size_t owner_of(const SolidCells& cells, const Chunk& chunk) {
  return sharer_of(at(lowest_node(cells, chunk)), ranks().count(), cells.mesh->node_count());
}

}  // namespace

std::optional<RankShare> rank_share(const SolidCells& cells) {
  const std::size_t count = ranks().count(), own = ranks().own(), node_count = cells.mesh->node_count();
  if (count == 1) return std::nullopt;
  std::vector<std::size_t> owner;
  std::vector<std::vector<EntryRange>> chunks(count), history(count);
  for (std::size_t c = 0; c < cells.chunks.size(); ++c) {
    const std::size_t rank = owner_of(cells, cells.chunks[c]);
    owner.push_back(rank);
    chunks[rank].push_back({c, c + 1});
    history[rank].push_back(history_of(cells, cells.chunks[c]));
  }
  RankShare share{{}, {0}, Exchange(std::move(chunks)), Exchange(std::move(history)), {}, 0, {}};
  for (const std::size_t rank : owner) share.is_own.push_back(rank == own ? 1 : 0);
  for (std::size_t colour = 0; colour + 1 < cells.colour_begin.size(); ++colour) {
    for (std::size_t c = cells.colour_begin[colour]; c < cells.colour_begin[colour + 1]; ++c) {
      ChunkDuty duty{c, {cells.chunks[c]}};
      if (owner[c] != own) duty.runs = batches_at(cells, cells.chunks[c], share_of(own, count, node_count));
      for (const Chunk& run : duty.runs) {
        share.cells += at(run.cells);
        share.held_history.push_back(history_of(cells, run));
      }
      if (!duty.runs.empty()) share.duties.push_back(std::move(duty));
    }
    share.colour_begin.push_back(share.duties.size());
  }
  std::ranges::sort(share.held_history, {}, &EntryRange::begin);
  return share;
}

void mark_computed(const SolidCells& cells, const RankShare& share, std::span<std::uint8_t> held) {
  for (const ChunkDuty& duty : share.duties)
    for (const Chunk& run : duty.runs) {
      const Index first = cells.blocks[at(run.block)].first + run.first;
      for (Index c = first; c < first + run.cells; ++c)
        for (const Index n : cells.nodes_of(at(c))) held[at(n)] = 1;
    }
}

}  // namespace carom
