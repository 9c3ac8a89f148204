// Deformable parts that share nodes with rigid bodies, and nodes that are joined to them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "march/march.hpp"
#include "math/vec3.hpp"
#include "model/turning_body.hpp"
#include "run_fixture.hpp"

namespace carom::run_joined_bodies_test {
namespace {

using namespace test;

const TurningBody& body_of(const Simulation& simulation) {
  return simulation.model().turning_bodies.front();
}

/// A bar of 6 x 1 x 1 cells whose first three are "HARD" and share their nodes with the others, "SOFT".
class JoinedBar {
 public:
  explicit JoinedBar(const std::string& rest, const std::string& rigid = "parts = [\"hard\"]\n") {
    static int count = 0;
    mesh_ = std::filesystem::temp_directory_path() / ("carom_joined_" + std::to_string(count++) + ".msh");
    constexpr int n = 6;
    const auto node = [](int i, int j, int k) { return 1 + i + (n + 1) * (j + 2 * k); };
    std::ostringstream text;
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"HARD\"\n3 2 \"SOFT\"\n$EndPhysicalNames\n"
         << "$Nodes\n"
         << 4 * (n + 1) << "\n";
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i <= n; ++i) text << node(i, j, k) << " " << i << " " << j << " " << k << "\n";
    text << "$EndNodes\n$Elements\n" << n << "\n";
    for (int i = 0; i < n; ++i) {
      const int group = i < 3 ? 1 : 2;
      text << i + 1 << " 5 2 " << group << " " << group;
      for (const int up : {0, 1})
        text << " " << node(i, 0, up) << " " << node(i + 1, 0, up) << " " << node(i + 1, 1, up) << " "
             << node(i, 1, up);
      text << "\n";
    }
    text << "$EndElements\n";
    std::ofstream(mesh_) << text.str();
    std::string given = "units = \"SI\"\n[mesh]\nfile = \"" + mesh_.string() +
                        "\"\n[materials.m]\nlaw = \"neo_hookean\"\nE = 100.0\nnu = 0.3\nrho = 1.0\n";
    for (const std::string part : {"hard", "soft"})
      given += "[[part]]\nname = \"" + part + "\"\ncells = \"" + (part == "hard" ? "HARD" : "SOFT") +
               "\"\nmaterial = \"m\"\n";
    given += "[[rigid_body]]\nname = \"end\"\n" + rigid;
    simulation_ = std::make_unique<Simulation>(parse_case(given + rest, "case.toml"));
  }
  const Simulation& simulation() const { return *simulation_; }

