// Cells of reduced integration that no neighbour holds.
#include "advise/lone_cells.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "advise/locking.hpp"
#include "cell_meshes.hpp"
#include "mesh/write_gmsh.hpp"
#include "run_fixture.hpp"

namespace carom::run_lone_cells_test {
namespace {

using namespace test;

/// What is said of a block of HEXA20, or of a rectangle of QUAD8 (no third division).
std::vector<std::string> warnings(std::array<int, 3> divisions, const char* formulation) {
  StructuredBlock block;
  const bool is_solid = divisions[2] > 0;
  block.kind = is_solid ? StructuredBlock::Kind::hexa : StructuredBlock::Kind::quad;
  for (std::size_t i = 0; i < 3; ++i) block.size[i] = divisions[i];
  block.divisions = divisions;
  const Mesh mesh = with_cells(make_structured_blocks({block}), is_solid ? CellType::hexa20 : CellType::quad8);
  const std::string path = testing::TempDir() + "lone_cells.msh";
  std::ofstream(path) << gmsh_text(mesh);
  const Case given = parse_case(fmt::format(R"(units = "SI"
[mesh]
file = "{}"
[materials.m]
law = "linear_elastic"
E = 1.0e9
nu = 0.3
rho = 1000.0
[[part]]
name = "block"
cells = "{}"
material = "m"
formulation = "{}"
{}
[scheme]
kind = "newmark"
[time]
end = 1.0
step = 0.1
)",
                                            path, "BLOCK", formulation, is_solid ? "" : "section = \"plane_strain\""),
                                "case.toml");
  const Simulation s(given);
  EXPECT_TRUE(locking_doubts(s).empty()) << "what is known of linear cells does not hold here";
  return lone_cell_warnings(s);
}

TEST(LoneCells, AreNamedWhereTheyAreReduced) {
  const auto column = warnings({4, 1, 1}, "reduced");
  ASSERT_EQ(column.size(), 1U);
  EXPECT_NE(column[0].find("\"block\": 4 of its 4 HEXA20 cells are alone"), std::string::npos) << column[0];
  EXPECT_EQ(warnings({1, 1, 0}, "reduced").size(), 1U);
}

TEST(LoneCells, AreNotWhereTheyHaveNeighboursOrAllTheirPoints) {
  EXPECT_TRUE(warnings({4, 2, 1}, "reduced").empty());
  EXPECT_TRUE(warnings({4, 1, 0}, "reduced").empty());
  EXPECT_TRUE(warnings({4, 1, 1}, "full").empty());
  EXPECT_TRUE(warnings({4, 1, 1}, "mean_dilatation").empty());
}

}  // namespace
}  // namespace carom::run_lone_cells_test
