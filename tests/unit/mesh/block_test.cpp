// Structured blocks, groups, the skin and the summary.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "base/errors.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/mesh_summary.hpp"
#include "mesh/skin.hpp"
#include "mesh/structured_block.hpp"
#include "mesh_fixture.hpp"

namespace carom::mesh_block_test {
namespace {

const Vec3& node(const Mesh& mesh, Index i) {
  return mesh.coordinates[static_cast<std::size_t>(i)];
}

std::string message_of(const StructuredBlock& block) {
  try {
    make_structured_blocks({block});
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MeshBlock, HasTheNodesCellsAndGroupsThatCountingGives) {
  const Mesh mesh = test::sample_block();
  EXPECT_EQ(mesh.node_count(), 4u * 3u * 5u);
  ASSERT_NE(mesh.block(CellType::hexa8), nullptr);
  EXPECT_EQ(mesh.block(CellType::hexa8)->size(), 3u * 2u * 4u);
  EXPECT_EQ(mesh.block(CellType::quad4)->size(), 2u * (2 * 4 + 3 * 4 + 3 * 2));
  EXPECT_EQ(mesh.cell_groups.at("BLOCK").size(), 24u);
  EXPECT_EQ(mesh.cell_groups.at("XMIN").size(), 8u);
  EXPECT_EQ(mesh.cell_groups.at("YMAX").size(), 12u);
  EXPECT_EQ(mesh.cell_groups.at("ZMIN").size(), 6u);
  EXPECT_EQ(mesh.nodes_of("XMAX").size(), 15u);
  EXPECT_EQ(mesh.nodes_of("ZMAX").size(), 12u);
  EXPECT_EQ(mesh.nodes_of("A"), mesh.nodes_of("ORIGIN"));
  EXPECT_TRUE(mesh.nodes_of("NONE").empty());
  EXPECT_FALSE(mesh.has_group("NONE"));
  EXPECT_EQ(mesh.block(CellType::tetra4), nullptr);
}

TEST(MeshBlock, FacesLieOnTheirSideWithOutwardNormals) {
  const Mesh mesh = test::sample_block();
  const Vec3 low{0.1, -0.2, 0.3}, high{0.4, 0.0, 1.1};
  const std::array<std::string, 6> names{"XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX"};
  const CellBlock& quads = *mesh.block(CellType::quad4);
  for (std::size_t s = 0; s < 6; ++s)
    for (const CellRef& ref : mesh.cell_groups.at(names[s])) {
      ASSERT_EQ(mesh.blocks[static_cast<std::size_t>(ref.block)].type, CellType::quad4);
      const Index* n = &quads.connectivity[4 * static_cast<std::size_t>(ref.cell)];
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(node(mesh, n[i])[s / 2], s % 2 == 0 ? low[s / 2] : high[s / 2], 1e-15);
      const Vec3 normal =
          cross(subtract(node(mesh, n[1]), node(mesh, n[0])), subtract(node(mesh, n[2]), node(mesh, n[0])));
      EXPECT_GT(s % 2 == 0 ? -normal[s / 2] : normal[s / 2], 0.0) << names[s];
    }
}

TEST(MeshBlock, VolumesSumToTheBlock) {
  const Mesh mesh = test::sample_block();
  double volume = 0;
  for (std::size_t c = 0; c < 24; ++c) volume += test::hexa_volume(mesh, mesh.blocks[0], c);
  EXPECT_NEAR(volume, 0.3 * 0.2 * 0.8, 1e-15);  // 24 round-offs of numbers of size 2e-3
  EXPECT_EQ(mesh.report.turned, 0u);
  EXPECT_NEAR(mesh.report.worst_jacobian, 1.0, 1e-12);
}

TEST(MeshBlock, SeveralBlocksKeepTheirNodesAndUniteGroups) {
  StructuredBlock lower, upper;
  lower.size = upper.size = {1, 1, 1};
  lower.divisions = upper.divisions = {2, 2, 2};
  upper.origin = {0, 0, 1};
  upper.cells_group = "UPPER";
  const Mesh mesh = make_structured_blocks({lower, upper});
  EXPECT_EQ(mesh.node_count(), 2u * 27u);
  EXPECT_EQ(mesh.cell_groups.at("BLOCK").size(), 8u);
  EXPECT_EQ(mesh.cell_groups.at("UPPER").size(), 8u);
  EXPECT_EQ(mesh.cell_groups.at("ZMIN").size(), 8u);
  EXPECT_EQ(mesh.nodes_of("ZMIN").size(), 18u);
}

TEST(MeshBlock, WithoutFaceGroupsThereAreNoFaces) {
  StructuredBlock block;
  block.size = {1, 1, 1};
  block.face_groups = {};
  const Mesh mesh = make_structured_blocks({block});
  EXPECT_EQ(mesh.blocks.size(), 1u);
  EXPECT_EQ(mesh.group_names(), std::vector<std::string>{"BLOCK"});
}

TEST(MeshBlock, MessagesSayWhatIsWrong) {
  StructuredBlock block;
  block.where = {"case.toml", 7, 1};
  block.size = {1, 1, 0};
  EXPECT_NE(message_of(block).find("case.toml:7:1: block: found origin 0 and size 0 along z"), std::string::npos);
  block.size = {1, 1, 1};
  block.divisions = {1, 0, 1};
  EXPECT_NE(message_of(block).find("found 0 divisions along y; expected 1 to 1000000"), std::string::npos);
  block.divisions = {100000, 100000, 100000};
  EXPECT_NE(message_of(block).find("expected at most 2147483647"), std::string::npos);
  block.divisions = {1, 1, 1};
  block.points = {{"P", {0.5, 0, 0}, {"case.toml", 9, 2}}};
  EXPECT_NE(message_of(block).find("case.toml:9:2: point P: found (0.5, 0, 0), 0.5 away from the nearest node"),
            std::string::npos);
  block.points[0].position[0] = std::nan("");
  EXPECT_NE(message_of(block).find("point P: found (nan, 0, 0)"), std::string::npos);
}

/// Faces with an odd number of owners by comparing every pair of faces of all cells.
std::vector<Facet> skin_by_brute_force(const Mesh& mesh) {
  const CellBlock& hexas = *mesh.block(CellType::hexa8);
  std::vector<std::array<Index, 4>> faces, sorted;
  std::vector<Facet> outer;
  for (std::size_t c = 0; c < hexas.size(); ++c)
    for (const CellFace& local : cell_faces(CellType::hexa8)) {
      std::array<Index, 4> face{};
      for (std::size_t i = 0; i < 4; ++i) face[i] = hexas.connectivity[8 * c + local.node[i]];
      faces.push_back(face);
      std::sort(face.begin(), face.end());
      sorted.push_back(face);
    }
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (std::count(sorted.begin(), sorted.end(), sorted[i]) == 1) outer.push_back({faces[i], 4});
  return outer;
}

TEST(MeshSkin, AgreesWithBruteForceOnBlocksWithHoles) {
  std::mt19937 random(20261121);
  for (int round = 0; round < 5; ++round) {
    StructuredBlock block;
    block.size = {1, 2, 3};
    block.divisions = {4, 5, 6};
    block.face_groups = {};  // faces without their solids would be plane cells
    Mesh mesh = make_structured_blocks({block});
    CellBlock& hexas = mesh.blocks[0];  // a mesh of our own from here on: every third cell taken out at random
    for (std::size_t c = hexas.size(); c-- > 0;)
      if (random() % 3 == 0) {
        const auto first = hexas.connectivity.begin() + static_cast<std::ptrdiff_t>(8 * c);
        hexas.connectivity.erase(first, first + 8);
        hexas.file_numbers.erase(hexas.file_numbers.begin() + static_cast<std::ptrdiff_t>(c));
      }
    const auto faces = skin(mesh);
    EXPECT_EQ(faces, skin_by_brute_force(mesh));
    Vec3 area{};
    double volume = 0, expected_volume = 0;
    for (const auto& f : faces) {  // divergence theorem: sum of area vectors is 0, sum of x . n dA / 3 is the volume
      const Vec3 a = scaled(
          cross(subtract(node(mesh, f[2]), node(mesh, f[0])), subtract(node(mesh, f[3]), node(mesh, f[1]))), 0.5);
      area = add(area, a);
      volume += dot(a, add(add(node(mesh, f[0]), node(mesh, f[1])), add(node(mesh, f[2]), node(mesh, f[3])))) / 12;
    }
    for (std::size_t c = 0; c < hexas.size(); ++c) expected_volume += test::hexa_volume(mesh, hexas, c);
    EXPECT_NEAR(norm(area), 0.0, 1e-12);  // some hundred round-offs of areas below 1
    EXPECT_NEAR(volume, expected_volume, 1e-12);
  }
}

StructuredBlock strip() {
  StructuredBlock block;
  block.kind = StructuredBlock::Kind::quad;
  block.origin = {1, 2, 0.5};
  block.size = {3, 2, 0};
  block.divisions = {6, 2, 1};
  return block;
}

StructuredBlock bar() {
  StructuredBlock block;
  block.kind = StructuredBlock::Kind::bar;
  block.origin = {1, 1, 1};
  block.end = {-2, 5, 13};  // at the distance 13
  block.divisions = {10, 1, 1};
  return block;
}

TEST(MeshStrip, HasTheNodesCellsAndGroupsThatCountingGives) {
  StructuredBlock block = strip();
  block.points = {{"CORNER", {4, 4, 0.5}, {}}};
  const Mesh mesh = make_structured_blocks({block});
  EXPECT_EQ(mesh.node_count(), 7u * 3u);
  ASSERT_EQ(mesh.blocks.size(), 2u);
  EXPECT_EQ(mesh.block(CellType::quad4)->size(), 12u);
  EXPECT_EQ(mesh.block(CellType::line2)->size(), 2u * (6 + 2));
  EXPECT_EQ(mesh.cell_groups.at("BLOCK").size(), 12u);
  EXPECT_EQ(mesh.nodes_of("YMIN").size(), 7u);
  EXPECT_EQ(mesh.nodes_of("XMAX").size(), 3u);
  EXPECT_FALSE(mesh.has_group("ZMIN"));
  ASSERT_EQ(mesh.nodes_of("CORNER").size(), 1u);
  EXPECT_EQ(node(mesh, mesh.nodes_of("CORNER")[0]), (Vec3{4, 4, 0.5}));
  EXPECT_EQ(mesh.report.turned, 0u);
  EXPECT_NEAR(mesh.report.worst_jacobian, 1.0, 1e-12);  // squares of 0.5 and 1 up to round-off
  EXPECT_NE(mesh.report.worst_cell, 0);
}

TEST(MeshStrip, EdgesLieOnTheirSideWithTheBodyOnTheirLeft) {
  const Mesh mesh = make_structured_blocks({strip()});
  const std::array<std::string, 4> names{"XMIN", "XMAX", "YMIN", "YMAX"};
  const std::array<double, 4> place{1, 4, 2, 4};
  const CellBlock& lines = *mesh.block(CellType::line2);
  for (std::size_t s = 0; s < 4; ++s)
    for (const CellRef& ref : mesh.cell_groups.at(names[s])) {
      ASSERT_EQ(mesh.blocks[static_cast<std::size_t>(ref.block)].type, CellType::line2);
      const Index* n = &lines.connectivity[2 * static_cast<std::size_t>(ref.cell)];
      for (int i = 0; i < 2; ++i) EXPECT_EQ(node(mesh, n[i])[s / 2], place[s]);
      const Vec3 d = subtract(node(mesh, n[1]), node(mesh, n[0]));
      const Vec3 outward{d[1], -d[0], 0};
      EXPECT_GT(s % 2 == 0 ? -outward[s / 2] : outward[s / 2], 0.0) << names[s];
    }
}

TEST(MeshStrip, SkinIsTheFourSides) {
  const Mesh mesh = make_structured_blocks({strip()});
  double area = 0, length = 0;  // Green: the area is half the integral of x dy - y dx around the body
  const auto facets = outer_facets(mesh);
  ASSERT_EQ(facets.size(), 16u);
  for (const OuterFacet& outer : facets) {
    const Facet& f = outer.facet;
    ASSERT_EQ(f.size, 2);
    const Vec3 &a = node(mesh, f[0]), &b = node(mesh, f[1]);
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    length += norm(subtract(b, a));
    const CellBlock& owner = mesh.blocks[static_cast<std::size_t>(outer.cell.block)];
    ASSERT_EQ(owner.type, CellType::quad4);
    const auto first = owner.connectivity.begin() + 4 * outer.cell.cell;
    EXPECT_EQ(std::count(first, first + 4, f[0]) + std::count(first, first + 4, f[1]), 2);
  }
  EXPECT_NEAR(area, 6.0, 1e-14);  // 3 x 2; 16 round-offs
  EXPECT_NEAR(length, 10.0, 1e-14);
}

TEST(MeshBar, RunsFromEndToEndInSpace) {
  StructuredBlock block = bar();
  block.points = {{"MIDDLE", {-0.5, 3, 7}, {}}};
  const Mesh mesh = make_structured_blocks({block});
  EXPECT_EQ(mesh.node_count(), 11u);
  ASSERT_EQ(mesh.blocks.size(), 1u);
  const CellBlock& lines = mesh.blocks[0];
  ASSERT_EQ(lines.size(), 10u);
  for (std::size_t c = 0; c < 10; ++c) {
    const Vec3 d = subtract(node(mesh, lines.connectivity[2 * c + 1]), node(mesh, lines.connectivity[2 * c]));
    EXPECT_NEAR(norm(d), 1.3, 1e-14);
  }
  EXPECT_EQ(node(mesh, mesh.nodes_of("START").at(0)), (Vec3{1, 1, 1}));
  EXPECT_EQ(node(mesh, mesh.nodes_of("END").at(0)), (Vec3{-2, 5, 13}));
  EXPECT_EQ(node(mesh, mesh.nodes_of("MIDDLE").at(0)), (Vec3{-0.5, 3, 7}));
  const auto facets = skin(mesh);
  ASSERT_EQ(facets.size(), 2u);
  for (const Facet& f : facets) {
    EXPECT_EQ(f.size, 1);
    EXPECT_TRUE(f[0] == mesh.nodes_of("START")[0] || f[0] == mesh.nodes_of("END")[0]);
  }
}

TEST(MeshBar, MessagesSayWhatIsWrong) {
  StructuredBlock block = bar();
  block.end = block.origin;
  EXPECT_NE(message_of(block).find("found a bar whose ends coincide"), std::string::npos) << message_of(block);
  block = bar();
  block.points = {{"P", {0, 0, 0}, {}}};  // nearest to the origin, at the distance sqrt(3) of the first node
  EXPECT_NE(message_of(block).find("point P: found (0, 0, 0), 1.73205 away"), std::string::npos) << message_of(block);
  block = strip();
  block.points = {{"P", {1, 2, 0}, {}}};
  EXPECT_NE(message_of(block).find("point P: found (1, 2, 0), 0.5 away"), std::string::npos) << message_of(block);
}

TEST(MeshBlock, KindsMix) {
  StructuredBlock box;
  box.origin = {10, 0, 0};
  box.size = {1, 1, 1};
  box.cells_group = "BOX";
  const Mesh mesh = make_structured_blocks({bar(), strip(), box});
  EXPECT_EQ(mesh.node_count(), 11u + 21u + 8u);
  EXPECT_EQ(mesh.block(CellType::quad4)->size(), 12u + 6u);
  EXPECT_EQ(mesh.block(CellType::line2)->size(), 10u + 16u);
  const auto count_of = [&](const std::vector<Facet>& facets, int size) {
    return std::count_if(facets.begin(), facets.end(), [&](const Facet& f) { return f.size == size; });
  };
  const auto facets = skin(mesh);
  EXPECT_EQ(count_of(facets, 4), 6);
  EXPECT_EQ(count_of(facets, 2), 16);
  EXPECT_EQ(count_of(facets, 1), 2);
  EXPECT_EQ(mesh.cell_groups.at("XMIN").size(), 2u + 1u);  // edges of the strip, a face of the box
}

TEST(MeshSummary, NamesWhatTheMeshHolds) {
  const std::string text = mesh_summary(test::sample_block());
  for (const char* part :
       {"nodes     60, numbered 1 to 60", "HEXA8            24", "QUAD4            52",
        "z from          0.3 to          1.1, length 0.8", "worst Jacobian ratio 1 in cell", "0 cells turned",
        "BLOCK          60  HEXA8 24", "ZMAX           12  QUAD4 6", "ORIGIN          1  (node group)"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

// A cube and a cell of no height on it, whose upper nodes stand where the lower ones do.
TEST(MeshSummary, CountsTheCellsOfZeroThicknessAlone) {
  Mesh mesh;
  for (const double z : {0.0, 1.0, 1.0})
    for (const Vec3& x : {Vec3{0, 0, z}, Vec3{1, 0, z}, Vec3{1, 1, z}, Vec3{0, 1, z}}) mesh.coordinates.push_back(x);
  CellBlock cells{CellType::hexa8, {}, {1, 2}};
  for (const Index first : {0, 4})
    for (Index n = 0; n < 8; ++n) cells.connectivity.push_back(first + n);
  mesh.blocks.push_back(cells);
  for (std::int64_t n = 1; n <= 12; ++n) mesh.node_numbers.push_back(n);
  EXPECT_NE(mesh_summary(mesh).find(" 1 of zero thickness\n"), std::string::npos) << mesh_summary(mesh);
  EXPECT_EQ(mesh_summary(test::sample_block()).find("zero thickness"), std::string::npos);
}

}  // namespace
}  // namespace carom::mesh_block_test
