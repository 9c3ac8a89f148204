// Numbering for locality: what it must keep and what it must reach.
#include "mesh/renumber.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "mesh/finish_mesh.hpp"
#include "mesh/structured_block.hpp"
#include "mesh_fixture.hpp"

namespace carom::mesh_renumber_test {
namespace {

/// The same mesh with node and cell indices permuted at random.
Mesh shuffled(const Mesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Index> place(mesh.node_count());
  std::iota(place.begin(), place.end(), 0);
  std::shuffle(place.begin(), place.end(), random);
  Mesh result = mesh;
  for (std::size_t i = 0; i < mesh.node_count(); ++i) {
    result.coordinates[static_cast<std::size_t>(place[i])] = mesh.coordinates[i];
    result.node_numbers[static_cast<std::size_t>(place[i])] = mesh.node_numbers[i];
  }
  for (auto& [name, nodes] : result.node_groups)
    for (Index& n : nodes) n = place[static_cast<std::size_t>(n)];
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const CellBlock& from = mesh.blocks[b];
    CellBlock& to = result.blocks[b];
    const auto n = static_cast<std::size_t>(node_count(from.type));
    std::vector<Index> cell_place(from.size());
    std::iota(cell_place.begin(), cell_place.end(), 0);
    std::shuffle(cell_place.begin(), cell_place.end(), random);
    for (std::size_t c = 0; c < from.size(); ++c) {
      const auto at = static_cast<std::size_t>(cell_place[c]);
      to.file_numbers[at] = from.file_numbers[c];
      for (std::size_t i = 0; i < n; ++i)
        to.connectivity[at * n + i] = place[static_cast<std::size_t>(from.connectivity[c * n + i])];
    }
    for (auto& [name, cells] : result.cell_groups)
      for (CellRef& ref : cells)
        if (static_cast<std::size_t>(ref.block) == b) ref.cell = cell_place[static_cast<std::size_t>(ref.cell)];
  }
  return result;
}

/// Mean over the HEXA8 of the largest minus the smallest node: what a cell spans in memory.
double mean_span(const Mesh& mesh) {
  const CellBlock& hexas = *mesh.block(CellType::hexa8);
  double sum = 0;
  for (std::size_t c = 0; c < hexas.size(); ++c) {
    const auto first = hexas.connectivity.begin() + static_cast<std::ptrdiff_t>(8 * c);
    const auto [low, high] = std::minmax_element(first, first + 8);
    sum += *high - *low;
  }
  return sum / static_cast<double>(hexas.size());
}

/// The most chunks (of `size` consecutive cells) that any chunk shares nodes with on one side.
Index reach_of_chunks(const Mesh& mesh, std::size_t size) {
  const CellBlock& hexas = *mesh.block(CellType::hexa8);
  std::vector<Index> first(mesh.node_count(), -1);
  Index reach = 0;
  for (std::size_t c = 0; c < hexas.size(); ++c)
    for (std::size_t i = 0; i < 8; ++i) {
      Index& seen = first[static_cast<std::size_t>(hexas.connectivity[8 * c + i])];
      const auto chunk = static_cast<Index>(c / size);
      if (seen < 0) seen = chunk;
      reach = std::max(reach, chunk - seen);
    }
  return reach;
}

Mesh block_mesh(std::array<int, 3> divisions, Vec3 size) {
  StructuredBlock block;
  block.size = size;
  block.divisions = divisions;
  return make_structured_blocks({block});
}

TEST(MeshRenumber, KeepsFileNumbersGroupsAndCells) {
  const Mesh mesh = test::sample_block();
  for (unsigned seed = 1; seed <= 5; ++seed)
    EXPECT_EQ(test::by_file_numbers(renumbered(shuffled(mesh, seed))), test::by_file_numbers(mesh)) << "seed " << seed;
}

TEST(MeshRenumber, LeavesANaturallyNumberedCubeAsItIs) {
  const Mesh mesh = block_mesh({6, 6, 6}, {1, 1, 1});
  for (std::size_t i = 0; i < mesh.node_count(); ++i) EXPECT_EQ(mesh.node_numbers[i], static_cast<std::int64_t>(i) + 1);
  for (std::size_t c = 0; c < 216; ++c) EXPECT_EQ(mesh.blocks[0].file_numbers[c], static_cast<std::int64_t>(c) + 1);
}

/// Cells that ranks compute, over those that there are: a rank owns the nodes from r n / R on and computes the cells
/// that they stand in.
double computed_by_ranks(const Mesh& mesh, std::size_t ranks) {
  const CellBlock& hexas = *mesh.block(CellType::hexa8);
  std::size_t computed = 0;
  for (std::size_t c = 0; c < hexas.size(); ++c) {
    std::set<std::size_t> owners;
    for (const Index n : hexas.nodes(static_cast<Index>(c)))
      owners.insert(static_cast<std::size_t>(n) * ranks / mesh.node_count());
    computed += owners.size();
  }
  return static_cast<double>(computed) / static_cast<double>(hexas.size());
}

/// Nodes of so many cells that follow each other, on average.
double nodes_of_run(const Mesh& mesh, std::size_t cells) {
  const CellBlock& hexas = *mesh.block(CellType::hexa8);
  std::size_t nodes = 0, runs = 0;
  for (std::size_t first = 0; first + cells <= hexas.size(); first += cells, ++runs) {
    std::set<Index> distinct;
    for (std::size_t c = first; c < first + cells; ++c)
      for (const Index n : hexas.nodes(static_cast<Index>(c))) distinct.insert(n);
    nodes += distinct.size();
  }
  return static_cast<double>(nodes) / static_cast<double>(runs);
}

TEST(MeshRenumber, AShuffledCubeOf64ComesOutInTheOrderOfANaturalOne) {
  const Mesh natural = block_mesh({64, 64, 64}, {1, 1, 1});
  const Mesh random = shuffled(natural, 7);
  EXPECT_GT(mean_span(random), 20 * mean_span(natural)) << "the shuffle must spoil the numbering to test anything";
  EXPECT_EQ(renumbered(random).blocks[0].connectivity, natural.blocks[0].connectivity);
}

TEST(MeshRenumber, ColumnsOfAGridHaveSmallFrontiers) {
  const Mesh cube = block_mesh({64, 64, 64}, {1, 1, 1});
  // Columns of 8 x 8 cells compute (8 + 1)^2 / 8^2 = 1.27 times the cells, a quarter more where parts and bins do not
  // end together; slabs of one layer compute all twice.
  EXPECT_LE(computed_by_ranks(cube, 64), 1.25 * 1.27);
  EXPECT_LE(computed_by_ranks(cube, 2), 1.0 + 1.5 / 64);
  // Rows stay whole: 64 cells in one row have 65 x 2 x 2 nodes.
  EXPECT_LE(nodes_of_run(cube, 64), 1.05 * 65 * 4);
}

TEST(MeshRenumber, LevelsRunAlongTheLongestSide) {
  const Mesh bar = renumbered(shuffled(block_mesh({80, 4, 4}, {20, 1, 1}), 3));
  EXPECT_LE(mean_span(bar), 5 * 5 + 5 + 1);
}

TEST(MeshRenumber, BinsOfALongBarFollowIt) {
  const Mesh bar = renumbered(shuffled(block_mesh({2000, 4, 4}, {500, 1, 1}), 3));
  EXPECT_LE(mean_span(bar), 5 * 5 + 5 + 1);
}

TEST(MeshRenumber, ChunksOfALayerShareNodesWithTheirNeighboursOnly) {
  const Mesh mesh = renumbered(shuffled(block_mesh({12, 12, 40}, {1, 1, 4}), 11));
  EXPECT_EQ(reach_of_chunks(mesh, 12 * 12), 1);
}

TEST(MeshRenumber, AnIrregularMeshMakesLumps) {
  Mesh mesh = block_mesh({32, 32, 32}, {1, 1, 1});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.2 / 32, 0.2 / 32);  // a fifth of a cell: no plane of nodes is left
  for (Vec3& x : mesh.coordinates)
    for (double& component : x) component += shift(random);
  const Mesh again = renumbered(shuffled(mesh, 13));
  // 64 cubes of 8^3 cells: (8 + 1)^3 / 8^3 = 1.42, and a quarter for frontiers that are not plane; slabs of half a
  // layer compute all three times.
  EXPECT_LE(computed_by_ranks(again, 64), 1.25 * 1.42);
  // 64 cells in a cube have 5^3 nodes, in a row 65 x 4, at random nearly 8 x 64.
  EXPECT_LE(nodes_of_run(again, 64), 1.5 * 125);
}

