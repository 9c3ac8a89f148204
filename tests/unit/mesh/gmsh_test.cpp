// Gmsh files: round trips through files written by the test, real files, node orders.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mesh/read_gmsh.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh_fixture.hpp"

namespace carom::mesh_gmsh_test {
namespace {

using test::GmshEncoding;
using test::GmshVersion;

class MeshGmshRoundTrip : public ::testing::TestWithParam<std::tuple<GmshVersion, GmshEncoding>> {};

TEST_P(MeshGmshRoundTrip, KeepsEverything) {
  const auto [version, encoding] = GetParam();
  const Mesh mesh = test::sample_block();
  const Mesh again = read_mesh(test::gmsh_file(mesh, version, encoding), "memory");
  EXPECT_EQ(test::by_file_numbers(again), test::by_file_numbers(mesh));
  EXPECT_EQ(again.report.turned, 0u);
  EXPECT_EQ(again.report.format, fmt::format("Gmsh {} {}", version == GmshVersion::v2_2 ? "2.2" : "4.1",
                                             encoding == GmshEncoding::text ? "text" : "binary"));
  EXPECT_TRUE(again.report.notes.empty()) << again.report.notes[0];
}

INSTANTIATE_TEST_SUITE_P(AllFlavours, MeshGmshRoundTrip,
                         ::testing::Combine(::testing::Values(GmshVersion::v2_2, GmshVersion::v4_1),
                                            ::testing::Values(GmshEncoding::text, GmshEncoding::little_endian,
                                                              GmshEncoding::big_endian)));

const std::string kTetra = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
0 5 "TIP+P"
3 2 "BODY"
$EndPhysicalNames
$Comments
anything $Nodes here
$EndComments
$Nodes
4
10 0 0 0
70 1 0 0
30 0 1e0 0
9000000000 0 0 +1
$EndNodes
$Elements
5
1 15 2 5 1 9000000000
2 4 2 2 1 10 70 30 9000000000
3 4 2 9 1 10 70 30 9000000000
4 2 3 -4 1 0 10 30 70
5 1 0 10 70
$EndElements
)";

TEST(MeshGmsh, SplitsNamesMergesRepeatedCellsAndNamesTagsByNumber) {
  const Mesh mesh = read_gmsh(kTetra, "tetra.msh");
  ASSERT_EQ(mesh.block(CellType::tetra4)->size(), 1u) << "cells 2 and 3 are one cell in two physical groups";
  EXPECT_EQ(mesh.cell_groups.at("BODY"), mesh.cell_groups.at("9"));
  EXPECT_EQ(mesh.cell_groups.at("4").size(), 1u) << "the sign of a tag is orientation only";
  ASSERT_EQ(mesh.node_groups.at("TIP").size(), 1u);
  EXPECT_EQ(mesh.node_groups.at("TIP"), mesh.node_groups.at("P"));
  EXPECT_EQ(mesh.node_numbers[static_cast<std::size_t>(mesh.node_groups.at("TIP")[0])], 9000000000);
  EXPECT_EQ(mesh.group_names(), (std::vector<std::string>{"4", "9", "BODY", "P", "TIP"}));
  ASSERT_EQ(mesh.report.notes.size(), 1u);
  EXPECT_EQ(mesh.report.notes[0], "1 repeated cells (one for each physical group of a cell) merged into one each");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// 2.1 is as 2.2, and 2.0 names physical tags without a dimension.
TEST(MeshGmsh, ReadsTheOlderVersionsOfFormat2) {
  const Mesh newest = read_gmsh(kTetra, "memory");
  const std::string middle = replaced(kTetra, "2.2 0 8", "2.1 0 8");
  const std::string oldest = replaced(replaced(replaced(kTetra, "2.2 0 8", "2 0 8"), "0 5 \"TIP+P\"", "5 \"TIP+P\""),
                                      "3 2 \"BODY\"", "2 \"BODY\"");
  for (const auto& [text, version] : {std::pair(middle, "2.1"), std::pair(oldest, "2.0")}) {
    const Mesh mesh = read_gmsh(text, "memory");
    EXPECT_EQ(test::by_file_numbers(mesh), test::by_file_numbers(newest)) << version;
    EXPECT_EQ(mesh.report.format, fmt::format("Gmsh {} text", version));
  }
}

TEST(MeshGmsh, NotesPhysicalNamesOfNothing) {
  std::string text = kTetra;
  text.replace(text.find("2\n0 5"), 1, "3");
  text.replace(text.find("3 2 \"BODY\""), 0, "2 8 \"LOST\"\n");
  const Mesh mesh = read_gmsh(text, "tetra.msh");
  EXPECT_FALSE(mesh.has_group("LOST"));
  EXPECT_EQ(mesh.report.notes.at(1), "physical name \"LOST\" of dimension 2 names nothing in this file");
}

TEST(MeshGmsh, LineEndsOfWindowsAreRead) {
  std::string text;
  for (const char c : kTetra) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(test::by_file_numbers(read_gmsh(text, "tetra.msh")), test::by_file_numbers(read_gmsh(kTetra, "tetra.msh")));
}

/// Edges in the order in which Gmsh numbers mid-side nodes (Gmsh reference manual, "Node ordering", figures of
/// Tetrahedron10, Hexahedron20, Prism15 and Pyramid13), and in ours, which is VTK's.
struct Quadratic {
  int gmsh_number;
  std::vector<Vec3> corners;
  std::vector<std::array<std::size_t, 2>> gmsh_edges, our_edges;
};

const std::vector<Quadratic> kQuadratic{
    {11,
     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
     {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}},
     {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}},
    {17,
     {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
     {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}},
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}},
    {18,
     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
     {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}},
     {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}},
    {19,
     {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}},
     {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}},
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}}};

