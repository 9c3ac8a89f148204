// What guides of free rigid bodies ask of the other keys.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "casefile/read_case.hpp"

namespace carom::casefile_guides_test {
namespace {

/// What is said of a sphere with these keys in a case whose scheme has this mass.
std::string message_of(const std::string& keys, const std::string& mass = "consistent") {
  try {
    parse_case(fmt::format(R"(units = "SI"
[mesh]
file = "block.msh"
[materials.steel]
law = "linear_elastic"
E = 1.0
nu = 0.3
rho = 1.0
[[part]]
name = "block"
cells = "BLOCK"
material = "steel"
[scheme]
kind = "newmark"
enforcement = "lagrange"
mass = "{}"
[time]
end = 1.0
step = 0.1
[[contact]]
name = "ball"
kind = "sphere"
group = "FOOT"
centre = [0.0, 0.0, 0.0]
radius = 1.0
{}
)",
                           mass, keys),
               "c.toml");
  } catch (const CaseError& e) {
    return e.what();
  }
  return "no error";
}

TEST(CaseGuides, AreOfFreeBodies) {
  EXPECT_EQ(message_of("mass = 1.0\nblocked = [\"x\", \"z\"]"), "no error");
  EXPECT_EQ(
      message_of("blocked = [\"x\"]"),
      "c.toml:26:11: contact[0].blocked: found blocked without a mass; expected the mass of a free body. Without a "
      "mass the obstacle rests, or moves by its velocity alone: remove blocked, or add mass.");
  EXPECT_EQ(message_of("mass = 1.0\nblocked_turns = [\"x\", \"y\"]"),
            "c.toml:27:17: contact[0].blocked_turns: found blocked_turns without an inertia; expected the inertia of a "
            "free body that turns. Add mass and inertia, or remove blocked_turns.");
}

TEST(CaseGuides, HoldAboutTwoAxesOrAll) {
  const std::string body = "mass = 1.0\ninertia = [1.0, 1.0, 1.0]\n";
  EXPECT_EQ(message_of(body + "blocked_turns = [\"x\", \"y\"]"), "no error");
  EXPECT_EQ(
      message_of(body + "blocked_turns = [\"x\"]"),
      "c.toml:28:17: contact[0].blocked_turns: found one axis alone; expected two axes, or all three. What is kept "
      "from turning about one axis while it turns about others has no axis of its own: block two for a hinge, all "
      "for a guide.");
  EXPECT_EQ(message_of(body + "blocked_at = [0.0, 0.0, 0.0]"),
            "c.toml:28:14: contact[0].blocked_at: found a point without axes along which it is held; expected blocked "
            "beside it. Add blocked, or remove blocked_at.");
}

// Without `inertia` the guide is a support of the one node, which every scheme knows.
TEST(CaseGuides, OfBodiesThatTurnNeedNodesThatKeepTheirMass) {
  EXPECT_EQ(message_of("mass = 1.0\nblocked = [\"x\"]", "modified"), "no error");
  EXPECT_EQ(
      message_of("mass = 1.0\ninertia = [1.0, 1.0, 1.0]\nblocked = [\"x\"]", "modified"),
      "c.toml:28:11: contact[0].blocked: found blocked of a body that turns, with mass = \"modified\"; expected a "
      "scheme whose nodes keep their mass. The guide is an equation: take another mass, or another scheme than "
      "modified_mass.");
}

}  // namespace
}  // namespace carom::casefile_guides_test
