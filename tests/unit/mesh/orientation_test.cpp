// Turning of solid cells, interfaces of zero thickness, cells that cannot be mended.
#include "mesh/orientation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/errors.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/skin.hpp"
#include "mesh_fixture.hpp"

namespace carom::mesh_orientation_test {
namespace {

/// Reference cells: corners of the unit shapes in our node order.
const std::map<CellType, std::vector<Vec3>> kCorners{
    {CellType::tetra4, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    {CellType::pyra5, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}}},
    {CellType::penta6, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
    {CellType::hexa8, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}};

/// Edges of the quadratic cells in VTK's order of mid-side nodes (VTK file formats, "Quadratic cells").
const std::map<CellType, std::pair<CellType, std::vector<std::array<std::size_t, 2>>>> kEdges{
    {CellType::tetra10, {CellType::tetra4, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}}},
    {CellType::pyra13, {CellType::pyra5, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}}},
    {CellType::penta15, {CellType::penta6, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}}},
    {CellType::hexa20,
     {CellType::hexa8,
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}}}};

Mesh one_cell(CellType type, const std::vector<Vec3>& x) {
  Mesh mesh;
  mesh.report.source = "test.msh";
  mesh.coordinates = x;
  CellBlock block{type, {}, {17}};
  for (std::size_t i = 0; i < x.size(); ++i) {
    mesh.node_numbers.push_back(static_cast<std::int64_t>(i) + 1);
    block.connectivity.push_back(static_cast<Index>(i));
  }
  mesh.blocks.push_back(block);
  return mesh;
}

std::string message_of(Mesh mesh) {
  try {
    orient_cells(mesh);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MeshOrientation, LeavesReferenceCellsAndTurnsTheirMirrorImages) {
  for (const auto& [type, x] : kCorners) {
    Mesh mesh = one_cell(type, x);
    const CellBlock good = mesh.blocks[0];
    orient_cells(mesh);
    EXPECT_EQ(mesh.report.turned, 0u) << name(type);
    EXPECT_EQ(mesh.blocks[0].connectivity, good.connectivity);
    EXPECT_NEAR(mesh.report.worst_jacobian, 1.0, 1e-15) << name(type);
    for (std::size_t i = 0; i < x.size(); ++i)
      mesh.blocks[0].connectivity[i] = good.connectivity[mirrored_order(type)[i]];
    orient_cells(mesh);
    EXPECT_EQ(mesh.report.turned, 1u) << name(type);
    EXPECT_EQ(mesh.blocks[0].connectivity, good.connectivity) << "the mirrored order is its own inverse";
  }
}

TEST(MeshOrientation, TurningKeepsMidSideNodesOnTheirEdges) {
  for (const auto& [type, linear] : kEdges) {
    std::vector<Vec3> x = kCorners.at(linear.first);
    const std::size_t corners = x.size();
    for (const auto& edge : linear.second)
      x.push_back({(x[edge[0]][0] + x[edge[1]][0]) / 2, (x[edge[0]][1] + x[edge[1]][1]) / 2,
                   (x[edge[0]][2] + x[edge[1]][2]) / 2});
    const auto order = mirrored_order(type);
    ASSERT_EQ(order.size(), x.size()) << name(type);
    for (std::size_t e = 0; e < linear.second.size(); ++e)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(x[order[corners + e]][c], (x[order[linear.second[e][0]]][c] + x[order[linear.second[e][1]]][c]) / 2)
            << name(type) << " edge " << e;
  }
}

TEST(MeshOrientation, TheWorstJacobianIsTheRatioAtTheCorners) {
  std::vector<Vec3> x = kCorners.at(CellType::hexa8);
  x[6] = {0.75, 0.75, 0.75};
  Mesh mesh = one_cell(CellType::hexa8, x);
  orient_cells(mesh);
  // The edges at corner 6 are, up to their order, the rows of 0.25 * ones - identity, with the eigenvalues -1, -1,
  // -0.25: |det| = 0.25. Its neighbours have 0.75, the others 1.
  EXPECT_NEAR(mesh.report.worst_jacobian, 0.25, 1e-15);
  EXPECT_EQ(mesh.report.worst_cell, 17);
}

TEST(MeshOrientation, KeepsInterfacesOfZeroThicknessInEachDirection) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<Vec3> x = kCorners.at(CellType::hexa8);
    for (Vec3& point : x) point[axis] = 0.25;
    Mesh mesh = one_cell(CellType::hexa8, x);
    const auto before = mesh.blocks[0].connectivity;
    orient_cells(mesh);
    EXPECT_EQ(mesh.blocks[0].connectivity, before);
    EXPECT_TRUE(has_zero_thickness(mesh, CellType::hexa8, before));
    EXPECT_EQ(mesh.report.worst_cell, 0) << "interfaces do not count";
    EXPECT_TRUE(skin(mesh).empty());
  }
}

