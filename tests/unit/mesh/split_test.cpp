// Meshes of halves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.hpp"
#include "cell_meshes.hpp"
#include "math/vec3.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh/split_cells.hpp"
#include "mesh/structured_block.hpp"

namespace carom::mesh_split_test {
namespace {

StructuredBlock block(int divisions) {
  StructuredBlock b;
  b.size = {1.0, 2.0, 3.0};
  b.divisions = {divisions, 2 * divisions, 3 * divisions};
  b.points = {{"CORNER", {1.0, 2.0, 3.0}, {}}};
  return b;
}

/// Coordinates in an order of their own.
std::vector<Vec3> sorted_places(const Mesh& mesh) {
  std::vector<Vec3> x = mesh.coordinates;
  std::sort(x.begin(), x.end());
  return x;
}

// Halves of a regular grid are the grid of twice the divisions, with its groups.
TEST(SplitCells, OfABlockAreTheFinerBlock) {
  const Mesh halves = split_cells(make_structured_blocks({block(2)})), finer = make_structured_blocks({block(4)});
  const std::vector<Vec3> a = sorted_places(halves), b = sorted_places(finer);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(norm(subtract(a[i], b[i])), 1e-14);
  for (const CellType type : {CellType::hexa8, CellType::quad4}) {
    ASSERT_NE(halves.block(type), nullptr);
    EXPECT_EQ(halves.block(type)->size(), finer.block(type)->size());
  }
  EXPECT_EQ(halves.group_names(), finer.group_names());
  for (const std::string& group : finer.group_names()) {
    EXPECT_EQ(halves.nodes_of(group).size(), finer.nodes_of(group).size()) << group;
    for (const Index n : halves.nodes_of(group))
      if (group == "ZMAX") {
        EXPECT_NEAR(halves.coordinates[static_cast<std::size_t>(n)][2], 3.0, 1e-14);
      }
  }
  EXPECT_EQ(halves.report.turned, 0U);  // no child was inside out
  EXPECT_NEAR(halves.report.worst_jacobian, 1.0, 1e-12);
}

TEST(SplitCells, KeepNumbersAndNumberOn) {
  const Mesh whole = make_structured_blocks({block(1)}), halves = split_cells(whole);
  std::vector<std::int64_t> numbers = halves.node_numbers;
  std::sort(numbers.begin(), numbers.end());
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], static_cast<std::int64_t>(i) + 1);
  for (std::size_t n = 0; n < halves.node_count(); ++n) {
    const auto old = std::find(whole.node_numbers.begin(), whole.node_numbers.end(), halves.node_numbers[n]);
    if (old == whole.node_numbers.end()) continue;
    EXPECT_EQ(halves.coordinates[n], whole.coordinates[static_cast<std::size_t>(old - whole.node_numbers.begin())]);
  }
}

constexpr const char* flat = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
8
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 0
6 1 0 0
7 1 1 0
8 0 1 0
$EndNodes
$Elements
1
7 5 2 1 1 1 2 3 4 5 6 7 8
$EndElements
)";

// Eight children of one size, right side out; the skin stays where it was.
TEST(SplitCells, OfTetrahedraAndPentahedraFillThem) {
  const auto volume = [](const Mesh& mesh, const CellBlock& cells, std::size_t k) {
    const auto n = static_cast<std::size_t>(node_count(cells.type));
    double sum = 0.0;
    const auto x = [&](LocalNode a) {
      return mesh.coordinates[static_cast<std::size_t>(cells.connectivity[n * k + a])];
    };
    for (const CellFace& face : cell_faces(cells.type))
      for (std::size_t i = 2; i < face.corners().size(); ++i)
        sum += dot(x(face.node[0]), cross(x(face.node[i - 1]), x(face.node[i]))) / 6.0;
    return sum;
  };
  for (const CellType type : {CellType::tetra4, CellType::penta6}) {
    const Mesh whole = test::with_cells(make_structured_blocks({block(2)}), type), halves = split_cells(whole);
    const CellBlock &coarse = *whole.block(type), &fine = *halves.block(type);
    ASSERT_EQ(fine.size(), 8 * coarse.size()) << name(type);
    EXPECT_EQ(halves.report.turned, 0U) << name(type);
    const double of_parent = volume(whole, coarse, 0);
    for (std::size_t k = 0; k < fine.size(); ++k) EXPECT_NEAR(volume(halves, fine, k), of_parent / 8.0, 1e-14);
    EXPECT_EQ(skin(halves).size(), 4 * skin(whole).size()) << name(type);
  }
}

// However often: three shapes at most (Bey, Computing 55, 1995, theorem 3.6), known by their edges, longest to
// shortest, over the longest; to round-off.
TEST(SplitCells, OfATetrahedronHaveThreeShapes) {
  Mesh mesh;
  mesh.coordinates = {{0.0, 0.0, 0.0}, {1.0, 0.1, 0.05}, {0.2, 0.9, -0.1}, {0.3, 0.25, 0.8}};
  mesh.node_numbers = {1, 2, 3, 4};
  mesh.blocks.push_back({.type = CellType::tetra4, .connectivity = {0, 1, 2, 3}, .file_numbers = {1}});
  for (int times = 1; times <= 4; ++times) {
    mesh = split_cells(mesh);
    const CellBlock& cells = *mesh.block(CellType::tetra4);
    std::vector<std::array<double, 6>> shapes;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      std::array<double, 6> edges{};
      std::size_t e = 0;
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b)
          edges[e++] = norm(subtract(mesh.coordinates[static_cast<std::size_t>(cells.connectivity[4 * k + a])],
                                     mesh.coordinates[static_cast<std::size_t>(cells.connectivity[4 * k + b])]));
      std::sort(edges.rbegin(), edges.rend());
      const auto is_same = [&](const std::array<double, 6>& shape) {
        for (std::size_t i = 0; i < 6; ++i)
          if (std::abs(shape[i] - edges[i] / edges[0]) > 1e-12) return false;
        return true;
      };
      if (std::none_of(shapes.begin(), shapes.end(), is_same)) {
        for (std::size_t i = 6; i-- > 0;) edges[i] /= edges[0];
        shapes.push_back(edges);
      }
    }
    EXPECT_LE(shapes.size(), 3U) << times;
  }
}

TEST(SplitCells, RefuseCellsWithoutThickness) {
  try {
    split_cells(read_mesh(std::string_view(flat), "flat.msh"));
    ADD_FAILURE() << "taken";
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("cell 7 of zero thickness"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace carom::mesh_split_test
