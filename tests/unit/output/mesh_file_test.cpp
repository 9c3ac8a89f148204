#include "output/mesh_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/errors.hpp"
#include "cell_meshes.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh/structured_block.hpp"

namespace carom::output_mesh_file_test {
namespace {

namespace fs = std::filesystem;

/// A block of two parts with groups of cells, faces and nodes, some of them in several.
Mesh block_of(CellType type) {
  StructuredBlock low, high;
  low.size = high.size = {1.0, 2.0, 1.0};
  low.divisions = high.divisions = {2, 1, 2};
  high.origin = {0.0, 0.0, 1.5};
  low.cells_group = "LOW";
  high.cells_group = "HIGH";
  low.face_groups = {"", "SIDE", "", "", "FOOT", ""};
  high.face_groups = {"", "SIDE", "", "", "", "TOP"};
  Mesh mesh = test::with_cells(make_structured_blocks({low, high}), type);
  const std::vector<CellRef> all = mesh.cell_groups.at("LOW");  // with_cells knows one body only
  for (const char* name : {"LOW", "HIGH"}) mesh.cell_groups.at(name).clear();
  for (const CellRef& cell : all) {
    const Index first = mesh.blocks[static_cast<std::size_t>(cell.block)].nodes(cell.cell)[0];
    const bool is_high = mesh.coordinates[static_cast<std::size_t>(first)][2] > 1.25;
    mesh.cell_groups.at(is_high ? "HIGH" : "LOW").push_back(cell);
  }
  mesh.cell_groups["ALL OF IT"] = all;
  mesh.node_groups["CORNERS"] = {0, 1};
  mesh.node_groups["FIRST"] = {0};
  return mesh;
}

/// What does not depend on the order in which a reader numbers: by the file's number of each node its place, of each
/// cell type the cells as lists of places, and the groups as sets of those.
struct Content {
  explicit Content(const Mesh& mesh) {
    for (std::size_t n = 0; n < mesh.node_count(); ++n) nodes[mesh.node_numbers[n]] = mesh.coordinates[n];
    const auto cell = [&mesh](const CellRef& ref) {
      const CellBlock& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
      std::vector<Vec3> places;
      for (const Index n : block.nodes(ref.cell)) places.push_back(mesh.coordinates[static_cast<std::size_t>(n)]);
      return std::pair(block.type, places);
    };
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b)  // Gmsh has groups of nodes as cells of one point
      for (std::size_t c = 0; dimension(mesh.blocks[b].type) > 0 && c < mesh.blocks[b].size(); ++c)
        cells.insert(cell({static_cast<Index>(b), static_cast<Index>(c)}));
    for (const auto& [name, members] : mesh.cell_groups)
      for (const CellRef& member : members) cell_groups[name].insert(cell(member));
    for (const auto& [name, members] : mesh.node_groups)
      for (const Index n : members) node_groups[name].insert(mesh.node_numbers[static_cast<std::size_t>(n)]);
  }
  using Cells = std::multiset<std::pair<CellType, std::vector<Vec3>>>;
  std::map<std::int64_t, Vec3> nodes;
  Cells cells;
  std::map<std::string, Cells> cell_groups;
  std::map<std::string, std::set<std::int64_t>> node_groups;
};

class MeshFile : public testing::TestWithParam<std::tuple<std::string, CellType>> {
 protected:
  std::string path(const std::string& end) const {
    return (fs::temp_directory_path() / fmt::format("carom_mesh_{}{}", ::getpid(), end)).string();
  }
};

TEST_P(MeshFile, IsReadAsItWasWritten) {
  const auto& [end, type] = GetParam();
  const Mesh mesh = block_of(type);
  const std::string file = path(end);
  if (end == ".inp" && (type == CellType::pyra13 || type == CellType::hexa27 || type == CellType::penta15)) {
    try {
      write_mesh(file, mesh);
    } catch (const CaseError& error) {  // faces of nine nodes, quadratic pyramids
      EXPECT_NE(std::string(error.what()).find("decks of Abaqus"), std::string::npos);
      return;
    }
  }
  write_mesh(file, mesh);
  const Mesh read = read_mesh(file);
  fs::remove(file);
  EXPECT_EQ(read.report.turned, 0U);
  const Content given(mesh), found(read);
  EXPECT_EQ(found.nodes, given.nodes);
  EXPECT_EQ(found.cells.size(), given.cells.size());
  EXPECT_TRUE(found.cells == given.cells);
  EXPECT_EQ(found.node_groups, given.node_groups);
  for (const auto& [name, cells] : given.cell_groups) {
    ASSERT_EQ(found.cell_groups.count(name), 1U) << name;
    EXPECT_TRUE(found.cell_groups.at(name) == cells) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshFile,
                         testing::Combine(testing::Values(".msh", ".med", ".inp"),
                                          testing::ValuesIn(test::solid_types)),
                         [](const auto& each) {
                           return std::get<0>(each.param).substr(1) + "_" + std::string(name(std::get<1>(each.param)));
                         });

TEST(MeshFileName, OtherEndingsAreRefused) {
  for (const char* file : {"mesh.stl", "mesh"}) EXPECT_THROW(write_mesh(file, block_of(CellType::hexa8)), CaseError);
}

}  // namespace
}  // namespace carom::output_mesh_file_test
