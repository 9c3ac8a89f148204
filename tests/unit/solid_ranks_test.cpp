// What a rank computes of the cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "parallel/ranks.hpp"
#include "solid/rank_share.hpp"
#include "solid_fixture.hpp"

namespace carom::test::solid_ranks_test {
namespace {

constexpr std::size_t across = 16, along = 48, layer = across * across;  // cells: 24 chunks of 512

SolidCells bar() {
  return make_solid_cells(one_part(block_mesh({across, across, along}, 0.0)), kernels_v2());
}

TEST(RankShare, ThereIsNoneOfASingleRank) {
  EXPECT_FALSE(rank_share(bar()).has_value());
}

// Every node that a rank owns finds all of its cells among those that the rank computes.
TEST(RankShare, HasAllCellsOfItsNodes) {
  run_on_ranks(3, [] {
    const SolidCells cells = bar();
    const RankShare share = rank_share(cells).value();
    std::set<std::size_t> computed;
    for (const ChunkDuty& duty : share.duties)
      for (const Chunk& run : duty.runs)
        for (Index c = 0; c < run.cells; ++c) computed.insert(at(cells.blocks[at(run.block)].first + run.first + c));
    EXPECT_EQ(computed.size(), share.cells) << "no cell twice";
    const EntryRange own = share_of(ranks().own(), 3, cells.mesh->node_count());
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const bool is_needed =
          std::ranges::any_of(cells.nodes_of(k), [&](Index n) { return at(n) >= own.begin && at(n) < own.end; });
      EXPECT_TRUE(!is_needed || computed.contains(k)) << "cell " << k;
    }
  });
}

// Nodes are numbered layer by layer: between two ranks one layer of cells is computed by both of them, where the layer
// of nodes is cut up to a row more on either side, filled up to whole batches of at most 8; and of a chunk that a rank
// owns and whose last cells are at nodes of the next one, these as well.
TEST(RankShare, ComputesOneLayerOfCellsTwice) {
  for (const std::size_t count : {2U, 3U, 4U}) {
    std::vector<std::size_t> computed(count);
    run_on_ranks(count, [&] { computed[ranks().own()] = rank_share(bar()).value().cells; });
    const std::size_t twice = std::accumulate(computed.begin(), computed.end(), std::size_t{0}) - layer * along;
    EXPECT_GE(twice, (count - 1) * (layer - across));
    EXPECT_LE(twice, (count - 1) * (layer + 2 * (across + 8) + 512));
  }
}

}  // namespace
}  // namespace carom::test::solid_ranks_test
