// One part with cells of several types: what each type is made with, and that results, messages and contact see one
// part.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numeric>

#include "advise/check_summary.hpp"
#include "cell_meshes.hpp"
#include "mesh/structured_block.hpp"
#include "mesh/write_gmsh.hpp"
#include "output/summary.hpp"
#include "run_fixture.hpp"
#include "solid/element_table.hpp"
#include "view/frame_file.hpp"

namespace carom::run_mixed_cells_test {
namespace {

using namespace test;

/// Three unit cells in a row: the first is a HEXA8, each of the others six PYRA5.
Mesh column_at(double x, const std::string& group) {
  StructuredBlock block;
  block.origin = {x, 0.0, 0.0};
  block.size = {1.0, 1.0, 3.0};
  block.divisions = {1, 1, 3};
  block.cells_group = group;
  block.face_groups.fill("");
  return with_mixed_cells(make_structured_blocks({block}));
}

/// Two of them, 0.1 apart.
Mesh two_columns() {
  Mesh mesh = column_at(0.0, "A");
  const Mesh other = column_at(1.1, "B");
  const auto nodes = static_cast<Index>(mesh.node_count());
  mesh.coordinates.insert(mesh.coordinates.end(), other.coordinates.begin(), other.coordinates.end());
  mesh.node_numbers.resize(mesh.node_count());
  std::iota(mesh.node_numbers.begin(), mesh.node_numbers.end(), 1);
  std::int64_t number = 0;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const CellBlock& more = other.blocks[b];
    for (std::size_t k = 0; k < more.size(); ++k)
      mesh.cell_groups["B"].push_back({static_cast<Index>(b), static_cast<Index>(mesh.blocks[b].size() + k)});
    for (const Index n : more.connectivity) mesh.blocks[b].connectivity.push_back(n + nodes);
    mesh.blocks[b].file_numbers.resize(2 * more.size());
    for (std::int64_t& each : mesh.blocks[b].file_numbers) each = ++number;
  }
  return mesh;
}

/// A triangle on a square, as a recombined mesh has them.
Mesh square_with_triangle() {
  Mesh mesh;
  mesh.coordinates = {{1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, {1.5, 2.0, 0.0}};
  mesh.node_numbers = {1, 2, 3, 4, 5};
  mesh.blocks = {{CellType::tria3, {3, 2, 4}, {1}}, {CellType::quad4, {0, 1, 2, 3}, {2}}};
  mesh.cell_groups = {{"A", {{0, 0}, {1, 0}}}};
  return mesh;
}

std::string file_of(const Mesh& mesh, const std::string& name) {
  // Tests of one program run side by side.
  const std::string path =
      testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + "_" + name + ".msh";
  std::ofstream(path) << gmsh_text(mesh);
  return fmt::format("units = \"SI\"\n[mesh]\nfile = \"{}\"\n", path);
}

std::string part(const std::string& name, const std::string& group, const std::string& more = "") {
  return fmt::format("[[part]]\nname = \"{}\"\ncells = \"{}\"\nmaterial = \"m\"\n{}\n", name, group, more);
}

const std::string rest = R"([materials.m]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
[scheme]
kind = "central_differences"
[time]
end = 2.0
step = 0.02
[output]
fields = ["displacement"]
)";

std::string column_case(const std::string& more) {
  return file_of(column_at(0.0, "A"), "column") + part("a", "A", more) + rest;
}

/// What both cases of two columns share: B flies at A.
const std::string impact = R"([[initial]]
part = "b"
velocity = [-0.2, 0.0, 0.0]
[[contact]]
name = "k"
kind = "all"
stiffness = 4.0
)";

Formulation formulation_of(const Part& part) {
  return find_element(part.type, part.section, part.formulation)->formulation;
}

/// A law that yields: each type takes the formulation that it would have in a part of its own.
TEST(MixedCells, EachTypeHasItsOwnFormulation) {
  const std::string metal = replaced(rest, "\"linear_elastic\"", "\"j2\"\nyield_stress = 1.0");
  const Simulation solid(parse_case(file_of(column_at(0.0, "A"), "column") + part("a", "A") + metal, "case.toml"));
  const std::vector<Part>& parts = solid.model().parts;
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].type, CellType::pyra5);
  EXPECT_EQ(parts[0].cells.size(), 12U);
  EXPECT_EQ(formulation_of(parts[0]), Formulation::full);
  EXPECT_EQ(parts[1].type, CellType::hexa8);
  EXPECT_EQ(parts[1].cells.size(), 1U);
  EXPECT_EQ(formulation_of(parts[1]), Formulation::stabilised);
  EXPECT_EQ(solid.model().part_numbers(), (std::vector<Index>{0, 0}));
  EXPECT_TRUE(solid.notes().empty());
  const Simulation plane(parse_case(
      file_of(square_with_triangle(), "square") + part("a", "A", "section = \"axisymmetric\"") + metal, "case.toml"));
  ASSERT_EQ(plane.model().parts.size(), 2U);
  EXPECT_EQ(formulation_of(plane.model().parts[0]), Formulation::nodal);
  EXPECT_EQ(formulation_of(plane.model().parts[1]), Formulation::stabilised);
  ASSERT_EQ(plane.model().motions.size(), 1U);  // all five nodes are held along z once
  EXPECT_EQ(plane.model().motions[0].nodes.size(), 5U);
}

