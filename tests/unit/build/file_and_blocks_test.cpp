// A mesh file and structured blocks in one case.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "build/build_mesh.hpp"
#include "cell_meshes.hpp"
#include "mesh/structured_block.hpp"
#include "mesh/write_gmsh.hpp"
#include "run_fixture.hpp"

namespace carom::run_file_and_blocks_test {
namespace {

using namespace test;

/// The block of the file, 1 above the plate.
const std::string block_text = R"([[mesh.block]]
origin = [0.5, 0.5, 1.1]
size = [1.0, 1.0, 2.0]
divisions = [2, 2, 4]
groups = { cells = "BLOCK", zmin = "FOOT", zmax = "TOP", xmin = "", xmax = "", ymin = "", ymax = "" }
)";

std::string file_text() {
  StructuredBlock block;
  block.origin = {0.5, 0.5, 1.1};
  block.size = {1.0, 1.0, 2.0};
  block.divisions = {2, 2, 4};
  block.cells_group = "BLOCK";
  block.face_groups = {"", "", "", "", "FOOT", "TOP"};
  const std::string path =
      testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + "_blocks.msh";
  std::ofstream(path) << gmsh_text(make_structured_blocks({block}));
  return fmt::format("[mesh]\nfile = \"{}\"\n", path);
}

const std::string plate = R"([[mesh.block]]
size = [2.0, 2.0, 1.0]
divisions = [3, 3, 2]
groups = { cells = "PLATE", zmin = "GROUND", zmax = "TABLE" }
)";

const std::string rest = R"([materials.m]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "plate"
cells = "PLATE"
material = "m"
[[part]]
name = "block"
cells = "BLOCK"
material = "m"
[[support]]
nodes = "GROUND"
blocked = ["x", "y", "z"]
[[initial]]
part = "block"
velocity = [0.0, 0.0, -0.2]
[[contact]]
name = "k"
kind = "pair"
group = "FOOT"
master = "TABLE"
[scheme]
kind = "central_differences"
[time]
end = 2.0
step = 0.02
[output]
fields = []
)";

Mesh mesh_of(const std::string& text) {
  return build_mesh(parse_case(text, "case.toml"));
}

// The block falls on the plate as it does where both are blocks, up to the order of sums.
TEST(FileAndBlocks, AreOneMesh) {
  const TemporaryCase both("units = \"SI\"\n" + file_text() + plate + rest);
  const TemporaryCase blocks("units = \"SI\"\n" + block_text + plate + rest);
  both.run();
  blocks.run();
  const auto force = column(both.result("contact.csv"), "k.impulse_z"),
             expected = column(blocks.result("contact.csv"), "k.impulse_z");
  ASSERT_EQ(force.size(), expected.size());
  EXPECT_GT(expected.back(), 0.1);
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_NEAR(force[i], expected[i], 1e-12) << i;
}

TEST(FileAndBlocks, NumbersOfBlocksCountOn) {
  const Mesh mesh = mesh_of(file_text() + plate + rest);
  EXPECT_EQ(mesh.node_count(), 45U + 48U);
  std::vector<std::int64_t> nodes = mesh.node_numbers, cells;
  for (const CellBlock& block : mesh.blocks)
    cells.insert(cells.end(), block.file_numbers.begin(), block.file_numbers.end());
  for (auto* numbers : {&nodes, &cells}) {
    std::sort(numbers->begin(), numbers->end());
    EXPECT_EQ(std::adjacent_find(numbers->begin(), numbers->end()), numbers->end());
  }
  EXPECT_EQ(nodes.back(), 93);
  EXPECT_EQ(mesh.block(CellType::hexa8)->size(), 16U + 18U);
  EXPECT_EQ(mesh.nodes_of("TABLE").size(), 16U);
  for (const Index n : mesh.nodes_of("TABLE")) EXPECT_EQ(mesh.coordinates[static_cast<std::size_t>(n)][2], 1.0);
  EXPECT_EQ(mesh.nodes_of("TOP").size(), 9U);
  const Mesh finer = mesh_of(file_text() + "refine = 1\n" + plate + rest);
  EXPECT_EQ(finer.block(CellType::hexa8)->size(), 8U * (16U + 18U));
}

TEST(FileAndBlocks, ANameThatBothHaveIsRefused) {
  const CaseError error = case_error(file_text() + replaced(plate, "TABLE", "TOP") + replaced(rest, "TABLE", "TOP"));
  EXPECT_EQ(error.key(), "mesh.block");
  EXPECT_NE(std::string(error.what()).find("found group \"TOP\", which \""), std::string::npos) << error.what();
  EXPECT_NE(std::string(error.what()).find("groups of other names than those of the file"), std::string::npos);
}

}  // namespace
}  // namespace carom::run_file_and_blocks_test
