// Meshes from decks: numbers, node orders, sets, surfaces, instances.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/deck_mesh.hpp"
#include "mesh/read_gmsh.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh/write_gmsh.hpp"
#include "mesh_fixture.hpp"

namespace carom::mesh_deck_test {
namespace {

std::string no_file(const std::string& path, const Location& where) {
  throw CaseError(where, "*INCLUDE", "no file " + path, "");
}

Mesh read(const std::string& text) {
  return read_deck_mesh(text, "x.inp", no_file);
}

std::set<std::int64_t> numbers_of(const Mesh& mesh, const std::string& group) {
  std::set<std::int64_t> numbers;
  for (const Index n : mesh.nodes_of(group)) numbers.insert(mesh.node_numbers[at(n)]);
  return numbers;
}

/// Two cubes of side 1 along z: nodes 1 to 12, elements 1 and 2.
const std::string kTwoCubes =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n9,0,0,2\n10,1,0,2\n11,1,1,2\n"
    "12,0,1,2\n*ELEMENT, TYPE=C3D8, ELSET=ALL\n1,1,2,3,4,5,6,7,8\n2,5,6,7,8,\n9,10,11,12\n";

/// Order of the nodes of the only cell of a group.
std::vector<std::int64_t> order_in(const Mesh& mesh, const std::string& group) {
  const CellRef& cell = mesh.cell_groups.at(group).at(0);
  std::vector<std::int64_t> numbers;
  for (const Index n : mesh.blocks[at(cell.block)].nodes(cell.cell)) numbers.push_back(mesh.node_numbers[at(n)]);
  return numbers;
}

// The positive side of a line is a quarter turn counter-clockwise from its first node to its second (Abaqus Analysis
// User's Guide, Rigid elements); Facet has the clockwise one. That of a face is by the right-hand rule in both.
TEST(MeshDeck, SidesOfRigidFacesAreThoseOfTheirNormals) {
  const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n";
  const std::string sides = "*SURFACE, NAME=P\nW, SPOS\n*SURFACE, NAME=M\nW, SNEG\n*SURFACE, NAME=U\nW,\n";
  const auto turned = [](const std::vector<std::int64_t>& from, const std::vector<std::int64_t>& to) {
    return std::vector<std::int64_t>(from.rbegin(), from.rend()) == to;
  };
  for (const std::string type : {"R2D2", "RAX2"}) {
    const Mesh line = read(nodes + "*ELEMENT, TYPE=" + type + ", ELSET=W\n1,1,2\n" + sides);
    EXPECT_EQ(order_in(line, "P"), (std::vector<std::int64_t>{2, 1})) << type;
    EXPECT_EQ(order_in(line, "M"), (std::vector<std::int64_t>{1, 2})) << type;
    EXPECT_EQ(order_in(line, "U"), order_in(line, "P")) << type;
  }
  const Mesh face = read(kTwoCubes + "*ELEMENT, TYPE=R3D4, ELSET=W\n9,1,2,3,4\n" + sides);
  EXPECT_EQ(order_in(face, "P"), (std::vector<std::int64_t>{1, 2, 3, 4}));
  EXPECT_TRUE(turned(order_in(face, "P"), order_in(face, "M")));
}

TEST(MeshDeck, NodesAndCellsByNumber) {
  const Mesh mesh = read(kTwoCubes);
  EXPECT_EQ(mesh.node_count(), 12U);
  ASSERT_NE(mesh.block(CellType::hexa8), nullptr);
  EXPECT_EQ(mesh.block(CellType::hexa8)->size(), 2U);
  EXPECT_EQ(numbers_of(mesh, "ALL").size(), 12U);
  EXPECT_EQ(mesh.report.turned, 0U);
}

TEST(MeshDeck, IsToldByItsFirstKeywordWhateverTheName) {
  EXPECT_EQ(read_mesh(std::string_view(kTwoCubes), "mesh.txt").report.format, "deck of Abaqus or CalculiX");
}

TEST(MeshDeck, SetsGeneratedNestedUnsortedAndUnited) {
  const Mesh mesh = read(kTwoCubes +
                         "*NSET, NSET=A, GENERATE\n1, 9, 4\n*NSET, NSET=b\n a, 7, 2, 7\n*NSET, NSET=A\n12\n"
                         "*ELSET, ELSET=TOP\n2\n*NSET, NSET=OF_TOP, ELSET=TOP\n");
  EXPECT_EQ(numbers_of(mesh, "A"), (std::set<std::int64_t>{1, 5, 9, 12}));
  EXPECT_EQ(numbers_of(mesh, "B"), (std::set<std::int64_t>{1, 2, 5, 7, 9}));
  EXPECT_EQ(numbers_of(mesh, "OF_TOP"), (std::set<std::int64_t>{5, 6, 7, 8, 9, 10, 11, 12}));
}

TEST(MeshDeck, ANodeSetNamedLikeAnotherSetOfCellsKeepsItsOwnNodes) {
  const Mesh mesh = read(kTwoCubes + "*NSET, NSET=ALL\n1, 2\n*SURFACE, NAME=ALL\n2, S2\n");
  EXPECT_EQ(numbers_of(mesh, "ALL (nodes)"), (std::set<std::int64_t>{1, 2}));
  EXPECT_EQ(numbers_of(mesh, "ALL (surface)"), (std::set<std::int64_t>{9, 10, 11, 12}));
}

/// Abaqus Analysis User's Guide, "Solid (continuum) elements", faces of a hexahedron: 1-2-3-4, 5-8-7-6, 1-5-6-2,
/// 2-6-7-3, 3-7-8-4, 4-8-5-1.
TEST(MeshDeck, FacesOfAHexahedronAsAbaqusCountsThem) {
  const std::vector<std::set<std::int64_t>> faces{{1, 2, 3, 4}, {5, 6, 7, 8}, {1, 2, 5, 6},
                                                  {2, 3, 6, 7}, {3, 4, 7, 8}, {1, 4, 5, 8}};
  for (std::size_t f = 0; f < 6; ++f) {
    const Mesh mesh = read(kTwoCubes + fmt::format("*SURFACE, NAME=F, TYPE=ELEMENT\n1, S{}\n", f + 1));
    EXPECT_EQ(numbers_of(mesh, "F"), faces[f]) << f + 1;
    EXPECT_EQ(mesh.cell_groups.at("F").size(), 1U);
  }
}

/// The same guide: tetrahedra 1-2-3, 1-4-2, 2-4-3, 3-4-1; wedges 1-2-3, 4-6-5, 1-4-5-2, 2-5-6-3, 3-6-4-1.
TEST(MeshDeck, FacesOfTetrahedraAndWedges) {
  const std::string tetra = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n";
  const std::vector<std::set<std::int64_t>> of_tetra{{1, 2, 3}, {1, 2, 4}, {2, 3, 4}, {1, 3, 4}};
  for (std::size_t f = 0; f < 4; ++f)
    EXPECT_EQ(numbers_of(read(tetra + fmt::format("*SURFACE, NAME=F\n1, S{}\n", f + 1)), "F"), of_tetra[f]) << f + 1;
  const std::string wedge =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,0,1\n6,0,1,1\n*ELEMENT, TYPE=C3D6\n1,1,2,3,4,5,6\n";
  const std::vector<std::set<std::int64_t>> of_wedge{{1, 2, 3}, {4, 5, 6}, {1, 2, 4, 5}, {2, 3, 5, 6}, {1, 3, 4, 6}};
  for (std::size_t f = 0; f < 5; ++f)
    EXPECT_EQ(numbers_of(read(wedge + fmt::format("*SURFACE, NAME=F\n1, S{}\n", f + 1)), "F"), of_wedge[f]) << f + 1;
}

TEST(MeshDeck, ASurfaceWithoutFaceNumbersIsTheOutside) {
  const Mesh mesh = read(kTwoCubes + "*SURFACE, NAME=SKIN\nALL,\n*SURFACE, NAME=LOW\n1\n");
  EXPECT_EQ(mesh.cell_groups.at("SKIN").size(), 10U);
  EXPECT_EQ(mesh.cell_groups.at("LOW").size(), 5U);
}

TEST(MeshDeck, FacesBetweenTheNodesOfASurface) {
  const Mesh mesh = read(kTwoCubes + "*SURFACE, NAME=N, TYPE=NODE\n1\n2,\n3\n4\n5\n6\n");
  EXPECT_EQ(mesh.cell_groups.at("N (faces)").size(), 2U);  // below, and in front
  EXPECT_EQ(numbers_of(mesh, "N (faces)"), (std::set<std::int64_t>{1, 2, 3, 4, 5, 6}));
}

TEST(MeshDeck, AFaceInSeveralSurfacesIsOneCell) {
  const Mesh mesh = read(kTwoCubes + "*SURFACE, NAME=A\n1, S1\n*SURFACE, NAME=B\n1, S1\n1, S3\n");
  EXPECT_EQ(mesh.block(CellType::quad4)->size(), 2U);
}

/// A cell of second order whose nodes stand where the manuals put them: middles of the edges 1-2, 2-3, 3-4, 4-1, those
/// of the top, the upright ones; of 27 nodes then the centre, and those of the faces S1 to S6. Then every node must be
/// the mean of the corners of its edge or face in Carom's order.
std::string quadratic_hexa(const char* type, std::size_t nodes) {
  const std::vector<Vec3> corner{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<std::vector<std::size_t>> rest{{1, 2},
                                                   {2, 3},
                                                   {3, 4},
                                                   {4, 1},
                                                   {5, 6},
                                                   {6, 7},
                                                   {7, 8},
                                                   {8, 5},
                                                   {1, 5},
                                                   {2, 6},
                                                   {3, 7},
                                                   {4, 8},
                                                   {1, 2, 3, 4, 5, 6, 7, 8},
                                                   {1, 2, 3, 4},
                                                   {5, 8, 7, 6},
                                                   {1, 5, 6, 2},
                                                   {2, 6, 7, 3},
                                                   {3, 7, 8, 4},
                                                   {4, 8, 5, 1}};
  std::string text = "*NODE\n", element = fmt::format("*ELEMENT, TYPE={}, ELSET=E\n1", type);
  for (std::size_t n = 0; n < nodes; ++n) {
    Vec3 x{};
    if (n < 8) x = corner[n];
    for (std::size_t k = 0; n >= 8 && k < rest[n - 8].size(); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        x[c] += corner[rest[n - 8][k] - 1][c] / static_cast<double>(rest[n - 8].size());
    text += fmt::format("{}, {}, {}, {}\n", n + 1, x[0], x[1], x[2]);
    element += (n % 15 == 14 ? ",\n" : ", ") + std::to_string(n + 1);
  }
  return text + element + "\n";
}

void expect_middles(const Mesh& mesh, CellType type) {
  const auto nodes = mesh.block(type)->nodes(0);
  const auto mean = [&](std::span<const LocalNode> of) {
    Vec3 x{};
    for (const LocalNode n : of)
      for (std::size_t c = 0; c < 3; ++c) x[c] += mesh.coordinates[at(nodes[n])][c] / static_cast<double>(of.size());
    return x;
  };
  const auto edges = cell_edges(type);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::size_t middle = static_cast<std::size_t>(corner_count(type)) + e;
    EXPECT_EQ(mesh.coordinates[at(nodes[middle])], mean(edges[e])) << e;
  }
  if (type != CellType::hexa27) return;
  for (const CellFace& face : cell_faces(type))
    EXPECT_EQ(mesh.coordinates[at(nodes[face.node[8]])], mean(face.corners()));
  EXPECT_EQ(mesh.coordinates[at(nodes[26])], (Vec3{0.5, 0.5, 0.5}));
}

TEST(MeshDeck, OrderOfQuadraticHexahedra) {
  expect_middles(read(quadratic_hexa("C3D20R", 20)), CellType::hexa20);
  expect_middles(read(quadratic_hexa("C3D27", 27)), CellType::hexa27);
}

/// The same guide: middles of 1-2, 2-3, 3-1, 1-4, 2-4, 3-4.
TEST(MeshDeck, OrderOfQuadraticTetrahedra) {
  expect_middles(read("*NODE\n1,0,0,0\n2,2,0,0\n3,0,2,0\n4,0,0,2\n5,1,0,0\n6,1,1,0\n7,0,1,0\n8,0,0,1\n9,1,0,1\n"
                      "10,0,1,1\n*ELEMENT, TYPE=C3D10\n1,1,2,3,4,5,6,7,8,9,10\n"),
                 CellType::tetra10);
}

TEST(MeshDeck, InstancesHaveTheirOwnNumbersAndPlaces) {
  const std::string part = "*PART, NAME=P\n" + kTwoCubes + "*NSET, NSET=TOP\n9,10,11,12\n*END PART\n";
  const Mesh mesh = read(part +
                         "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*INSTANCE, NAME=J, PART=P\n"
                         "0., 0., 5.\n*END INSTANCE\n*NSET, NSET=MINE, INSTANCE=J\n1\n*NSET, NSET=MINE\nI.2, J.TOP\n"
                         "*SURFACE, NAME=S\nJ.ALL, S1\n*END ASSEMBLY\n");
  EXPECT_EQ(mesh.node_count(), 24U);
  EXPECT_EQ(numbers_of(mesh, "J.TOP"), (std::set<std::int64_t>{21, 22, 23, 24}));
  EXPECT_EQ(numbers_of(mesh, "MINE"), (std::set<std::int64_t>{2, 13, 21, 22, 23, 24}));
  EXPECT_EQ(mesh.cell_groups.at("S").size(), 2U);
  for (const Index n : mesh.nodes_of("J.TOP")) EXPECT_EQ(mesh.coordinates[at(n)][2], 7.0);
}

/// A block of 2 x 3 x 2 cells from its corners' lines, as the Abaqus Keywords Guide has *NGEN and *ELGEN: numbers of
/// nodes grow by 1 along x, 10 along y and 100 along z.
TEST(MeshDeck, NodesAndElementsThatAreGenerated) {
  std::string nodes, lines;
  for (const int z : {0, 1, 2})
    for (const int y : {0, 1, 2, 3}) {
      const int first = 1 + 10 * y + 100 * z;
      nodes += fmt::format("{}, 0, {}, {}\n{}, 4, {}, {}\n", first, y, z, first + 2, y, z);
      lines += fmt::format("{}, {}\n", first, first + 2);
    }
  const std::string made = "*NODE\n" + nodes + "*NGEN, NSET=INNER\n" + lines +
                           "*ELEMENT, TYPE=C3D8\n1, 1,2,12,11, 101,102,112,111\n*ELGEN, ELSET=ALL\n"
                           "1, 2, 1, 1, 3, 10, 10, 2, 100, 100\n";
  const Mesh mesh = read(made);
  ASSERT_EQ(mesh.node_count(), 36U);
  ASSERT_EQ(mesh.cell_groups.at("ALL").size(), 12U);
  EXPECT_EQ(mesh.node_groups.at("INNER").size(), 36U);  // with the ends
  double volume = 0.0;
  const CellBlock& cells = *mesh.block(CellType::hexa8);
  for (Index k = 0; k < 12; ++k) {
    const auto n = cells.nodes(k);
    const Vec3 a = mesh.coordinates[at(n[0])], b = mesh.coordinates[at(n[6])];
    volume += (b[0] - a[0]) * (b[1] - a[1]) * (b[2] - a[2]);  // boxes along the axes
  }
  EXPECT_NEAR(volume, 4.0 * 3.0 * 2.0, 1e-13);
  EXPECT_EQ(std::set<std::int64_t>(cells.file_numbers.begin(), cells.file_numbers.end()),
            (std::set<std::int64_t>{1, 2, 11, 12, 21, 22, 101, 102, 111, 112, 121, 122}));
}

TEST(MeshDeck, WhatCannotBeGeneratedIsRefused) {
  const auto message = [](const std::string& more) {
    try {
      read(kTwoCubes + more);
    } catch (const CaseError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const auto has = [&](const std::string& more, const std::string& part) {
    EXPECT_NE(message(more).find(part), std::string::npos) << message(more);
  };
  has("*NGEN\n1, 99\n", "*NGEN: found node 99, which is not there; expected two nodes of a *NODE before this line");
  has("*NGEN\n1, 4, 2\n",
      "*NGEN: found 1, 4, 2; expected first, last and an increment that leads from one to the other");
  has("*NGEN\n1, 3\n", "*NGEN: found node 2 a second time");
  has("*NGEN, LINE=C\n1, 3\n", "*NGEN: found LINE=C; expected nodes on straight lines");
  has("*ELGEN\n9, 2\n", "*ELGEN: found element 9, which is not there");
  has("*ELGEN\n1, 2\n", "*ELGEN: found element 2 a second time");
  has("*ELGEN\n1, 2, 50, 50\n", "*ELGEN: found node 51 of element 51, which is not there");
  has("*ELGEN\n1, 2000000000\n", "expected from 1 to 20000000");
}

/// Numbers in messages are those that the instance writes.
TEST(MeshDeck, NumbersOfInstancesHaveTheirNames) {
  const std::string cube = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n80,0,1,1\n";
  const Mesh mesh =
      read("*PART, NAME=P\n" + cube +
           "*ELEMENT, TYPE=C3D8, ELSET=E\n405,1,2,3,4,5,6,7,80\n*END PART\n*ASSEMBLY, NAME=A\n"
           "*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*INSTANCE, NAME=J, PART=P\n0., 0., 3.\n*END INSTANCE\n"
           "*NODE\n1001, 9., 9., 9.\n*END ASSEMBLY\n");
  std::set<std::string> nodes;
  for (Index n = 0; n < static_cast<Index>(mesh.node_count()); ++n) nodes.insert(mesh.node_label(n));
  EXPECT_TRUE(nodes.contains("80 of instance I") && nodes.contains("1 of instance J") && nodes.contains("1001"));
  std::set<std::string> cells;
  for (const CellRef& cell : mesh.cell_groups.at("I.E")) cells.insert(mesh.cell_label(cell));
  for (const CellRef& cell : mesh.cell_groups.at("J.E")) cells.insert(mesh.cell_label(cell));
  EXPECT_EQ(cells, (std::set<std::string>{"405 of instance I", "405 of instance J"}));
}

TEST(MeshDeck, NodesAndFacesThatLoadsNameAreGroups) {
  const Mesh mesh = read(kTwoCubes + "*BOUNDARY\n3, 1\n*DLOAD\nALL, P1, 2.\n2, P2, 1.\n");
  EXPECT_EQ(numbers_of(mesh, "3"), (std::set<std::int64_t>{3}));
  EXPECT_EQ(mesh.cell_groups.at("ALL P1").size(), 2U);
  EXPECT_EQ(numbers_of(mesh, "2 P2"), (std::set<std::int64_t>{9, 10, 11, 12}));
}

TEST(MeshDeck, CellsOfSeveralTypesInOneSetHaveGroupsOfTheirOwn) {
  const std::string text = kTwoCubes + "*ELEMENT, TYPE=C3D8R, ELSET=ALL\n3,1,2,3,4,9,10,11,12\n";
  const Deck deck = read_deck(text, "x.inp", no_file);
  const DeckMesh made = deck_mesh(statements_of(deck), "x.inp");
  ASSERT_EQ(made.names.element_sets.at("ALL").size(), 2U);
  EXPECT_EQ(made.mesh.cell_groups.at("ALL C3D8").size(), 2U);
  EXPECT_EQ(made.mesh.cell_groups.at("ALL C3D8R").size(), 1U);
}

TEST(MeshDeck, WhatIsWrittenAsGmshIsReadBackTheSame) {
  const std::string text =
      kTwoCubes + "*NSET, NSET=SOME NODES\n1, 7\n*ELSET, ELSET=ONE\n1\n*SURFACE, NAME=TOP\n2, S2\n";
  const Mesh mesh = read(text), again = read_gmsh(gmsh_text(mesh), "again.msh");
  EXPECT_EQ(test::by_file_numbers(mesh), test::by_file_numbers(again));
  const Mesh quadratic = read(quadratic_hexa("C3D27", 27));
  EXPECT_EQ(test::by_file_numbers(quadratic), test::by_file_numbers(read_gmsh(gmsh_text(quadratic), "again.msh")));
}

/// A quarter of a circle of radius 2 about the origin, from (2, 0) to (0, 2), in pieces of 3 degrees: its outward
/// normal is a quarter turn counter-clockwise from its way, so that it looks to the centre. Turned about the axis it is
/// half a sphere, whose points at r = 0 are one.
TEST(MeshDeck, AnalyticalSurfaces) {
  const std::string rest = "START, 2., 0.\nCIRCL, 0., 2., 0., 0.\n";
  const Mesh plane = read("*NODE\n1, 0., 0.\n*SURFACE, TYPE=SEGMENTS, NAME=ARC\n" + rest);
  const std::vector<CellRef>& arc = plane.cell_groups.at("ARC");
  ASSERT_EQ(arc.size(), 30U);
  for (const CellRef& cell : arc) {
    const auto nodes = plane.blocks[at(cell.block)].nodes(cell.cell);
    const Vec3 a = plane.coordinates[at(nodes[0])], b = plane.coordinates[at(nodes[1])];
    EXPECT_NEAR(norm(a), 2.0, 1e-15);
    EXPECT_LT(cross(a, b)[2], 0.0);  // lines are numbered clockwise, as Facet has them
  }
  const Mesh ball = read("*NODE\n1, 0., 0., 0.\n*SURFACE, TYPE=REVOLUTION, NAME=BALL\n0., 0., 0., 0., 0., 1.\n" + rest);
  EXPECT_EQ(ball.cell_groups.at("BALL").size(), 30U * 72U);
  EXPECT_EQ(ball.block(CellType::tria3)->size(), 72U);
  EXPECT_EQ(ball.node_count(), 1U + 30U * 72U + 1U);
  for (const CellRef& cell : ball.cell_groups.at("BALL")) {
    const auto nodes = ball.blocks[at(cell.block)].nodes(cell.cell);
    const Vec3 a = ball.coordinates[at(nodes[0])], b = ball.coordinates[at(nodes[1])],
               c = ball.coordinates[at(nodes[2])];
    EXPECT_LT(dot(cross(subtract(b, a), subtract(c, a)), a), 0.0);
  }
}

TEST(MeshDeck, ElementsNameNodesOfInstances) {
  const Mesh mesh = read(
      "*PART, NAME=P\n*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n"
      "*END INSTANCE\n*ELEMENT, TYPE=T3D2, ELSET=BAR\n1, P-1.1, P-1.2\n*END ASSEMBLY\n");
  EXPECT_EQ(mesh.nodes_of("BAR").size(), 2U);
}

}  // namespace
}  // namespace carom::mesh_deck_test
