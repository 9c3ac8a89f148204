// Ties of cases that tear: what is refused, and what the results hold.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "build/torn_ties.hpp"
#include "math/vec3.hpp"
#include "record/contact_resultants.hpp"
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

// The right block is carried away with the left one and moved by w against it, far below what tears: the glue pulls
// with -k w on the face of area 1, whose middle stands at (1, 1/2, 1/2) + carried + w.
TEST(CaseTearing, ForcesHaveTheirMomentWhereTheNodesAre) {
  const Simulation s(parse_case(blocks(tears), "case.toml"));
  const Vec3 carried{0.3, -0.2, 0.5}, w{1e-5, 2e-5, -3e-5};
  std::vector<double> u;
  for (std::size_t n = 0; n < s.mesh().node_count(); ++n) u.insert(u.end(), carried.begin(), carried.end());
  for (const Index n : s.mesh().nodes_of("RIGHT"))
    for (std::size_t c = 0; c < 3; ++c) u[3 * static_cast<std::size_t>(n) + c] += w[c];
  const ContactResultants resultants(s.model(), {std::nullopt});
  std::vector<ContactResultant> sums(1);
  resultants.add_cohesive(s.solid().cohesive(), u, initial_history(s.solid()), sums);
  const Vec3 force = scaled(w, -s.model().cohesive[0].law.stiffness),
             moment = cross(add({1.0, 0.5, 0.5}, add(carried, w)), force);
  EXPECT_LT(norm(subtract(sums[0].force, force)), 1e-12 * norm(force));
  EXPECT_LT(norm(subtract(sums[0].moment, moment)), 1e-12 * norm(moment));
}

// Nine rows remember two numbers each: a run with glue is no beginning of one that remembers nothing.
TEST(CaseTearing, WhatGlueRemembersIsTakenByTheSameGlueAlone) {
  const auto refusal = [&](const std::string& first, const std::string& then) {
    const TemporaryCase before(blocks(first));
    before.run();
    try {
      const Simulation s(
          parse_case(blocks(then) + "[initial_state]\nfrom = \"" + before.results().string() + "\"\n", "case.toml"));
    } catch (const CaseError& error) {
      return error.found();
    }
    return std::string();
  };
  EXPECT_EQ(refusal(tears, tears), "");
  EXPECT_NE(refusal(tears, "").find("whose points remember 18 numbers"), std::string::npos);
}

// A row sees the dofs at which its coefficients are not zero, whatever they are.
TEST(TornTies, LookAtTheDofsThatARowSees) {
  ConstraintRows rows;
  rows.add_row(0.0, {0, 0, 1}, {}, 1.0, {}, 0);
  rows.add_block(4, {Vec3{0, 0, 1}, Vec3{}, Vec3{}});
  rows.add_block(7, {Vec3{0, 1e-3, 0}, Vec3{}, Vec3{}});
  std::vector<std::size_t> seen;
  for (std::size_t dof = 0; dof < 30; ++dof)
    if (any_dof(rows, 0, [dof](std::size_t i) { return i == dof; })) seen.push_back(dof);
  EXPECT_EQ(seen, (std::vector<std::size_t>{3 * 4 + 2, 3 * 7 + 1}));
}

}  // namespace
}  // namespace carom::run_tearing_test
