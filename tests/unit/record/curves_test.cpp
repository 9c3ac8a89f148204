// What the curves of probes and contacts hold: reactions, section forces, filtered forces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "output/cfc_filter.hpp"
#include "record/recorder.hpp"
#include "run_fixture.hpp"

namespace carom::run_curves_test {
namespace {

using namespace test;

const std::string statics = "[scheme]\nkind = \"statics\"\n[time]\nend = 1.0\nstep = 1.0\n";
const std::string held_foot = "[[support]]\nnodes = \"FOOT\"\nblocked = [\"x\", \"y\", \"z\"]\n";

std::string probe(const std::string& name, const std::string& group, const std::string& quantities,
                  const std::string& rest = "") {
  return "[[probe]]\nname = \"" + name + "\"\ngroup = \"" + group + "\"\nquantities = [" + quantities + "]\n" + rest;
}

Columns probes_of(const std::string& rest) {
  const TemporaryCase one(case_of_block(rest));
  one.run();
  return read_csv(one.result("probes.csv"));
}

/// Mass 12 x 1.5 = 18; nine nodes of the head, each pushed by 1e-4 along x.
TEST(Reactions, BalanceTheLoadsOfABlockHeldAtItsFoot) {
  Columns c = probes_of(held_foot +
                        "[[load]]\ngravity = [0.0, 0.0, -0.002]\n"
                        "[[load]]\ngroup = \"HEAD\"\nforce = [0.0001, 0.0, 0.0]\n" +
                        probe("foot", "FOOT", "\"reaction\", \"reaction_moment\"") + statics);
  constexpr double rounding = 1e-13;
  EXPECT_NEAR(c["foot.reaction_x"].back(), -0.0009, rounding);
  EXPECT_NEAR(c["foot.reaction_y"].back(), 0.0, rounding);
  EXPECT_NEAR(c["foot.reaction_z"].back(), 18.0 * 0.002, rounding);
  // about the middle of the foot, 3 below the head; small displacements: weight and force act where they did
  EXPECT_NEAR(c["foot.reaction_moment_x"].back(), 0.0, rounding);
  EXPECT_NEAR(c["foot.reaction_moment_y"].back(), -3.0 * 0.0009, rounding);
  EXPECT_NEAR(c["foot.reaction_moment_z"].back(), 0.0, rounding);
}

/// Uniaxial stress: E A eps = 2 x 4 x 0.03 / 3.
TEST(Reactions, OfAMovedEndAreThatOfABar) {
  Columns c = probes_of(
      "[[support]]\nnodes = \"FOOT\"\nblocked = [\"z\"]\n"
      "[[support]]\nnodes = \"XMIN\"\nblocked = [\"x\"]\n[[support]]\nnodes = \"YMIN\"\nblocked = [\"y\"]\n"
      "[[support]]\nnodes = \"HEAD\"\ndisplacement = { z = 0.03, function = \"ramp\" }\n"
      "[functions.ramp]\ntime = [0.0, 1.0]\nvalue = [0.0, 1.0]\n" +
      probe("head", "HEAD", "\"reaction\"") + probe("foot", "FOOT", "\"reaction\"") + statics);
  EXPECT_NEAR(c["head.reaction_z"].back(), 0.08, 1e-12);
  EXPECT_NEAR(c["foot.reaction_z"].back(), -0.08, 1e-12);
}

TEST(Reactions, AreRefusedWhereNothingIsHeld) {
  const Simulation simulation(parse_case(case_of_block(held_foot + probe("a", "HEAD", "\"reaction\"") + statics), "a"));
  try {
    const RunTables tables(simulation);
    FAIL() << "not refused";
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("no node is held or moved"), std::string::npos) << e.what();
  }
}

/// A block that falls is held by its foot at once: over the run the impulse of the reaction and the weight is the
/// change of momentum. By the trapezoidal rule that is exact for Newmark's scheme of gamma = 1/2 and central
/// differences, whose velocities take the mean of both accelerations; the others weigh them otherwise, and the
/// difference is of the first order in the step, of which there are some hundred.
TEST(Reactions, GiveTheChangeOfMomentumInEveryScheme) {
  struct Of {
    const char* scheme;
    double tolerance;  ///< of the largest impulse
  };
  for (const Of& of :
       {Of{"kind = \"newmark\"\nbeta = 0.25\ngamma = 0.5\n", 1e-9}, Of{"kind = \"central_differences\"\n", 1e-9},
        Of{"kind = \"hht\"\nalpha = -0.1\n", 0.01}, Of{"kind = \"generalized_alpha\"\n", 0.01},
        Of{"kind = \"bathe\"\n", 0.01}, Of{"kind = \"moreau_jean\"\n", 0.02}, Of{"kind = \"energy_momentum\"\n", 0.02},
        Of{"kind = \"cd_lagrange\"\n", 0.02}, Of{"kind = \"hulbert_chung\"\n", 0.02}}) {
    const bool has_step = std::string(of.scheme).find("central") == std::string::npos;
    const TemporaryCase one(
        case_of_block("[[support]]\nnodes = \"FOOT\"\nblocked = [\"z\"]\n[[load]]\ngravity = [0.0, 0.0, -0.005]\n"
                      "[[initial]]\nnodes = \"all\"\nvelocity = [0.0, 0.0, -0.005]\n" +
                      probe("foot", "FOOT", "\"reaction\"") + "[scheme]\n" + of.scheme + "[time]\nend = 20.0\n" +
                      (has_step ? "step = 0.05\n" : "")));
    one.run();
    Columns p = read_csv(one.result("probes.csv")), e = read_csv(one.result("energy.csv"));
    const std::vector<double>&t = p["time"], &R = p["foot.reaction_z"], &momentum = e["momentum_z"];
    ASSERT_GT(t.size(), 20U) << of.scheme;
    double impulse = 0.0, largest = 0.0, worst = 0.0;
    for (std::size_t i = 1; i < t.size(); ++i) {
      impulse += 0.5 * (t[i] - t[i - 1]) * (R[i] + R[i - 1]);
      largest = std::max(largest, std::abs(impulse));
      worst = std::max(worst, std::abs(momentum[i] - momentum[0] - impulse + 18.0 * 0.005 * t[i]));
    }
    EXPECT_GT(largest, 18.0 * 0.005 * 15.0) << of.scheme;  // it bears the weight most of the time
    EXPECT_LT(worst, of.tolerance * largest) << of.scheme;
  }
}

/// A bar that hangs from z = 3: below z it weighs rho g A z. At the held end that is the reaction, and both sides of a
/// section agree.
TEST(SectionForces, OfAHangingBlockKnowTheWeightOfHeldNodes) {
  for (const std::string mass : {"consistent", "lumped"}) {
    Columns c = probes_of(
        "[[support]]\nnodes = \"HEAD\"\nblocked = [\"x\", \"y\", \"z\"]\n"
        "[[load]]\ngravity = [0.0, 0.0, -0.02]\n" +
        probe("head", "HEAD", "\"section_force\", \"reaction\"", "side = [0, 0, -1]\n") +
        probe("foot", "FOOT", "\"section_force\"", "side = [0, 0, 1]\n") +
        replaced(statics, "[time]", "mass = \"" + mass + "\"\n[time]"));
    EXPECT_NEAR(c["head.section_force_z"].back(), -18.0 * 0.02, 1e-12) << mass;
    EXPECT_NEAR(c["head.reaction_z"].back(), 18.0 * 0.02, 1e-12) << mass;
    EXPECT_NEAR(c["foot.section_force_z"].back(), 0.0, 1e-12) << mass;
  }
}

/// Ten bars of length 0.3 hang from z = 3, rho g A = 1.5 x 0.02 x 0.1.
const char* const hanging_bars = R"(units = "SI"
[[mesh.block]]
kind = "bar"
end = [0.0, 0.0, 3.0]
divisions = 10
points = { FOOT = [0.0, 0.0, 0.0], LOW = [0.0, 0.0, 0.3], MIDDLE = [0.0, 0.0, 1.5], HEAD = [0.0, 0.0, 3.0] }
[materials.soft]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "bar"
cells = "BLOCK"
material = "soft"
section = "bar"
area = 0.1
[[support]]
nodes = "BLOCK"
blocked = ["x", "y"]
[[load]]
gravity = [0.0, 0.0, -0.02]
)";

