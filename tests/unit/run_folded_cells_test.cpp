// Cells that fold at a corner: which one, by how much, and what a run says of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "run/folded_cells.hpp"
#include "run_fixture.hpp"

namespace carom::run_folded_cells_test {
namespace {

using namespace test;

// A corner of a block of unit cubes goes along its edge past the next node, to 1.5: the edge from it has the length
// -0.5.
TEST(FoldedCells, TheFlattestCornerIsThatOfTheNodeThatWentThrough) {
  const Case given = parse_case(case_of_block("[scheme]\nkind = \"newmark\"\n[time]\nend = 1.0\nstep = 1.0\n"), "c");
  const Simulation s(given);
  std::vector<double> u(s.solid().dof_count(), 0.0);
  EXPECT_EQ(flattest_corner(s, u).cell, -1);
  const auto& X = s.mesh().coordinates;
  const auto corner = static_cast<std::size_t>(std::find(X.begin(), X.end(), Vec3{0, 0, 0}) - X.begin());
  for (const double way : {0.75, 1.5}) {
    u[3 * corner] = way;
    const FlattestCorner flattest = flattest_corner(s, u);
    EXPECT_NEAR(flattest.share, 1.0 - way, 1e-15);
    EXPECT_EQ(flattest.is_folded(), way > 1.0);
    const auto nodes = s.solid().nodes_of_cell(static_cast<std::size_t>(flattest.cell));
    EXPECT_NE(std::find(nodes.begin(), nodes.end(), static_cast<Index>(corner)), nodes.end());
  }
  EXPECT_NE(describe_fold(s, flattest_corner(s, u), u)
                .find("of part \"body\" at (0.6875, 0.5, 0.5) has folded: its "
                      "volume at a corner is -0.5 of that at rest"),
            std::string::npos)
      << describe_fold(s, flattest_corner(s, u), u);
}

/// Two unit squares, held at the left and at their upper right corner, whose lower right corner is pushed up past it.
/// The mean volume stays positive: one point sees nothing.
std::string squares(const char* part, double way) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
kind = "quad"
size = [2.0, 1.0]
divisions = [2, 1]
groups = {{ cells = "BODY", xmin = "ROOT" }}
points = {{ TIP = [2.0, 0.0, 0.0], TOP = [2.0, 1.0, 0.0] }}
[materials.m]
law = "neo_hookean"
E = 100.0
nu = 0.3
rho = 1.0
[[part]]
name = "body"
cells = "BODY"
material = "m"
section = "plane_strain"
{}
[[support]]
nodes = "ROOT"
blocked = ["x", "y"]
[[support]]
nodes = "TOP"
blocked = ["x", "y"]
[[support]]
nodes = "TIP"
blocked = ["x"]
[support.displacement]
y = {}
function = "push"
[functions.push]
time = [0.0, 10.0]
value = [0.0, 1.0]
[guards]
energy_growth = 1e9
[scheme]
kind = "central_differences"
[time]
end = 10.0
)",
                     part, way);
}

TEST(FoldedCells, ARunNamesTheFirstWithWhatHelpsItsFormulation) {
  const TemporaryCase folding(squares("formulation = \"one_point\"", 1.2));
  folding.run();
  const std::string summary = folding.result("summary.json");
  EXPECT_NE(summary.find("cell 2 of part \\\"body\\\""), std::string::npos) << summary;
  EXPECT_NE(summary.find("has folded"), std::string::npos);
  EXPECT_NE(summary.find("leave the formulation out"), std::string::npos);
  EXPECT_NE(summary.find("\"a cell has folded\""), std::string::npos) << "a doubt of its own";
  const TemporaryCase bending(squares("formulation = \"one_point\"", 0.3));
  bending.run();
  EXPECT_EQ(bending.result("summary.json").find("has folded"), std::string::npos);
}

}  // namespace
}  // namespace carom::run_folded_cells_test
