// Groups as the case names them: "all", groups of nodes alone, pieces of bodies that end in others.
#include "build/groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "build/build_mesh.hpp"
#include "build/build_model.hpp"
#include "cell_meshes.hpp"
#include "mesh/structured_block.hpp"
#include "run_fixture.hpp"

namespace carom::run_groups_test {
namespace {

using namespace test;

const std::string rest = R"([materials.m]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
[scheme]
kind = "central_differences"
[time]
end = 1.0
)";

std::string part(const std::string& section) {
  return "[[part]]\nname = \"p\"\ncells = \"all\"\nmaterial = \"m\"\n" + section + "\n";
}

Model model_of(const std::string& text, const Mesh& mesh) {
  return build_model(parse_case("[mesh]\nfile = \"given.msh\"\nunused = \"ignore\"\n" + text + rest, "case.toml"),
                     std::make_shared<const Mesh>(mesh));
}

std::string message_of(const std::string& text, const Mesh& mesh) {
  try {
    model_of(text, mesh);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

CellBlock block_of(CellType type, std::vector<Index> connectivity) {
  CellBlock block{type, std::move(connectivity), {}};
  const std::size_t cells = block.connectivity.size() / static_cast<std::size_t>(node_count(type));
  for (std::size_t c = 0; c < cells; ++c) block.file_numbers.push_back(static_cast<std::int64_t>(c) + 1);
  return block;
}

void number(Mesh& mesh) {
  for (std::size_t n = 0; n < mesh.node_count(); ++n) mesh.node_numbers.push_back(static_cast<std::int64_t>(n) + 1);
}

/// A square of two plane cells with a bar that leaves it at its upper right corner (node 5), and the edges of its top.
Mesh square_with_bar() {
  Mesh mesh;
  mesh.coordinates = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {4, 1, 0}};
  mesh.blocks = {block_of(CellType::line2, {3, 4, 4, 5, 5, 6}), block_of(CellType::quad4, {0, 1, 4, 3, 1, 2, 5, 4})};
  mesh.cell_groups = {{"TOP", {{0, 0}, {0, 1}}}, {"BAR", {{0, 2}}}, {"PAD", {{1, 0}, {1, 1}}}};
  mesh.node_groups = {{"TOP_NODES", {3, 4, 5}}, {"FAR_END", {6}}};
  number(mesh);
  return mesh;
}

const std::string pad_and_bar = R"([[part]]
name = "pad"
cells = "PAD"
material = "m"
section = "plane_strain"
[[part]]
name = "bar"
cells = "BAR"
material = "m"
section = "bar"
area = 0.1
)";

/// Resultant of the pressures of a model along y.
double pressure_length(const Model& model) {
  double length = 0.0;
  for (const Load& load : model.loads)
    for (const Facet& facet : std::get<Pressure>(load).surface.facets)
      length += std::abs(model.mesh->coordinates[static_cast<std::size_t>(facet[1])][0] -
                         model.mesh->coordinates[static_cast<std::size_t>(facet[0])][0]);
  return length;
}

TEST(Groups, PressureOnAnEdgeWithABarAtItsCorner) {
  for (const char* group : {"TOP", "TOP_NODES"}) {
    const Model model =
        model_of(pad_and_bar + "[[load]]\npressure = 1.0\ngroup = \"" + group + "\"\n", square_with_bar());
    EXPECT_EQ(pressure_length(model), 2.0) << group;
  }
}

TEST(Groups, TheFreeEndOfABarIsStillASurface) {
  const Model model = model_of(pad_and_bar + "[[load]]\npressure = 1.0\ngroup = \"FAR_END\"\n", square_with_bar());
  EXPECT_EQ(std::get<Pressure>(model.loads[0]).surface.facets.size(), 1U);
}

// The ends of bars touch as points; whole bars touch obstacles with their sides, and no deformable surface yet.
TEST(Groups, BarsTouchObstaclesWithTheirSides) {
  const auto plane = [](const std::string& group) {
    return pad_and_bar +
           "[[contact]]\nname = \"c\"\nkind = \"plane\"\nnormal = [1.0, 0.0, 0.0]\npoint = [-9.0, 0.0, "
           "0.0]\ngroup = \"" +
           group + "\"\n";
  };
  const auto bars = [&](const std::string& group) {
    const Model model = model_of(plane(group), square_with_bar());
    return std::get<ObstacleContact>(model.contacts[0]).bars;
  };
  EXPECT_TRUE(bars("FAR_END").empty());
  ASSERT_EQ(bars("BAR").size(), 1U);
  EXPECT_DOUBLE_EQ(bars("BAR")[0].radius, std::sqrt(0.1 / std::numbers::pi));
  EXPECT_EQ(bars("BAR\"\nbar_radius = 0.25 # \"").at(0).radius, 0.25);
  const std::string pair =
      pad_and_bar + "[[contact]]\nname = \"c\"\nkind = \"pair\"\ngroup = \"BAR\"\nmaster = \"TOP\"\n";
  EXPECT_NE(message_of(pair, square_with_bar()).find("ends of bars alone"), std::string::npos)
      << message_of(pair, square_with_bar());
}

TEST(Groups, ARadiusIsThatOfBarsAlone) {
  const auto message = [](const std::string& group, const std::string& more) {
    return message_of(pad_and_bar +
                          "[[contact]]\nname = \"c\"\nkind = \"plane\"\nnormal = [1.0, 0.0, 0.0]\npoint = [-9.0, "
                          "0.0, 0.0]\nbar_radius = 0.1\ngroup = \"" +
                          group + "\"\n" + more,
                      square_with_bar());
  };
  EXPECT_NE(message("TOP", "").find("which holds no bar"), std::string::npos) << message("TOP", "");
  EXPECT_NE(message("BAR", "measure = \"node\"\n").find("a radius of bars with measure"), std::string::npos);
}

TEST(Groups, AllCellsOfASectionLeaveBoundariesAndOtherSectionsAlone) {
  const Model plane = model_of(part("section = \"plane_strain\""), square_with_bar());
  EXPECT_EQ(plane.parts[0].cells.size(), 2U);
  const Model bars = model_of(part("section = \"bar\"\narea = 1.0"), square_with_bar());
  EXPECT_EQ(bars.parts[0].cells, (std::vector<Index>{2}));  // the edges of the pad are no bars
  EXPECT_NE(message_of(part(""), square_with_bar()).find("\"all\" in a mesh without such cells"), std::string::npos);
}

/// Two cubes with an interface of zero thickness between them, and a triangle on top.
TEST(Groups, AllCellsLeaveInterfacesOut) {
  Mesh mesh;
  for (const double z : {0.0, 1.0, 1.0, 2.0})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      mesh.coordinates.push_back({x, y, z});
  std::vector<Index> cells;
  for (const Index first : {0, 4, 8})
    for (Index a = 0; a < 8; ++a) cells.push_back(first + a);
  mesh.blocks = {block_of(CellType::hexa8, cells), block_of(CellType::tria3, {12, 13, 14})};
  mesh.cell_groups = {{"GLUE", {{0, 1}}}};
  number(mesh);
  EXPECT_EQ(model_of(part(""), mesh).parts[0].cells, (std::vector<Index>{0, 2}));
  mesh.blocks.push_back(block_of(CellType::pyra5, {0, 1, 2, 3, 12}));
  const Model with_pyramid = model_of(part(""), mesh);
  EXPECT_EQ(with_pyramid.parts[0].cells, (std::vector<Index>{0}));
  EXPECT_EQ(with_pyramid.parts[1].cells, (std::vector<Index>{0, 2}));
}

/// A moving obstacle hangs on a node of its own, which no force and no support of the case is meant for.
// Hexahedra and pyramids in one group are one part, or one of each, picked by its name.
TEST(Groups, OfSeveralTypesAreTakenOrPicked) {
  StructuredBlock block;
  block.size = {1, 1, 1};
  block.divisions = {3, 1, 1};
  const Mesh mesh = with_mixed_cells(make_structured_blocks({block}));
  const Model both = model_of(part(""), mesh);
  ASSERT_EQ(both.parts.size(), 2U);
  EXPECT_EQ(both.parts[0].type, CellType::pyra5);
  EXPECT_EQ(both.parts[0].cells.size(), 12U);
  EXPECT_EQ(both.parts[1].type, CellType::hexa8);
  EXPECT_EQ(both.parts[1].cells.size(), 1U);
  const Model one = model_of(part("type = \"HEXA8\""), mesh);
  EXPECT_EQ(one.parts[0].cells.size(), 1U);
  EXPECT_EQ(one.parts[0].type, CellType::hexa8);
  const std::string none = message_of(part("type = \"LINE2\""), mesh);
  EXPECT_NE(none.find("part.type: found \"LINE2\" with section = \"solid\"; expected HEXA8"), std::string::npos)
      << none;
}

// A group of faces of a mesh of tetrahedra of second order: by its TRIA6 cells, or by all their nodes.
TEST(Groups, OfQuadraticFacesAreTheirPieces) {
  StructuredBlock block;
  block.size = {1, 1, 1};
  block.divisions = {2, 2, 2};
  Mesh mesh = with_cells(make_structured_blocks({block}), CellType::tetra10);
  mesh.node_groups["NODES"] = mesh.nodes_of("ZMAX");
  const Groups groups(mesh);
  const auto facets = [&](const char* group) {
    return groups.outer_facets(Located<std::string>{group, {}}, "group").size();
  };
  EXPECT_EQ(facets("ZMAX"), 4U * 8U);  // four triangles of each of two faces of each of four squares
  EXPECT_EQ(facets("NODES"), 4U * 8U);
  EXPECT_EQ(groups.rigid_faces(Located<std::string>{"ZMAX", {}}, "group").size(), 4U * 8U);
}

TEST(Groups, AllNodesAreThoseOfTheMesh) {
  const Case given = parse_case(case_of_block(R"([[load]]
group = "all"
force = [0.0, 0.0, 1.0]
[[contact]]
name = "ram"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, -1.0]
normal = [0.0, 0.0, 1.0]
velocity = [0.0, 0.0, 1.0]
[scheme]
kind = "central_differences"
[time]
end = 1.0
)"),
                                "case.toml");
  const auto mesh = std::make_shared<const Mesh>(build_mesh(given));
  const Model model = build_model(given, mesh);
  EXPECT_EQ(std::get<NodalForce>(model.loads[0]).nodes.size(), 36U);
  EXPECT_EQ(mesh->node_count(), 37U);
}