TEST(SectionForces, OfAHangingBarAreTheWeightBelow) {
  constexpr double weight = 1.5 * 0.02 * 0.1;  // of a length of 1
  for (const std::string mass : {"consistent", "lumped"}) {
    std::string text = hanging_bars + std::string("[[support]]\nnodes = \"HEAD\"\nblocked = [\"z\"]\n");
    for (const std::string group : {"LOW", "MIDDLE", "HEAD"}) {
      text += probe(group + ".below", group, "\"section_force\"", "side = [0, 0, -1]\n");
      if (group != "HEAD") text += probe(group + ".above", group, "\"section_force\"", "side = [0, 0, 1]\n");
    }
    const TemporaryCase one(text + replaced(statics, "[time]", "mass = \"" + mass + "\"\n[time]"));
    one.run();
    Columns c = read_csv(one.result("probes.csv"));
    EXPECT_NEAR(c["LOW.below.section_force_z"].back(), -weight * 0.3, 1e-14) << mass;
    EXPECT_NEAR(c["LOW.above.section_force_z"].back(), weight * 0.3, 1e-14) << mass;
    EXPECT_NEAR(c["MIDDLE.below.section_force_z"].back(), -weight * 1.5, 1e-14) << mass;
    EXPECT_NEAR(c["MIDDLE.above.section_force_z"].back(), weight * 1.5, 1e-14) << mass;
    EXPECT_NEAR(c["HEAD.below.section_force_z"].back(), -weight * 3.0, 1e-14) << mass;
  }
}