Vec3 middle(const Vec3& a, const Vec3& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

TEST(MeshGmsh, QuadraticCellsComeInTheOrderOfVtk) {
  for (const Quadratic& cell : kQuadratic) {
    std::vector<Vec3> x = cell.corners;
    for (const auto& edge : cell.gmsh_edges) x.push_back(middle(x[edge[0]], x[edge[1]]));
    std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", x.size());
    std::string nodes;
    for (std::size_t i = 0; i < x.size(); ++i) {
      text += fmt::format("{} {} {} {}\n", i + 1, x[i][0], x[i][1], x[i][2]);
      nodes += fmt::format(" {}", i + 1);
    }
    text += fmt::format("$EndNodes\n$Elements\n1\n1 {} 0{}\n$EndElements\n", cell.gmsh_number, nodes);
    const Mesh mesh = read_gmsh(text, "quadratic.msh");
    const auto at = [&](std::size_t i) {
      return mesh.coordinates[static_cast<std::size_t>(mesh.blocks[0].connectivity[i])];
    };
    for (std::size_t e = 0; e < cell.our_edges.size(); ++e)
      EXPECT_EQ(at(cell.corners.size() + e), middle(at(cell.our_edges[e][0]), at(cell.our_edges[e][1])))
          << name(mesh.blocks[0].type) << " edge " << e;
  }
}

TEST(MeshGmsh, ReadsTheMeshOfSdnv100) {
  const Mesh mesh = read_mesh(std::string(CAROM_SOURCE_DIR "/cases/sdnv100/meshes/sdnv100a.msh"));
  EXPECT_EQ(mesh.node_count(), 102u);  // the counts stand in the file
  EXPECT_EQ(mesh.block(CellType::hexa8)->size(), 24u);
  EXPECT_EQ(mesh.cell_groups.at("POUTRE").size(), 20u);
  EXPECT_EQ(mesh.cell_groups.at("VSOL").size(), 4u);
  EXPECT_EQ(mesh.node_groups.at("N5"), mesh.node_groups.at("P21"));
  EXPECT_EQ(mesh.node_numbers[static_cast<std::size_t>(mesh.node_groups.at("N5").at(0))], 5);
  EXPECT_EQ(mesh.report.turned, 0u);
}

}  // namespace
}  // namespace carom::mesh_gmsh_test