TEST(Groups, PathsWithBackslashesAreToldApart) {
  const std::string text = "[mesh]\nfile = \"meshes\\block.msh\"\n" + part("") + rest;
  const std::string message = case_error(text).what();
  EXPECT_NE(message.find("write paths with /"), std::string::npos) << message;
  EXPECT_EQ(message.find('\b'), std::string::npos);  // no control character reaches the terminal
}

/// Pairs and pressures on groups that hold nodes only: the faces all of whose nodes belong.
TEST(Groups, NodesAloneNameTheFacesBetweenThem) {
  const std::string text = R"(units = "SI"
[[mesh.block]]
size = [2.0, 2.0, 1.0]
divisions = [2, 2, 1]
groups = { cells = "LOW", zmax = "LOW_TOP" }
[[mesh.block]]
origin = [0.0, 0.0, 1.1]
size = [2.0, 2.0, 1.0]
divisions = [2, 2, 1]
groups = { cells = "HIGH", zmin = "HIGH_FOOT", zmax = "HIGH_TOP" }
[[part]]
name = "both"
cells = "all"
material = "m"
[[load]]
group = "HIGH_TOP"
pressure = 1.0
[[contact]]
name = "pair"
kind = "pair"
group = "HIGH_FOOT"
master = "LOW_TOP"
)" + rest;
  const Case given = parse_case(text, "case.toml");
  Mesh mesh = build_mesh(given);
  for (const char* group : {"LOW_TOP", "HIGH_FOOT", "HIGH_TOP"}) {
    mesh.node_groups[group] = mesh.nodes_of(group);
    mesh.cell_groups.erase(group);
  }
  const Model model = build_model(given, std::make_shared<const Mesh>(std::move(mesh)));
  EXPECT_EQ(std::get<Pressure>(model.loads[0]).surface.facets.size(), 4U);
  const auto& pair = std::get<PairContact>(model.contacts[0]);
  EXPECT_EQ(pair.slave.facets.size(), 4U);
  EXPECT_EQ(pair.master.facets.size(), 4U);
}

/// All groups that the mesh lacks, whatever else is wrong with the case.
TEST(RunGroups, AllGroupsThatTheMeshLacksAreNamedAtOnce) {
  const TemporaryCase wrong(R"([[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [1, 1, 1]
groups = { cells = "BLOCK", zmin = "FOOT" }
[materials.m]
law = "linear_elastc"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "p"
cells = "BLOK"
material = "m"
[[support]]
nodes = "FOT"
blocked = ["z"]
[scheme]
kind = "central_differences"
[time]
end = 1.0
)");
  try {
    wrong.run();
    FAIL() << "ran";
  } catch (const CaseError& error) {
    std::vector<std::string> keys;
    for (const CaseError& each : error.all()) keys.push_back(each.key());
    EXPECT_EQ(keys, (std::vector<std::string>{"materials.m.law", "part.cells", "support.nodes"})) << error.what();
  }
}

}  // namespace
}  // namespace carom::run_groups_test
