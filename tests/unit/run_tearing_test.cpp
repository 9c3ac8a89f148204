// Ties of cases that tear: what is refused, and what the results hold.
#include <gtest/gtest.h>

#include <string>

#include "run_fixture.hpp"
#include "solid/point_history.hpp"

namespace carom::run_tearing_test {
namespace {

using namespace test;

std::string blocks(const std::string& tie, const std::string& scheme = "newmark") {
  const std::string step = scheme == "newmark" || scheme == "energy_momentum" ? "step = 0.1\n" : "";
  return R"(units = "SI"
[[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [1, 2, 2]
groups = { cells = "LEFT", xmax = "LFACE", xmin = "START" }
[[mesh.block]]
origin = [1.0, 0.0, 0.0]
size = [1.0, 1.0, 1.0]
divisions = [1, 2, 2]
groups = { cells = "RIGHT", xmin = "RFACE", xmax = "END" }
[materials.any]
law = "linear_elastic"
E = 1.0
nu = 0.3
rho = 1.0
[[part]]
name = "left"
cells = "LEFT"
material = "any"
[[part]]
name = "right"
cells = "RIGHT"
material = "any"
[[contact]]
name = "glue"
kind = "tie"
group = "RFACE"
master = "LFACE"
)" + tie +
         "[scheme]\nkind = \"" + scheme + "\"\n[time]\nend = 0.2\n" + step;
}

const std::string tears = "normal_strength = 0.01\nnormal_fracture_energy = 1e-4\n";

TEST(CaseTearing, ThatCannotBeIsRefused) {
  const auto parsed = [](const std::string& text) { return parse_case(text, "case.toml"); };
  EXPECT_THROW(parsed(blocks("normal_strength = 0.01\n")), CaseError);
  EXPECT_THROW(parsed(blocks("shear_fracture_energy = 0.01\n")), CaseError);
  EXPECT_THROW(parsed(blocks("friction = 0.2\n")), CaseError);
  EXPECT_THROW(parsed(blocks(tears, "modified_mass")), CaseError);
  // 0.01^2 / (2 x 1e-4) = 0.5
  EXPECT_THROW(parsed(blocks(tears + "stiffness = 0.5\n")), CaseError);
  EXPECT_NO_THROW(parsed(blocks(tears + "stiffness = 0.51\n")));
  EXPECT_NE(std::string(case_error(blocks(tears, "energy_momentum")).what()).find("a tie that tears"),
            std::string::npos);
}

// Nodes that both surfaces have would hold for ever.
TEST(CaseTearing, OfSurfacesThatShareNodesIsRefused) {
  std::string text = blocks(tears);
  const auto replace = [&text](const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
  };
  replace("xmin = \"START\"", "ymin = \"SIDE\"");
  replace("group = \"RFACE\"", "group = \"SIDE\"");
  const std::string what = case_error(text).what();
  EXPECT_NE(what.find("3 nodes that both surfaces have"), std::string::npos) << what;
}

TEST(CaseTearing, IsAZoneAndAPair) {
  const Simulation s(parse_case(blocks(tears + "shear_strength = 0.02\nfriction = 0.25\n"), "case.toml"));
  ASSERT_EQ(s.model().cohesive.size(), 1U);
  const CohesiveZone& zone = s.model().cohesive[0];
  EXPECT_EQ(zone.law.shear_strength, 0.02);
  EXPECT_EQ(zone.law.shear_energy, 1e-4);
  EXPECT_EQ(zone.law.normal_strength, 0.01);
  EXPECT_EQ(zone.rows.size(), 9U);
  double area = 0.0;
  for (const CohesiveRow& row : zone.rows) area += row.area;
  EXPECT_NEAR(area, 1.0, 1e-15);
  const auto& pair = std::get<PairContact>(s.model().contacts[0]);
  EXPECT_EQ(pair.law.mu, 0.25);
  // Ten times M / h of a cell, M = (1 - nu) / ((1 + nu) (1 - 2 nu)) its modulus and h = 1; raised for S^2 / G = 4.
  EXPECT_NEAR(zone.law.stiffness, std::max(10.0 * 0.7 / (1.3 * 0.4), 5.0 * 4.0), 1e-12);
  EXPECT_EQ(history_size(s.solid()), 18U);
}

}  // namespace
}  // namespace carom::run_tearing_test
