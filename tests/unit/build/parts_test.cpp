// Parts of plane cells and bars: what is held, what surfaces are, what is refused.
#include "build/parts.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "build/build_mesh.hpp"
#include "build/build_model.hpp"
#include "cell_meshes.hpp"
#include "mesh/deck_elements.hpp"
#include "mesh/write_gmsh.hpp"
#include "run_fixture.hpp"
#include "solid/element_table.hpp"

namespace carom::run_parts_test {
namespace {

using namespace test;

const std::string strip = R"(
[[mesh.block]]
kind = "quad"
origin = [0.0, 1.0, 0.25]
size = [2.0, 3.0]
divisions = [2, 3]
groups = { cells = "STRIP", ymin = "FOOT", ymax = "HEAD" }
)";
const std::string bar = R"(
[[mesh.block]]
kind = "bar"
origin = [9.0, 0.0, 0.0]
end = [9.0, 0.0, 4.0]
divisions = 4
groups = { cells = "BAR", end = "TIP" }
)";
const std::string box = R"(
[[mesh.block]]
origin = [20.0, 0.0, 0.0]
size = [1.0, 1.0, 1.0]
divisions = [1, 1, 1]
groups = { cells = "BOX", zmin = "FLOOR" }
)";

std::string part(const std::string& name, const std::string& cells, const std::string& section) {
  return "[[part]]\nname = \"" + name + "\"\ncells = \"" + cells + "\"\nmaterial = \"m\"\n" + section + "\n";
}

const std::string plane_part = part("strip", "STRIP", "section = \"plane_stress\"\nthickness = 0.5");
const std::string bar_part = part("bar", "BAR", "section = \"bar\"\narea = 0.1");
const std::string box_part = part("box", "BOX", "");

/// Sections in one case; `law` of the only material.
std::string text_of(const std::string& sections, const std::string& law = "linear_elastic") {
  return sections + "[materials.m]\nlaw = \"" + law +
         "\"\nE = 2.0\nnu = 0.3\nrho = 1.5\n[scheme]\nkind = \"central_differences\"\n[time]\nend = 1.0\n";
}

Model model_of(const std::string& text) {
  const Case given = parse_case(text, "case.toml");
  return build_model(given, std::make_shared<const Mesh>(build_mesh(given)));
}