 private:
  std::filesystem::path mesh_;
  std::unique_ptr<Simulation> simulation_;
};

// Nodes that a deformable part shares with the body hold to it, in explicit and implicit steps; the bar as a whole
// keeps its momenta to rounding.
TEST(JoinedBodies, HoldWhatSharesTheirNodes) {
  for (const std::string scheme : {"kind = \"central_differences\"\n[time]\nend = 4.0\n",
                                   "kind = \"generalized_alpha\"\n[time]\nend = 4.0\nstep = 0.02\n",
                                   "kind = \"hulbert_chung\"\n[time]\nend = 4.0\n"}) {
    SCOPED_TRACE(scheme);
    const JoinedBar bar(
        "[[initial]]\npart = \"soft\"\nvelocity_field = [\"0.1 * (x - 3)\", \"0\", \"0.2 * (x - 3)\"]\n" +
        ("[scheme]\n" + scheme));
    const Simulation& s = bar.simulation();
    EXPECT_EQ(s.model().embedding.followers().size(), 12U);
    EXPECT_EQ(s.model().equations.size(), 12U);
    March march(s);
    march.start();
    const Momentum before = march.ledger().momentum();
    double apart = 0.0, moved = 0.0;
    while (!march.at_end()) {
      march.step();
      ASSERT_FALSE(march.has_failed()) << march.message();
      for (std::size_t n = 0; n < s.mesh().node_count(); ++n) {
        if (s.mesh().coordinates[n] != Vec3{3.0, 0.0, 0.0}) continue;
        const std::array<double, 4> N = corner_weights(body_of(s), s.mesh().coordinates[n]);
        Vec3 off = vector_at(march.state().q, n);
        moved = std::max(moved, norm(off));
        for (std::size_t a = 0; a < 4; ++a)
          off = subtract(off, scaled(vector_at(march.state().q, static_cast<std::size_t>(body_of(s).nodes[a])), N[a]));
        apart = std::max(apart, norm(off));
      }
      EXPECT_LE(std::abs(march.ledger().imbalance()), 1e-10 * 0.3);
    }
    EXPECT_GT(moved, 0.1);
    EXPECT_LE(apart, 1e-10);
    EXPECT_LE(norm(subtract(march.ledger().momentum().linear, before.linear)), 1e-10);
  }
}

// A body without cells has the mass that is given, at the nodes that it joins: the bar's soft part swings as one piece
// with it, and a force on one of its nodes moves all of the mass.
TEST(JoinedBodies, JoinNodesToAMassOfTheirOwn) {
  const JoinedBar bar(
      "[[load]]\nforce = [0.0, 0.0, 1.0]\ngroup = \"SOFT\"\n[scheme]\nkind = "
      "\"central_differences\"\n[time]\nend = 0.5\n",
      "nodes = \"SOFT\"\nmass = 13.0\ninertia = [4.0, 5.0, 6.0]\ncentre_of_mass = [4.5, 0.5, 0.5]\n");
  const Simulation& s = bar.simulation();
  EXPECT_TRUE(s.model().embedding.empty());
  EXPECT_EQ(s.model().equations.size(), 3U * 16U);
  March march(s);
  march.start();
  while (!march.at_end()) march.step();
  EXPECT_FALSE(march.has_failed()) << march.message();
  EXPECT_NEAR(march.ledger().momentum().linear[2], 16.0 * 0.5, 1e-11);  // impulse of the forces
  EXPECT_LE(std::abs(march.ledger().imbalance()), 1e-10);
  const TurningBody& body = body_of(s);
  for (const LinearEquation& equation : s.model().equations) {
    const auto n = static_cast<std::size_t>(equation.terms.front().node);
    const std::array<double, 4> N = corner_weights(body, s.mesh().coordinates[n]);
    Vec3 off = vector_at(march.state().q, n);
    EXPECT_GT(norm(off), 0.01);
    for (std::size_t a = 0; a < 4; ++a)
      off = subtract(off, scaled(vector_at(march.state().q, static_cast<std::size_t>(body.nodes[a])), N[a]));
    EXPECT_LE(norm(off), 1e-12);  // rounding of some hundred steps
  }
}

/// A block of mass 1 with a node of no cell, "REF", at (0.5, 0.5, 3), and two nodes of another block, "TIED".
std::string with_points(const std::string& rest, const std::string& more = "points = \"REF\"\n") {
  const std::filesystem::path mesh = std::filesystem::path(testing::TempDir()) / "rigid_points.msh";
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n3 1 \"BLOCK\"\n3 2 \"OTHER\"\n0 3 \"REF\"\n0 4 "
          "\"TIED\"\n$EndPhysicalNames\n$Nodes\n17\n";
  for (int k = 0; k < 16; ++k)
    text << k + 1 << " " << ((k % 4 == 1 || k % 4 == 2) ? 1 : 0) + 5 * (k / 8) << " " << (k % 4) / 2 << " "
         << (k / 4) % 2 << "\n";
  text << "17 0.5 0.5 3\n$EndNodes\n$Elements\n5\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 5 2 2 2 9 10 11 12 13 14 15 16\n"
          "3 15 2 3 3 17\n4 15 2 4 4 9\n5 15 2 4 4 12\n$EndElements\n";
  std::ofstream(mesh) << text.str();
  return "units = \"SI\"\n[mesh]\nfile = \"" + mesh.string() +
         "\"\n[materials.m]\nlaw = \"neo_hookean\"\nE = 100.0\nnu = 0.3\nrho = 1.0\n[[part]]\nname = \"block\"\n"
         "cells = \"BLOCK\"\nmaterial = \"m\"\n[[part]]\nname = \"other\"\ncells = \"OTHER\"\nmaterial = \"m\"\n"
         "[[rigid_body]]\nname = \"block\"\nparts = [\"block\"]\n" +
         more + rest + "[scheme]\nkind = \"central_differences\"\n[time]\nend = 0.1\n";
}

// A force at a point beside the body: a = F / m, alpha = I^-1 r x F with r = (0, 0, 2.5) and I = 1/6; in a time in
// which the body hardly turns. The point is where the body has it.
TEST(JoinedBodies, CarryPointsAtWhichForcesAct) {
  const Simulation s(parse_case(with_points("[[load]]\nforce = [1.0e-3, 0.0, 0.0]\ngroup = \"REF\"\n"), "case.toml"));
  March march(s);
  march.start();
  while (!march.at_end()) march.step();
  ASSERT_FALSE(march.has_failed()) << march.message();
  const Vec3 linear = march.ledger().momentum().linear, angular = march.ledger().momentum().angular;
  EXPECT_NEAR(linear[0], 1e-4, 1e-16);
  EXPECT_NEAR(angular[1], 3.0 * 1e-4, 1e-12);  // about the origin: z F
  EXPECT_LE(std::abs(march.ledger().imbalance()), 1e-14);
  const std::array<double, 4> N = corner_weights(body_of(s), {0.5, 0.5, 3.0});
  Vec3 due{};
  for (std::size_t a = 0; a < 4; ++a)
    due = add(due, scaled(vector_at(march.state().q, static_cast<std::size_t>(body_of(s).nodes[a])), N[a]));
  const auto at =
      static_cast<std::size_t>(std::ranges::find(s.mesh().node_numbers, 17) - s.mesh().node_numbers.begin());
  EXPECT_GT(due[0], 1e-5);
  EXPECT_LE(norm(subtract(vector_at(march.state().q, at), due)), 1e-18);
}

// What is said of all nodes of its cells is said of what hangs on them, too.
TEST(JoinedBodies, TakeTheirPointsAndJoinedNodesAlong) {
  const std::string more = "points = \"REF\"\nnodes = \"TIED\"\n";
  const Simulation s(
      parse_case(with_points("[[support]]\nnodes = \"BLOCK\"\nblocked = [\"x\", \"y\"]\nvelocity = { z = "
                             "1.0 }\n[[initial]]\nnodes = \"BLOCK\"\nvelocity = [0.0, 0.0, 1.0]\n",
                             more),
                 "case.toml"));
  March march(s);
  march.start();
  while (!march.at_end()) march.step();
  const std::vector<std::int64_t>& numbers = s.mesh().node_numbers;
  for (const std::int64_t number : {1, 9, 12, 17}) {
    const auto n = static_cast<std::size_t>(std::ranges::find(numbers, number) - numbers.begin());
    EXPECT_NEAR(march.state().q[3 * n + 2], 0.1, 1e-12) << number;
  }
  const auto says = [&](const std::string& rest, const std::string& part, const std::string& own) {
    const std::string message = case_error(with_points(rest, own)).what();
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  says("[[support]]\nnodes = \"REF\"\nblocked = [\"x\"]\n", "1 of the 11 nodes of rigid body \"block\" in \"REF\"",
       more);
  says("[[support]]\nnodes = \"TIED\"\nblocked = [\"x\"]\n", "2 of the 11 nodes of rigid body", more);
  says("[[initial]]\nnodes = \"REF\"\nvelocity = [1.0, 0.0, 0.0]\n", "0 of the 8 nodes of rigid body", more);
  says("", "rigid_body.points: found node 9 of \"TIED\", which a part holds", "points = \"TIED\"\n");
}

}  // namespace
}  // namespace carom::run_joined_bodies_test