/// What falls freely bears nothing anywhere. Where all nodes are led by an acceleration of 0.5, nothing strains, and a
/// section bears the weight and inertia of its own share of the half of a cell.
TEST(SectionForces, KnowInertia) {
  for (const std::string mass : {"consistent", "lumped"}) {
    const std::string scheme =
        "[scheme]\nkind = \"newmark\"\nmass = \"" + mass + "\"\n[time]\nend = 0.1\nstep = 0.01\n";
    const std::string middle = probe("middle", "MIDDLE", "\"section_force\"", "side = [0, 0, -1]\n");
    const TemporaryCase falling(hanging_bars + middle + scheme);
    falling.run();
    EXPECT_NEAR(read_csv(falling.result("probes.csv"))["middle.section_force_z"].back(), 0.0, 1e-15) << mass;
    const TemporaryCase led(hanging_bars + std::string("[[support]]\nnodes = \"BLOCK\"\nacceleration = { z = 0.5 }\n") +
                            middle + scheme);
    led.run();
    EXPECT_NEAR(read_csv(led.result("probes.csv"))["middle.section_force_z"].back(), -0.1 * 1.5 * 0.15 * 0.52, 1e-15)
        << mass;
  }
}

TEST(FilteredForces, OfContactAreThoseOfTheTableThroughTheFilter) {
  const TemporaryCase one(
      case_of_block("[[initial]]\npart = \"body\"\nvelocity = [0.0, 0.0, -0.1]\n"
                    "[[contact]]\nname = \"floor\"\nkind = \"plane\"\ngroup = \"FOOT\"\npoint = [0.0, 0.0, 0.0]\n"
                    "normal = [0.0, 0.0, 1.0]\ncfc = 0.2\n"
                    "[scheme]\nkind = \"newmark\"\n[time]\nend = 10.0\nstep = 0.02\n"));
  one.run();
  Columns raw = read_csv(one.result("contact.csv"));
  Columns filtered = read_csv(one.result("contact_filtered.csv"));
  ASSERT_EQ(filtered["time"].size(), raw["time"].size());
  const std::vector<double> due = cfc_filter(raw["floor.force_z"], 0.02, 0.2);
  double difference = 0.0, change = 0.0;
  for (std::size_t i = 0; i < due.size(); ++i) {
    difference = std::max(difference, std::abs(filtered["floor.force_z"][i] - due[i]));
    change = std::max(change, std::abs(raw["floor.force_z"][i] - due[i]));
  }
  EXPECT_LT(difference, 1e-9);  // the times of the rows are rounded
  EXPECT_GT(change, 0.01);
  EXPECT_EQ(filtered.count("floor.moment_x"), 1U);
  EXPECT_EQ(filtered.count("floor.penetration"), 0U);
}

}  // namespace
}  // namespace carom::run_curves_test