std::string message_of(const std::string& text) {
  try {
    model_of(text);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Parts, KeepSectionThicknessAreaAndLaw) {
  const Model model = model_of(text_of(strip + bar + box + plane_part + bar_part + box_part, "neo_hookean"));
  ASSERT_EQ(model.parts.size(), 3U);
  EXPECT_EQ(model.parts[0].type, CellType::quad4);
  EXPECT_EQ(model.parts[0].section, Section::plane_stress);
  EXPECT_EQ(model.parts[0].thickness, 0.5);
  EXPECT_EQ(model.parts[0].cells.size(), 6U);
  EXPECT_EQ(model.parts[1].type, CellType::line2);
  EXPECT_EQ(model.parts[1].section, Section::bar);
  EXPECT_EQ(model.parts[1].thickness, 0.1);
  EXPECT_EQ(model.parts[2].section, Section::solid);
  EXPECT_EQ(model.parts[2].material.law->name, "neo_hookean");
}

TEST(Parts, EachLawHasItsMaterial) {
  EXPECT_EQ(model_of(text_of(box + box_part)).parts[0].material.law->name, "linear_elastic");
  const Model finite = model_of(text_of(box + box_part, "st_venant_kirchhoff"));
  ASSERT_EQ(finite.parts[0].material.law->name, "st_venant_kirchhoff");
  EXPECT_EQ(finite.parts[0].material.value("E"), 2.0);
}

TEST(Parts, PlaneOnesAreHeldAlongZ) {
  const Model model = model_of(text_of(strip + bar + plane_part + bar_part));
  ASSERT_EQ(model.motions.size(), 1U);
  const PrescribedMotion& held = model.motions[0];
  EXPECT_EQ(held.name, "part \"strip\", which is plane_stress");
  EXPECT_EQ(held.component, 2);
  EXPECT_EQ(held.kind, MotionKind::velocity);
  EXPECT_EQ(held.function(0.5), 0.0);
  EXPECT_EQ(held.nodes, model.mesh->nodes_of("STRIP"));
}

TEST(Parts, AxisymmetricOnesAreHeldOnTheAxis) {
  const Model model = model_of(text_of(strip + part("ring", "STRIP", "section = \"axisymmetric\"")));
  ASSERT_EQ(model.motions.size(), 2U);
  EXPECT_EQ(model.motions[1].component, 0);
  EXPECT_EQ(model.motions[1].nodes, model.mesh->nodes_of("XMIN"));
}

TEST(Parts, SurfacesHaveTheSectionOfTheirPart) {
  const std::string pressures =
      "[[load]]\npressure = 1.0\ngroup = \"HEAD\"\n[[load]]\npressure = 1.0\ngroup = \"TIP\"\n"
      "[[load]]\npressure = 1.0\ngroup = \"FLOOR\"\n";
  const Model model = model_of(text_of(strip + bar + box + plane_part + bar_part + box_part + pressures));
  ASSERT_EQ(model.loads.size(), 3U);
  const auto surface = [&](std::size_t i) { return std::get<Pressure>(model.loads[i]).surface; };
  EXPECT_EQ(surface(0).section, Section::plane_stress);
  EXPECT_EQ(surface(0).thickness, 0.5);
  EXPECT_EQ(surface(0).facets.size(), 2U);
  EXPECT_EQ(surface(1).section, Section::bar);
  EXPECT_EQ(surface(1).thickness, 0.1);
  ASSERT_EQ(surface(1).facets.size(), 1U);
  EXPECT_EQ(surface(1).facets[0].size, 1);
  EXPECT_EQ(surface(2).section, Section::solid);
  ASSERT_EQ(surface(2).facets.size(), 1U);
  EXPECT_EQ(surface(2).facets[0].size, 4);
}

TEST(Parts, EveryMessage) {
  EXPECT_NE(
      message_of(text_of(strip + part("p", "STRIP", "")))
          .find("part.cells: found \"STRIP\", a group of QUAD4 cells; expected HEXA8, TETRA4, TETRA10, PENTA6, PYRA5, "
                "HEXA20, HEXA27, PENTA15, PYRA13 cells, since section = \"solid\""),
      std::string::npos);
  EXPECT_NE(message_of(text_of(box + part("p", "BOX", "section = \"plane_strain\"")))
                .find(" in \"BOX\"; expected QUAD4, TRIA3, QUAD8, TRIA6 cells, since section = \"plane_strain\""),
            std::string::npos);
  EXPECT_NE(message_of(text_of(bar + part("p", "TIP", "section = \"bar\"\narea = 1.0")))
                .find("found \"TIP\", a group of nodes; expected LINE2 cells, since section = \"bar\""),
            std::string::npos);
  // The outward normal of the floor points down.
  EXPECT_NE(message_of(text_of(box + part("p", "FLOOR", "section = \"plane_strain\"")))
                .find("(QUAD4) numbered clockwise or folded; expected counter-clockwise cells"),
            std::string::npos);
  EXPECT_NE(message_of(text_of(box + part("p", "XMIN", "section = \"plane_strain\"")))
                .find("(QUAD4) outside of the x-y plane; expected cells in a plane z = const"),
            std::string::npos);
  std::string left = strip;
  left.replace(left.find("[0.0, 1.0, 0.25]"), 16, "[-1.0, 1.0, 0.0]");
  EXPECT_NE(message_of(text_of(left + part("p", "STRIP", "section = \"axisymmetric\"")))
                .find("with node 1 at x = -1; expected x >= 0, since section = \"axisymmetric\""),
            std::string::npos);
  std::string second = strip;
  second.replace(second.find("STRIP"), 5, "OTHER");
  EXPECT_NE(message_of(text_of(strip + second + plane_part + part("other", "OTHER", "section = \"plane_strain\"") +
                               "[[load]]\npressure = 1.0\ngroup = \"HEAD\"\n"))
                .find("load.group: found pieces of part \"strip\" (plane_stress, thickness 0.5) and of part \"other\" "
                      "(plane_strain, thickness 1); expected a surface of one section and thickness"),
            std::string::npos);
  EXPECT_NE(message_of(text_of(strip + bar + bar_part + "[[load]]\npressure = 1.0\ngroup = \"HEAD\"\n"))
                .find("found the boundary of cell 5 (QUAD4), which belongs to no part; expected faces, edges or ends"),
            std::string::npos);
}

/// The formulation of a part of cells of second order that names none.
std::optional<Formulation> chosen(CellType type, const char* section, const std::string& material) {
  StructuredBlock block;
  block.kind = dimension(type) == 3 ? StructuredBlock::Kind::hexa : StructuredBlock::Kind::quad;
  block.size = {1.0, 1.0, 1.0};
  const std::string path = testing::TempDir() + "second_order.msh";
  std::ofstream(path) << gmsh_text(with_cells(make_structured_blocks({block}), type));
  const Case given =
      parse_case(fmt::format("units = \"SI\"\n[mesh]\nfile = \"{}\"\n[materials.m]\nE = 1.0e9\nrho = 1.0e3\n{}\n"
                             "[[part]]\nname = \"a\"\ncells = \"BLOCK\"\nmaterial = \"m\"\nsection = \"{}\"\n"
                             "[scheme]\nkind = \"newmark\"\n[time]\nend = 1.0\nstep = 0.1\n",
                             path, material, section),
                 "case.toml");
  return Simulation(given).model().parts[0].formulation;
}

TEST(Parts, CellsOfSecondOrderThatKeepTheirVolumeTakeMeanDilatation) {
  const std::string steel = "law = \"linear_elastic\"\nnu = 0.3", rubber = "law = \"neo_hookean\"\nnu = 0.49",
                    metal = "law = \"j2\"\nnu = 0.3\nyield_stress = 1.0e6";
  for (const auto& [type, section] : {std::pair{CellType::quad8, "plane_strain"},
                                      {CellType::quad8, "axisymmetric"},
                                      {CellType::hexa20, "solid"},
                                      {CellType::hexa27, "solid"},
                                      {CellType::penta15, "solid"},
                                      {CellType::pyra13, "solid"}}) {
    EXPECT_EQ(chosen(type, section, steel), std::nullopt);
    EXPECT_EQ(chosen(type, section, rubber), Formulation::mean_dilatation);
    EXPECT_EQ(chosen(type, section, metal), Formulation::mean_dilatation);
  }
  EXPECT_EQ(chosen(CellType::quad8, "plane_stress", metal), std::nullopt);  // thickness takes up the volume
  EXPECT_EQ(chosen(CellType::tria6, "plane_strain", metal), std::nullopt);  // has one mean alone
}

TEST(Parts, LinearTetrahedraAndTrianglesThatKeepTheirVolumeAreIntegratedAtTheirNodes) {
  const std::string steel = "law = \"linear_elastic\"\nnu = 0.3", rubber = "law = \"neo_hookean\"\nnu = 0.49",
                    metal = "law = \"j2\"\nnu = 0.3\nyield_stress = 1.0e6";
  for (const auto& [type, section] :
       {std::pair{CellType::tria3, "plane_strain"}, {CellType::tria3, "axisymmetric"}, {CellType::tetra4, "solid"}}) {
    EXPECT_EQ(chosen(type, section, steel), std::nullopt);
    EXPECT_EQ(chosen(type, section, rubber), Formulation::nodal);
    EXPECT_EQ(chosen(type, section, metal), Formulation::nodal);
  }
  EXPECT_EQ(chosen(CellType::tria3, "plane_stress", metal), std::nullopt);  // thickness takes up the volume
}

TEST(Parts, EveryFormulationOfADeckElementIsOneOfItsCells) {
  int reduced = 0;
  for (const DeckElementType& type : deck_element_types()) {
    if (type.formulation.empty()) continue;
    const auto rows = elements();
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const Element& row) {
      return row.type == type.type && name(row.section) == type.section && name(row.formulation) == type.formulation;
    })) << type.name;
    if (type.formulation == "reduced") ++reduced;
  }
  EXPECT_EQ(reduced, 11) << "C3D20R, CPE8R, CPS8R and CAX8R, those with temperatures, and three hybrid ones";
}

TEST(Parts, EveryDeckElementOfASectionIsACellOfIt) {
  for (const DeckElementType& type : deck_element_types())
    if (!type.section.empty()) {
      const auto rows = elements();
      EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const Element& row) {
        return row.type == type.type && name(row.section) == type.section;
      })) << type.name;
    }
}

/// So that a set of elements of several types can be one part with that formulation (translate/bodies.cpp).
TEST(Parts, AFormulationOfADeckElementIsNoneOfOtherCells) {
  for (const DeckElementType& with : deck_element_types())
    for (const DeckElementType& without : deck_element_types()) {
      if (with.formulation.empty() || !without.formulation.empty() || with.section != without.section ||
          with.type == without.type)
        continue;
      const auto rows = elements();
      EXPECT_TRUE(std::none_of(rows.begin(), rows.end(),
                               [&](const Element& row) {
                                 return row.type == without.type && name(row.section) == with.section &&
                                        name(row.formulation) == with.formulation;
                               }))
          << with.name << " and " << without.name;
    }
}

}  // namespace
}  // namespace carom::run_parts_test
