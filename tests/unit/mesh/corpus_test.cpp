// Every seed of the fuzz targets and some thousand damaged copies through the readers: a consistent mesh comes out, or
// an error that says what was found and what was expected.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "mesh/deck_mesh.hpp"
#include "mesh/finish_mesh.hpp"
#include "mesh/hdf5_tree.hpp"
#include "mesh/med_mesh.hpp"
#include "mesh/read_gmsh.hpp"
#include "mesh/read_med.hpp"
#include "mesh_fixture.hpp"

namespace carom::mesh_corpus_test {
namespace {

const std::filesystem::path kCorpus = CAROM_SOURCE_DIR "/tests/fuzz/corpus";

Mesh read_stream(std::string_view bytes, const std::string& source) {
  return finished(med_mesh(decode_hdf5_tree(bytes, source), source));
}

/// One to four small accidents: bytes changed, pieces lost, doubled or moved, the end cut off.
std::string damaged(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t turns = 1 + below(4); turns > 0; --turns) {
    const std::size_t at = below(bytes.size()), length = std::min(1 + below(16), bytes.size() - at);
    switch (random() % 6) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<char>(random());
        break;
      case 1:
        if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(below(bytes.size()), length));
        break;
      case 4:
        bytes.replace(at, length, std::string(length, random() % 2 == 0 ? '\xff' : '9'));
        break;
      default:
        if (random() % 8 == 0) bytes.resize(at);
        break;
    }
  }
  return bytes;
}

void expect_consistent(const Mesh& mesh) {
  const auto nodes = static_cast<Index>(mesh.node_count());
  ASSERT_EQ(mesh.node_numbers.size(), mesh.node_count());
  for (const Vec3& x : mesh.coordinates) ASSERT_TRUE(std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]));
  for (const CellBlock& block : mesh.blocks) {
    ASSERT_EQ(block.connectivity.size(), block.size() * static_cast<std::size_t>(node_count(block.type)));
    for (const Index n : block.connectivity) ASSERT_TRUE(n >= 0 && n < nodes);
  }
  for (const auto& [name, group] : mesh.node_groups)
    for (const Index n : group) ASSERT_TRUE(n >= 0 && n < nodes) << name;
  for (const auto& [name, group] : mesh.cell_groups)
    for (const CellRef& ref : group) {
      ASSERT_TRUE(ref.block >= 0 && static_cast<std::size_t>(ref.block) < mesh.blocks.size()) << name;
      ASSERT_LT(static_cast<std::size_t>(ref.cell), mesh.blocks[static_cast<std::size_t>(ref.block)].size()) << name;
    }
}

struct Outcome {
  int accepted = 0, refused = 0;
};

template <class Read>
void try_bytes(const std::string& bytes, const Read& read, Outcome& outcome) {
  try {
    expect_consistent(read(bytes, "corpus"));
    ++outcome.accepted;
  } catch (const CaseError& error) {
    EXPECT_FALSE(error.found().empty());
    EXPECT_FALSE(error.expected().empty()) << error.what();
    ++outcome.refused;
  }
}

/// The seeds as they are must be accepted; of the damaged copies some are, most are not.
template <class Read>
void run(const std::vector<std::filesystem::path>& seeds, int copies, const Read& read) {
  ASSERT_FALSE(seeds.empty());
  for (const std::filesystem::path& seed : seeds) {
    SCOPED_TRACE(seed.string());
    const std::string bytes = test::bytes_of(seed);
    Outcome whole, outcome;
    try_bytes(bytes, read, whole);
    EXPECT_EQ(whole.accepted, 1);
    std::mt19937 random(20261121);
    for (int i = 0; i < copies && !::testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE("copy " + std::to_string(i));
      try_bytes(damaged(bytes, random), read, outcome);
    }
    EXPECT_GT(outcome.accepted, 0);
    EXPECT_GT(outcome.refused, copies / 4);
  }
}

std::vector<std::filesystem::path> seeds_in(const std::string& folder, const std::string& extension) {
  std::vector<std::filesystem::path> seeds;
  for (const auto& entry : std::filesystem::directory_iterator(kCorpus / folder))
    if (entry.path().extension() == extension) seeds.push_back(entry.path());
  std::sort(seeds.begin(), seeds.end());
  return seeds;
}

TEST(MeshCorpus, Gmsh) {
  run(seeds_in("gmsh", ".msh"), 600, read_gmsh);
}

TEST(MeshCorpus, Deck) {
  const auto no_file = [](const std::string&, const Location& where) -> std::string {
    throw CaseError(where, "*INCLUDE", "a file", "none here");
  };
  run(seeds_in("deck", ".inp"), 600,
      [&](const std::string& bytes, const std::string& source) { return read_deck_mesh(bytes, source, no_file); });
}

TEST(MeshCorpus, StreamOfTheMedProcess) {
  run(seeds_in("med", ".stream"), 2000, read_stream);
}

TEST(MeshCorpus, Med) {
  run(seeds_in("med", ".med"), 400, read_med);
}

}  // namespace
}  // namespace carom::mesh_corpus_test
