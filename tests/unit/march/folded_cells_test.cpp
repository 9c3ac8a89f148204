// Cells that fold at a corner: which one, by how much, and what a run says of it.
#include "march/folded_cells.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

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
    const auto nodes = s.solid().cells().nodes_of(static_cast<std::size_t>(flattest.cell));
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

// A law of small strain goes on with whatever its cells have become: that is not good, neither with a fold nor with
// half of a corner's volume gone.
TEST(FoldedCells, OfSmallStrainFailTheVerdict) {
  const auto pushed = [](double way) {
    std::string text = replaced(squares("", way), "neo_hookean", "linear_elastic");
    text =
        replaced(text, "energy_growth = 1e9", "energy_growth = 1e9\nrotation_warning = 300.0\nrotation_stop = 400.0");
    const TemporaryCase run(text);
    run.run();
    return run.result("summary.json");
  };
  for (const double way : {0.7, 1.2}) {
    const std::string summary = pushed(way);
    EXPECT_NE(summary.find("\"outcome\": \"failed\""), std::string::npos) << summary;
    EXPECT_NE(summary.find("(not small strain)"), std::string::npos) << summary;
    EXPECT_EQ(summary.find("a cell has folded") == std::string::npos, way < 1.0);
  }
  EXPECT_NE(pushed(0.1).find("\"outcome\": \"good\""), std::string::npos);
}

TEST(FoldedCells, DistortionControlThatNeverActsChangesNoBit) {
  const TemporaryCase plain(squares("", 0.3)), controlled(squares("distortion_control = 0.1", 0.3));
  plain.run();
  controlled.run();
  EXPECT_EQ(plain.result("energy.csv"), controlled.result("energy.csv"));
}

/// A cube between plates that hold it, of n x n x n cells, pressed together at a speed.
struct Crush {
  int n = 4;
  double nu = 0.499, speed = 0.5;
  const char* scheme = "kind = \"statics\"\n[time]\nend = 1.0\nstep = 0.02";

  std::string text(const std::string& part) const {
    return fmt::format(R"(units = "SI"
[[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [{0}, {0}, {0}]
groups = {{ cells = "BODY", zmin = "LOW", zmax = "HIGH" }}
[materials.m]
law = "neo_hookean"
E = 1.0e6
nu = {1}
rho = 1000.0
[[part]]
name = "block"
cells = "BODY"
material = "m"
{3}
[[support]]
nodes = "LOW"
blocked = ["x", "y", "z"]
[[support]]
nodes = "HIGH"
blocked = ["x", "y"]
displacement = {{ z = -{2}, function = "ramp" }}
[functions.ramp]
time = [0.0, 1.0]
value = [0.0, 1.0]
[scheme]
{4}
)",
                       n, nu, speed, part, scheme);
  }
};

/// That cells of the block fold, but not with distortion control, which stores little and leaves the books closed.
void expect_kept(const Crush& crush, const std::string& part) {
  SCOPED_TRACE(part + crush.scheme);
  const TemporaryCase folding(crush.text(part));
  folding.run();
  EXPECT_NE(folding.result("summary.json").find("has folded"), std::string::npos);
  const TemporaryCase kept(crush.text(part + "distortion_control = 0.1"));
  kept.run();
  EXPECT_NE(kept.result("summary.json").find("\"outcome\": \"good\""), std::string::npos);
  const auto energies = last_row(kept.result("energy.csv"));
  EXPECT_GT(energies.at("distortion"), 0.0);
  EXPECT_LT(energies.at("distortion"), 0.03 * energies.at("strain")) << "at the rim alone";
}

TEST(FoldedCells, DistortionControlKeepsThemFromFolding) {
  expect_kept({}, "");
  expect_kept({.nu = 0.3, .speed = 0.8}, "");
  const char* explicit_steps = "kind = \"central_differences\"\n[time]\nend = 0.1";
  for (const char* formulation : {"one_point", "mean_dilatation"})
    expect_kept({3, 0.3, 7.5, explicit_steps}, fmt::format("formulation = \"{}\"\n", formulation));
}

TEST(FoldedCells, DistortionControlIsRefusedWhereItCannotAct) {
  const auto refusal = [](const std::string& text) { return std::string(case_error(text).what()); };
  const std::string controlled = case_of_block(
      "distortion_control = 0.1\n[scheme]\nkind = \"newmark\"\n"
      "[time]\nend = 1.0\nstep = 1.0\n");
  EXPECT_NE(refusal(controlled).find("linear_elastic\" of small strain"), std::string::npos) << refusal(controlled);
  const std::string finite = replaced(controlled, "linear_elastic", "neo_hookean");
  const Simulation accepted(parse_case(finite, "c"));
  const std::string conserving = replaced(finite, "newmark", "energy_momentum");
  EXPECT_NE(refusal(conserving).find("\"energy_momentum\" with distortion_control of the part \"body\""),
            std::string::npos)
      << refusal(conserving);
  EXPECT_THROW(parse_case(replaced(finite, "distortion_control = 0.1", "distortion_control = 1.0"), "c"), CaseError);
}

}  // namespace
}  // namespace carom::run_folded_cells_test
