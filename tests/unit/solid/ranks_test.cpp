// What a rank computes of the cells.
#include "parallel/ranks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

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

// A cut between two layers of nodes leaves one of them on the other side; a cut within a layer a row more, and cells
// are computed in whole batches of at most 8, and in whole chunks of 512 by their owner.
TEST(RankShare, NeedsOneLayerOfTheNodesOfOthersAtEachCut) {
  constexpr std::size_t nodes_of_layer = (across + 1) * (across + 1);
  for (const std::size_t count : {2U, 3U, 4U}) {
    std::vector<std::size_t> foreign(count);
    run_on_ranks(count, [&] {
      const SolidCells cells = bar();
      const EntryRange own = share_of(ranks().own(), count, cells.mesh->node_count());
      std::set<Index> seen;
      const RankShare share = rank_share(cells).value();
      for (const ChunkDuty& duty : share.duties)
        for (const Chunk& run : duty.runs)
          for (Index c = 0; c < run.cells; ++c)
            for (const Index n : cells.nodes_of(at(cells.blocks[at(run.block)].first + run.first + c)))
              if (at(n) < own.begin || at(n) >= own.end) seen.insert(n);
      foreign[ranks().own()] = seen.size();
    });
    for (std::size_t r = 0; r < count; ++r) {
      const std::size_t cuts = r == 0 || r + 1 == count ? 1 : 2;
      EXPECT_GE(foreign[r], cuts * nodes_of_layer);
      EXPECT_LE(foreign[r], cuts * (nodes_of_layer + 2 * (across + 1) + 8) + 2 * nodes_of_layer);
    }
  }
}

// Whole sums of its own nodes go to each other rank; with energies and history asked for, those of its chunks as well.
TEST(RankShare, SendsEachOtherRankWhatItOwnsAndNothingElse) {
  for (const std::size_t count : {2U, 3U, 4U})
    run_on_ranks(count, [&] {
      const Solid solid(one_part(block_mesh({across, across, along}, 0.0)));
      const std::vector<double> u = random_vector(solid.dof_count(), 3);
      const std::size_t own = share_of(ranks().own(), count, solid.node_count()).size();
      std::vector<double> f(u.size());
      const Traffic before = ranks().sent();
      solid.internal_force(u, f, {});
      const Traffic after = ranks().sent();
      EXPECT_EQ(after.messages - before.messages, count - 1);
      EXPECT_EQ(after.values - before.values, (count - 1) * 3 * own);
    });
}

// Where nodes are shared out, a rank gives those of its cells that others compute: one layer at each cut, as above, and
// what is left of a block of 2048 that its neighbour adds up.
TEST(RankShare, SendsWhatOthersHoldWhereNodesAreSharedOut) {
  constexpr std::size_t nodes_of_layer = (across + 1) * (across + 1);
  for (const std::size_t count : {2U, 3U, 4U})
    run_on_ranks(count, [&] {
      const Solid solid(one_part(block_mesh({across, across, along}, 0.0)));
      const std::vector<double> u = random_vector(solid.dof_count(), 3);
      std::vector<double> shared(u.size()), whole(u.size());
      solid.internal_force(u, whole, {});
      const Traffic before = ranks().sent();
      solid.internal_force(u, shared, {.history = {}, .nodes = &solid.shared_nodes()});
      const Traffic after = ranks().sent();
      const std::size_t cuts = ranks().own() == 0 || ranks().own() + 1 == count ? 1 : 2;
      EXPECT_EQ(after.messages - before.messages, cuts);
      EXPECT_LE(after.values - before.values, 3 * cuts * (4 * nodes_of_layer + 2048));
      solid.shared_nodes().each_range([&](std::size_t begin, std::size_t end) {
        for (std::size_t i = 3 * begin; i < 3 * end; ++i) EXPECT_EQ(shared[i], whole[i]);
      });
    });
}

// What acts through the whole body: an equation between its ends, a part that is damped, a support that moves.
TEST(RankShare, AllHoldAllWhereSomethingActsThroughTheBody) {
  const auto shares = [](const auto& change) {
    bool is_whole = false;
    run_on_ranks(2, [&] {
      Model model = one_part(block_mesh({across, across, along}, 0.0));
      change(model);
      const Solid solid(model);
      if (ranks().own() == 0) is_whole = solid.shared_nodes().is_whole();
    });
    return !is_whole;
  };
  EXPECT_TRUE(shares([](Model&) {}));
  EXPECT_TRUE(shares([](Model& m) { m.motions.push_back({"held", {0, 1}, 0, MotionKind::velocity, {{0.0}, {0.0}}}); }));
  EXPECT_FALSE(shares([](Model& m) { m.motions.push_back({"led", {0}, 0, MotionKind::velocity, {{0.0}, {1.0}}}); }));
  EXPECT_FALSE(shares([](Model& m) { m.parts[0].viscosity.linear = 0.06; }));
  EXPECT_FALSE(shares([](Model& m) { m.equations.push_back({"tied", {{0, 0, 1.0}, {9, 0, -1.0}}}); }));
}

}  // namespace
}  // namespace carom::test::solid_ranks_test