TEST(MixedCells, AFormulationIsForTheCellsThatHaveIt) {
  const Simulation s(parse_case(column_case("formulation = \"one_point\"\nhourglass = 0.1"), "case.toml"));
  EXPECT_EQ(formulation_of(s.model().parts[0]), Formulation::full);
  EXPECT_FALSE(s.model().parts[0].hourglass);
  EXPECT_EQ(formulation_of(s.model().parts[1]), Formulation::one_point);
  EXPECT_EQ(s.model().parts[1].hourglass, 0.1);
  ASSERT_EQ(s.notes().size(), 1U);
  EXPECT_EQ(s.notes()[0], "part \"a\": not all of its cells have formulation = \"one_point\"; PYRA5 \"full\" instead");
  const std::string none = case_error(column_case("formulation = \"reduced\"")).what();
  EXPECT_NE(none.find("part.formulation: found \"reduced\" of PYRA5 and HEXA8 cells with section = \"solid\"; expected "
                      "full of PYRA5; stabilised, full, mean_dilatation or one_point of HEXA8"),
            std::string::npos)
      << none;
  const std::string no_modes = case_error(column_case("formulation = \"full\"\nhourglass = 0.1")).what();
  EXPECT_NE(no_modes.find("part.hourglass: found formulation \"full\""), std::string::npos) << no_modes;
}

/// Of the pyramids alone, which lock where the body yields.
TEST(MixedCells, WarningsNameTheTypeThatTheyAreAbout) {
  const std::string metal = replaced(rest, "\"linear_elastic\"", "\"j2\"\nyield_stress = 1.0");
  const Simulation s(parse_case(file_of(column_at(0.0, "A"), "column") + part("a", "A") + metal, "case.toml"));
  const Examination seen = examine(s, testing::TempDir());
  const auto locks = std::count_if(seen.warnings.begin(), seen.warnings.end(), [](const std::string& warning) {
    return warning.find("part \"a\": PYRA5 cells in full integration lock") != std::string::npos;
  });
  EXPECT_EQ(locks, 1) << seen.text();
}

/// The bits of the parts of one type each, which share their nodes; but one part wherever parts are counted.
TEST(MixedCells, ARunSeesOnePart) {
  const std::string mesh = file_of(two_columns(), "columns");
  const TemporaryCase one(mesh + part("a", "A") + part("b", "B") + rest + impact);
  const std::string pyra = "type = \"PYRA5\"", hexa = "type = \"HEXA8\"";
  const TemporaryCase several(mesh + part("a", "A", pyra) + part("a2", "A", hexa) + part("b", "B", pyra) +
                              part("b2", "B", hexa) + rest + impact +
                              "[[initial]]\npart = \"b2\"\nvelocity = [-0.2, 0.0, 0.0]\n");
  one.run();
  several.run();
  EXPECT_EQ(one.result("energy.csv"), several.result("energy.csv"));
  const Summary summary = read_summary((one.results() / "summary.json").string());
  ASSERT_EQ(summary.parts.size(), 2U);
  for (const PartSummary& each : summary.parts) EXPECT_NEAR(each.mass, 4.5, 1e-14) << each.name;  // 1.5 on 3 cubes
  EXPECT_EQ(summary.parts[1].name, "b");
  EXPECT_NEAR(summary.parts[1].velocity_begin[0], -0.2, 1e-15);
  // A pair of parts, so one resultant; what it gives to A is the momentum that A has at the end.
  const auto contact = test::read_csv(one.result("contact.csv"));
  EXPECT_EQ(contact.count("k.b_on_a.impulse_x"), 1U);
  EXPECT_TRUE(std::none_of(contact.begin(), contact.end(),
                           [](const auto& column) { return column.first.find("a_on_a") != std::string::npos; }));
  const FrameFile frame((one.results() / "fields/step_000000.vtkhdf").string());
  const StoredArray* part_of_cell = frame.cell_field("part");
  ASSERT_NE(part_of_cell, nullptr);
  for (std::size_t k = 0; k < 26; ++k) EXPECT_EQ(part_of_cell->at(k), k < 13 ? 0.0 : 1.0) << k;
  const double impulse = last_row(one.result("contact.csv")).at("k.b_on_a.impulse_x");
  EXPECT_LT(impulse, -0.1);  // they have met
  const Simulation simulation(parse_case(mesh + part("a", "A") + part("b", "B") + rest + impact, "case.toml"));
  EXPECT_EQ(simulation.model().part_numbers(), (std::vector<Index>{0, 0, 1, 1}));
  const std::string text = check_summary(simulation);
  EXPECT_NE(text.find("\"a\": 13 cells, mass 4.5 kg"), std::string::npos) << text;
  EXPECT_EQ(text.find("1 cell,"), std::string::npos) << text;
}

}  // namespace
}  // namespace carom::run_mixed_cells_test
