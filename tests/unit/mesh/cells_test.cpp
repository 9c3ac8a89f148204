// Faces, edges and pieces of every type of cell, and skins of grids meshed with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>

#include "cell_meshes.hpp"
#include "mesh/face_twins.hpp"
#include "mesh/linear_cells.hpp"
#include "mesh/orientation.hpp"
#include "mesh/structured_block.hpp"

namespace carom::mesh_cells_test {
namespace {

using namespace test;

constexpr double round_off = 1e-13;  // some hundred operations on numbers of order 1

/// One cell of the type over the corners of the unit shape, with its other nodes where they belong.
Mesh reference_cell(CellType type) {
  static const std::map<CellType, std::vector<Vec3>> corners{
      {CellType::line2, {{0, 0, 0}, {1, 0, 0}}},
      {CellType::tria3, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
      {CellType::quad4, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
      {CellType::tetra4, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {CellType::pyra5, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}}},
      {CellType::penta6, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
      {CellType::hexa8, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}};
  CellFiller filler;
  filler.mesh.coordinates = corners.at(linear_of(type));
  std::vector<Index> nodes;
  for (std::size_t i = 0; i < filler.mesh.coordinates.size(); ++i) {
    nodes.push_back(static_cast<Index>(i));
    filler.mesh.node_numbers.push_back(static_cast<std::int64_t>(i) + 1);
  }
  filler.add_cell(type, nodes);
  return filler.mesh;
}

const Vec3& position(const Mesh& mesh, Index n) {
  return mesh.coordinates[static_cast<std::size_t>(n)];
}

/// Area of a facet times its normal, from its diagonals or edges: exact for flat ones.
Vec3 area_of(const Mesh& mesh, const Facet& f) {
  const auto x = [&](std::size_t a) { return position(mesh, f[a]); };
  if (f.size == 4) return scaled(cross(subtract(x(2), x(0)), subtract(x(3), x(1))), 0.5);
  if (f.size == 3) return scaled(cross(subtract(x(1), x(0)), subtract(x(2), x(0))), 0.5);
  return {x(1)[1] - x(0)[1], x(0)[0] - x(1)[0], 0.0};
}

/// One third of the flux of the position through flat facets: the volume that they enclose (half: the area).
double enclosed(const Mesh& mesh, const std::vector<Facet>& facets) {
  double sum = 0.0;
  for (const Facet& f : facets) sum += dot(position(mesh, f[0]), area_of(mesh, f)) / (f.size == 2 ? 2.0 : 3.0);
  return sum;
}

// Random faces over few nodes, so that many occur once, twice and more often.
TEST(FaceTwins, AreTheFacesThatOccurAgain) {
  std::minstd_rand random(5);
  std::vector<FaceKey> faces;
  for (int i = 0; i < 300; ++i) {
    std::set<Index> corners;
    const std::size_t size = 3 + random() % 2;
    while (corners.size() < size) corners.insert(static_cast<Index>(random() % 8));
    std::vector<Index> shuffled(corners.begin(), corners.end());
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    faces.push_back(face_key(shuffled));
    EXPECT_TRUE(std::is_sorted(faces.back().begin(), faces.back().end()));
  }
  for (const std::size_t per_cell : {1, 2, 6, 7}) {
    const std::vector<std::uint32_t> twin = face_twins(
        faces.size(), per_cell, [&](std::size_t i) { return faces[i]; }, 8);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const auto count = std::count(faces.begin(), faces.end(), faces[i]);
      ASSERT_EQ(twin[i] == no_twin, count == 1);
      if (count == 1) continue;
      EXPECT_NE(twin[i], i);
      EXPECT_EQ(faces[twin[i]], faces[i]);
      if (count == 2) {
        EXPECT_EQ(twin[twin[i]], i);
      }
    }
  }
}

// Cells in a row, each with its face at the front and at the back: a face is found by two keys, its own and that of the
// place to which the cell before leads, but at both ends of the row.
TEST(FaceTwins, AreFirstLookedForWhereTheCellBeforeLeads) {
  constexpr std::size_t cells = 1000;
  std::size_t keys = 0;
  const auto key_of = [&](std::size_t i) {
    ++keys;
    return face_key(std::vector<Index>{static_cast<Index>((i + 1) / 2)});
  };
  const std::vector<std::uint32_t> twin = face_twins(2 * cells, 2, key_of, cells + 1);
  EXPECT_EQ(twin.front(), no_twin);
  EXPECT_EQ(twin.back(), no_twin);
  for (std::size_t i = 1; i + 1 < twin.size(); ++i) EXPECT_EQ(twin[i], i % 2 == 1 ? i + 1 : i - 1);
  EXPECT_LE(keys, 2 * (cells - 1) + 10);
}

TEST(CellFaces, EncloseTheVolumeOfTheCell) {
  const std::map<CellType, double> volume{{CellType::tetra4, 1.0 / 6.0}, {CellType::pyra5, 1.0 / 3.0},
                                          {CellType::penta6, 0.5},       {CellType::hexa8, 1.0},
                                          {CellType::tria3, 0.5},        {CellType::quad4, 1.0}};
  for (const CellType type : solid_types) {
    const Mesh mesh = reference_cell(type);
    EXPECT_NEAR(enclosed(mesh, skin(mesh)), volume.at(linear_of(type)), round_off) << name(type);
  }
  for (const CellType type : plane_types) {
    const Mesh mesh = reference_cell(type);
    EXPECT_NEAR(enclosed(mesh, skin(mesh)), volume.at(linear_of(type)), round_off) << name(type);
  }
}

TEST(CellFaces, MeetAtEveryEdgeInOppositeSense) {
  for (const CellType type : solid_types) {
    std::multiset<std::pair<int, int>> directed;
    for (const CellFace& face : cell_faces(type))
      for (std::size_t i = 0; i < face.corners().size(); ++i)
        directed.insert({face.corners()[i], face.corners()[(i + 1) % face.corners().size()]});
    EXPECT_EQ(directed.size(), 2 * cell_edges(type).size()) << name(type);
    for (const auto& [a, b] : cell_edges(type)) {
      EXPECT_EQ(directed.count({a, b}), 1u) << name(type);
      EXPECT_EQ(directed.count({b, a}), 1u) << name(type);
    }
  }
}

// The nodes of a face beyond its corners stand in the middle of its edges, in their order, and at its centre.
TEST(CellFaces, HoldTheMiddlesOfTheirEdges) {
  std::vector<CellType> types(solid_types.begin(), solid_types.end());
  types.insert(types.end(), plane_types.begin(), plane_types.end());
  for (const CellType type : types) {
    const Mesh mesh = reference_cell(type);
    for (const CellFace& face : cell_faces(type)) {
      const std::span<const LocalNode> nodes = face.nodes();
      const std::size_t corners = face.corners().size(), edges = corners == 2 ? 1 : corners;
      Vec3 centre{};
      for (const LocalNode a : face.corners())
        centre =
            add(centre, scaled(position(mesh, mesh.blocks[0].connectivity[a]), 1.0 / static_cast<double>(corners)));
      const auto at = [&](std::size_t i) { return position(mesh, mesh.blocks[0].connectivity[nodes[i]]); };
      for (std::size_t i = corners; i < nodes.size(); ++i) {
        const std::size_t edge = i - corners;
        const Vec3 middle = edge < edges ? scaled(add(at(edge), at((edge + 1) % corners)), 0.5) : centre;
        EXPECT_LT(norm(subtract(at(i), middle)), round_off) << name(type);
      }
    }
  }
}

TEST(FacePieces, CoverTheFaceWithPositiveShares) {
  for (const CellType type : plane_types) {
    const Mesh mesh = reference_cell(type);
    const double area = corner_count(type) == 3 ? 0.5 : 1.0;
    std::vector<double> share(mesh.node_count(), 0.0);
    double sum = 0.0;
    for (const FacePiece& piece : face_pieces(type)) {
      Facet facet{{-1, -1, -1, -1}, piece.size};
      for (std::size_t a = 0; a < static_cast<std::size_t>(piece.size); ++a) facet.node[a] = piece.node[a];
      const Vec3 normal = area_of(mesh, facet);
      EXPECT_GT(normal[2], 0.0) << name(type);
      sum += normal[2];
      for (const Index n : facet) share[static_cast<std::size_t>(n)] += normal[2] / piece.size;
    }
    EXPECT_NEAR(sum, area, round_off) << name(type);
    for (std::size_t n = 0; n < share.size(); ++n) EXPECT_GT(share[n], 0.0) << name(type) << " node " << n;
    const bool is_middle_of_corners = type == CellType::tria6 || type == CellType::quad8;
    if (!is_middle_of_corners) continue;
    EXPECT_NEAR(share[0] / area, type == CellType::tria6 ? 1.0 / 12.0 : 1.0 / 24.0, round_off);
    EXPECT_NEAR(share.back() / area, type == CellType::tria6 ? 0.25 : 5.0 / 24.0, round_off);
  }
}

StructuredBlock box() {
  StructuredBlock block;
  block.origin = {-1, 2, 0.5};
  block.size = {1, 2, 3};
  block.divisions = {3, 2, 4};
  return block;
}

TEST(Skin, OfABoxIsItsSurfaceInEveryTypeOfCell) {
  for (const CellType type : solid_types) {
    const Mesh mesh = with_cells(make_structured_blocks({box()}), type);
    double area = 0.0;
    for (const Facet& facet : skin(mesh)) area += norm(area_of(mesh, facet));
    EXPECT_NEAR(area, 22.0, 22.0 * round_off) << name(type);
    EXPECT_NEAR(enclosed(mesh, skin(mesh)), 6.0, 22.0 * round_off) << name(type);
    EXPECT_EQ(mesh.report.turned, 0U) << name(type);
  }
}

TEST(Skin, OfMixedCellsHasNoFacesBetweenThem) {
  StructuredBlock block = box();
  block.divisions = {4, 3, 5};
  const Mesh mesh = with_mixed_cells(make_structured_blocks({block}));
  ASSERT_NE(mesh.block(CellType::hexa8), nullptr);
  ASSERT_NE(mesh.block(CellType::pyra5), nullptr);
  EXPECT_EQ(skin(mesh).size(), 2U * (12 + 15 + 20));
  EXPECT_NEAR(enclosed(mesh, skin(mesh)), 6.0, 22.0 * round_off);
}

TEST(Skin, OfAPlaneStripIsItsEdgeInEveryTypeOfCell) {
  StructuredBlock strip = box();
  strip.kind = StructuredBlock::Kind::quad;
  for (const CellType type : plane_types) {
    const Mesh mesh = with_cells(make_structured_blocks({strip}), type);
    double length = 0.0;
    for (const Facet& facet : skin(mesh)) length += norm(area_of(mesh, facet));
    EXPECT_NEAR(length, 6.0, 6.0 * round_off) << name(type);
    EXPECT_NEAR(enclosed(mesh, skin(mesh)), 2.0, 6.0 * round_off) << name(type);
  }
}

// Cells that a mesher wrote inside out are turned, whatever their type, and the skin is then that of the good mesh.
TEST(MeshOrientation, TurnsEveryTypeOfCell) {
  StructuredBlock strip = box();
  strip.kind = StructuredBlock::Kind::quad;
  const auto check = [](const Mesh& good, CellType type) {
    Mesh mesh = good;
    const auto n = static_cast<std::size_t>(node_count(type));
    std::size_t turned = 0;
    for (CellBlock& block : mesh.blocks)
      if (block.type == type)
        for (std::size_t k = 0; k < block.size(); k += 3, ++turned) {
          const std::vector<Index> old(&block.connectivity[n * k], &block.connectivity[n * k] + n);
          for (std::size_t a = 0; a < n; ++a) block.connectivity[n * k + a] = old[mirrored_order(type)[a]];
        }
    orient_cells(mesh);
    EXPECT_EQ(mesh.report.turned, turned) << name(type);
    EXPECT_EQ(mesh.block(type)->connectivity, good.block(type)->connectivity) << name(type);
    EXPECT_EQ(mesh.report.worst_jacobian, good.report.worst_jacobian) << name(type);
  };
  for (const CellType type : solid_types) check(with_cells(make_structured_blocks({box()}), type), type);
  for (const CellType type : plane_types) check(with_cells(make_structured_blocks({strip}), type), type);
}

// Groups of faces become cells of the type of the solids' faces, and name the same part of the skin.
TEST(Skin, GroupsOfSidesKeepTheirArea) {
  for (const CellType type : solid_types) {
    const Mesh mesh = with_cells(make_structured_blocks({box()}), type);
    for (const auto& [name, refs] : mesh.cell_groups) {
      if (name == "BLOCK") continue;
      double area = 0.0;
      for (const CellRef& ref : refs) {
        const CellBlock& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
        const auto first = static_cast<std::size_t>(node_count(block.type)) * static_cast<std::size_t>(ref.cell);
        for (const FacePiece& piece : face_pieces(block.type)) {
          Facet facet{{-1, -1, -1, -1}, piece.size};
          for (std::size_t a = 0; a < static_cast<std::size_t>(piece.size); ++a)
            facet.node[a] = block.connectivity[first + piece.node[a]];
          area += norm(area_of(mesh, facet));
        }
      }
      const double expected = name[0] == 'X' ? 6.0 : (name[0] == 'Y' ? 3.0 : 2.0);
      EXPECT_NEAR(area, expected, expected * round_off) << carom::name(type) << ' ' << name;
    }
  }
}

// A grid of second order taken by its corners is the grid of first order, with its groups.
TEST(LinearCells, OfQuadraticCellsAreThoseOfFirstOrder) {
  for (const CellType type : {CellType::tetra10, CellType::hexa20, CellType::hexa27, CellType::penta15}) {
    Mesh quadratic = with_cells(make_structured_blocks({box()}), type);
    quadratic.node_groups["TOP"] = quadratic.nodes_of("ZMAX");
    const Mesh linear = linear_cells(quadratic),
               direct = with_cells(make_structured_blocks({box()}), linear_type(type));
    EXPECT_EQ(linear.node_count(), direct.node_count()) << name(type);
    EXPECT_EQ(linear.block(type), nullptr);
    ASSERT_NE(linear.block(linear_type(type)), nullptr) << name(type);
    EXPECT_EQ(linear.block(linear_type(type))->size(), direct.block(linear_type(type))->size()) << name(type);
    EXPECT_EQ(linear.nodes_of("TOP").size(), direct.nodes_of("ZMAX").size()) << name(type);
    EXPECT_EQ(linear.nodes_of("XMIN").size(), direct.nodes_of("XMIN").size()) << name(type);
    EXPECT_NEAR(enclosed(linear, skin(linear)), 6.0, 22.0 * round_off) << name(type);
    EXPECT_EQ(linear.report.turned, 0U);
  }
}

}  // namespace
}  // namespace carom::mesh_cells_test