TEST(MeshRenumber, SeparateBodiesAndLooseNodesAreAllNumbered) {
  StructuredBlock a, b;
  a.size = b.size = {1, 1, 1};
  a.divisions = b.divisions = {3, 3, 3};
  b.origin = {5, 0, 0};
  Mesh mesh = make_structured_blocks({a, b});
  mesh.coordinates.push_back({9, 9, 9});
  mesh.node_numbers.push_back(1000);
  const Mesh again = renumbered(shuffled(mesh, 17));
  EXPECT_EQ(test::by_file_numbers(again), test::by_file_numbers(mesh));
  EXPECT_EQ(mean_span(again), 4 * 4 + 4 + 1);
}

TEST(MeshRenumber, PlaneStripsAndBarsBesideSolidsComeOutInTheirOwnOrder) {
  StructuredBlock box, strip, bar;
  box.size = {2, 2, 2};
  box.divisions = {2, 2, 2};
  strip.kind = StructuredBlock::Kind::quad;
  strip.origin = {10, 0, 0};
  strip.size = {1, 30, 0};
  strip.divisions = {3, 90, 1};
  bar.kind = StructuredBlock::Kind::bar;
  bar.origin = {20, 0, 0};
  bar.end = {20, 0, 5};
  bar.divisions = {50, 1, 1};
  const Mesh mesh = renumbered(shuffled(make_structured_blocks({box, strip, bar}), 11));
  const auto span = [&](const std::string& group) {
    Index most = 0;
    for (const CellRef& ref : mesh.cell_groups.at(group)) {
      const CellBlock& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
      const auto n = static_cast<std::ptrdiff_t>(node_count(block.type));
      if (block.type == CellType::hexa8) continue;
      const auto [low, high] = std::minmax_element(block.connectivity.begin() + n * ref.cell,
                                                   block.connectivity.begin() + n * (ref.cell + 1));
      most = std::max(most, *high - *low);
    }
    return most;
  };
  EXPECT_EQ(span("BLOCK"), 4 + 1) << "the widest cell of the strip: one row of 4 nodes, and one more";
}

}  // namespace
}  // namespace carom::mesh_renumber_test