TEST(MeshOrientation, RefusesFoldedFlatAndDegenerateCells) {
  std::vector<Vec3> folded = kCorners.at(CellType::hexa8);
  std::swap(folded[6], folded[5]);
  const std::string text = message_of(one_cell(CellType::hexa8, folded));
  EXPECT_NE(text.find("test.msh: cell 17 (HEXA8): found Jacobians of both signs at the corners"), std::string::npos)
      << text;
  EXPECT_NE(text.find("at (0.5, 0.5, 0.5)"), std::string::npos) << text;

  Mesh repeated = one_cell(CellType::hexa8, kCorners.at(CellType::hexa8));
  repeated.blocks[0].connectivity[7] = repeated.blocks[0].connectivity[6];
  EXPECT_NE(message_of(repeated).find("found a node that occurs twice in the cell"), std::string::npos);

  std::vector<Vec3> flat = kCorners.at(CellType::tetra4);
  flat[3] = {1, 1, 0};
  EXPECT_NE(message_of(one_cell(CellType::tetra4, flat)).find("found no volume at a corner"), std::string::npos);

  std::vector<Vec3> line = kCorners.at(CellType::hexa8);
  for (Vec3& x : line) x[1] = x[2] = 0;
  EXPECT_NE(message_of(one_cell(CellType::hexa8, line)).find("found no volume at a corner"), std::string::npos)
      << "two pairs of faces coincide: a line, not an interface";
}

/// Two QUAD4 side by side, of which the second is clockwise, at height z.
Mesh two_quads(double z) {
  Mesh mesh = one_cell(CellType::quad4, {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}, {2, 0, z}, {2, 1, z}});
  mesh.blocks[0].connectivity = {0, 1, 2, 3, 1, 2, 5, 4};
  mesh.blocks[0].file_numbers = {17, 18};
  return mesh;
}

TEST(MeshOrientation, TurnsClockwiseQuadsOfPlaneMeshes) {
  Mesh mesh = two_quads(0.25);
  EXPECT_EQ(plane_turn(mesh, {&mesh.blocks[0].connectivity[4], 4}), -1);
  orient_cells(mesh);
  EXPECT_EQ(mesh.report.turned, 1u);
  EXPECT_EQ(mesh.blocks[0].connectivity, (std::vector<Index>{0, 1, 2, 3, 1, 4, 5, 2}));
  EXPECT_EQ(plane_turn(mesh, {&mesh.blocks[0].connectivity[4], 4}), 1);
  EXPECT_NEAR(mesh.report.worst_jacobian, 1.0, 1e-15);
  mesh.coordinates[5] = {1.75, 0.75, 0.25};  // products at the corners: 1, 0.75, 0.5, 0.75
  orient_cells(mesh);
  EXPECT_NEAR(mesh.report.worst_jacobian, 0.5, 1e-15);
  EXPECT_EQ(mesh.report.worst_cell, 18);
}

TEST(MeshOrientation, LeavesQuadsInSpaceAlone) {
  Mesh sheet = two_quads(0);
  sheet.coordinates[4][2] = 0.5;
  const auto before = sheet.blocks[0].connectivity;
  orient_cells(sheet);
  EXPECT_EQ(sheet.blocks[0].connectivity, before);
  EXPECT_EQ(sheet.report.worst_cell, 0);

  Mesh beside_solid = two_quads(0);
  beside_solid.blocks.push_back({CellType::tetra4, {0, 1, 2, 6}, {19}});
  beside_solid.coordinates.push_back({0, 0, 1});
  beside_solid.node_numbers.push_back(7);
  orient_cells(beside_solid);
  EXPECT_EQ(beside_solid.blocks[0].connectivity, before);
  EXPECT_EQ(beside_solid.report.turned, 0u);
}

TEST(MeshOrientation, RefusesFoldedQuadsAndKeepsInterfacesOfPlaneMeshes) {
  Mesh folded = two_quads(0);
  std::swap(folded.blocks[0].connectivity[6], folded.blocks[0].connectivity[7]);
  EXPECT_EQ(plane_turn(folded, {&folded.blocks[0].connectivity[4], 4}), 0);
  EXPECT_NE(message_of(folded).find("test.msh: cell 18 (QUAD4): found Jacobians of both signs"), std::string::npos);

  Mesh joint = two_quads(0);
  joint.coordinates[4] = joint.coordinates[1];
  joint.coordinates[5] = joint.coordinates[2];
  orient_cells(joint);
  EXPECT_EQ(joint.report.turned, 0u);
  EXPECT_EQ(skin(joint).size(), 4u) << "the joint hides no edge of the cell beside it";
}

TEST(MeshOrientation, VeryThinCellsAreCells) {
  std::vector<Vec3> thin = kCorners.at(CellType::hexa8);
  for (Vec3& x : thin) x[2] *= 1e-5;  // ten times the thickness below which faces coincide
  Mesh mesh = one_cell(CellType::hexa8, thin);
  orient_cells(mesh);
  EXPECT_NEAR(mesh.report.worst_jacobian, 1.0, 1e-12);
  EXPECT_FALSE(has_zero_thickness(mesh, CellType::hexa8, mesh.blocks[0].connectivity));
}

TEST(MeshOrientation, NamesAllCellsThatCannotBeUsed) {
  std::vector<Vec3> folded = kCorners.at(CellType::hexa8);
  std::swap(folded[6], folded[5]);
  Mesh mesh = one_cell(CellType::hexa8, folded);
  const std::vector<Index> nodes = mesh.blocks[0].connectivity;
  for (const std::int64_t number : {18, 25}) {
    mesh.blocks[0].file_numbers.push_back(number);
    mesh.blocks[0].connectivity.insert(mesh.blocks[0].connectivity.end(), nodes.begin(), nodes.end());
  }
  const std::string text = message_of(mesh);
  EXPECT_NE(text.find("cell 17 (HEXA8)"), std::string::npos) << text;
  EXPECT_NE(text.find("; 2 more cells like it: 18, 25"), std::string::npos) << text;
}

}  // namespace
}  // namespace carom::mesh_orientation_test
