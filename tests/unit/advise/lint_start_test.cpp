// Velocities at the start that contradict supports, each other or what they are to meet; runs far beyond an impact.
#include "advise/lint_start.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "advise/lint.hpp"
#include "advise/long_run.hpp"
#include "run_fixture.hpp"

namespace carom::advise_lint_start_test {
namespace {

using namespace test;
using Texts = std::vector<std::string>;

std::string scheme(const std::string& end = "1.0") {
  return "[scheme]\nkind = \"central_differences\"\n[time]\nend = " + end + "\n";
}

Texts warnings(const std::string& rest) {
  return start_warnings(Simulation(parse_case(case_of_block(rest + scheme()), "case.toml")));
}

/// The block stands on nothing; a slab of 4 x 4 x 1 below it, whose upper face is at z = -0.1.
const std::string slab =
    "[[mesh.block]]\norigin = [-1.0, -1.0, -1.1]\nsize = [4.0, 4.0, 1.0]\ndivisions = [4, 4, 1]\n"
    "groups = { cells = \"SLAB\", zmin = \"UNDER\", zmax = \"TOP\" }\n"
    "[[part]]\nname = \"slab\"\ncells = \"SLAB\"\nmaterial = \"soft\"\n"
    "[[contact]]\nname = \"touch\"\nkind = \"pair\"\ngroup = \"FOOT\"\nmaster = \"TOP\"\n";
const std::string held = "[[support]]\nnodes = \"UNDER\"\nblocked = [\"x\", \"y\", \"z\"]\n";

std::string thrown(const std::string& whom) {
  return "[[initial]]\n" + whom + "\nvelocity = [0.0, 0.0, -1.0]\n";
}

// The slab has 5 x 5 nodes on its underside and as many on top.
TEST(LintStart, NamesTheHeldPartOfAVelocityForAll) {
  const Texts found = warnings(slab + held + thrown("nodes = \"all\""));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(
      found[0].substr(found[0].find(": initial")),
      ": initial: nodes = \"all\" gives part \"slab\" a velocity along z that support[0] on UNDER (line 29) does not "
      "let 25 of its 50 nodes have, where it is overwritten; name what flies instead: part = \"body\"");
  EXPECT_EQ(warnings(slab + held + thrown("part = \"body\"")), Texts{});
  // A body alone that is stopped at its foot is a shock, and meant; supports across the velocity hold nothing of it.
  EXPECT_EQ(warnings("[[support]]\nnodes = \"FOOT\"\nblocked = [\"z\"]\n" + thrown("nodes = \"all\"")), Texts{});
  EXPECT_EQ(warnings(slab + "[[support]]\nnodes = \"UNDER\"\nblocked = [\"x\"]\n" + thrown("nodes = \"all\"")),
            Texts{});
  // What is led with the same velocity agrees with it.
  EXPECT_EQ(warnings(slab + "[[support]]\nnodes = \"UNDER\"\nvelocity = { z = -1.0 }\n" + thrown("nodes = \"all\"")),
            Texts{});
}

TEST(LintStart, NamesVelocitiesThatAreOverwritten) {
  const Texts found = warnings(thrown("part = \"body\"") + thrown("nodes = \"all\""));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].find("the velocity of part = \"body\" is without effect, since later sections (line 18)"),
            std::string::npos)
      << found[0];
  EXPECT_EQ(warnings(slab + thrown("nodes = \"all\"") + thrown("part = \"body\"")), Texts{});
}

const std::string floor_below =
    "[[contact]]\nname = \"floor\"\nkind = \"plane\"\ngroup = \"FOOT\"\npoint = [0.0, 0.0, -0.1]\nnormal = [0.0, 0.0, "
    "1.0]\n";

std::string gravity(const std::string& g) {
  return "[[load]]\ngravity = " + g + "\n";
}
std::string dropped(const std::string& height, const std::string& more = "") {
  return "[[initial]]\npart = \"body\"\ndrop_height = " + height + "\n" + more;
}

bool says(const Texts& found, const std::string& what) {
  return found.size() == 1 && found[0].find(what) != std::string::npos;
}

TEST(LintStart, NamesFallsThatMeetNothing) {
  const std::string nothing = "and none of the obstacles (\"floor\") ahead of what falls, and no other part";
  EXPECT_EQ(warnings(floor_below + gravity("[0.0, 0.0, -9.81]") + dropped("2.0")), Texts{});
  EXPECT_EQ(warnings(slab + held + gravity("[0.0, 0.0, -9.81]") + dropped("2.0")), Texts{});
  EXPECT_TRUE(says(warnings(floor_below + gravity("[0.0, 0.0, 9.81]") + dropped("2.0")), nothing));
  EXPECT_TRUE(says(warnings(floor_below + gravity("[9.81, 0.0, 0.0]") + dropped("2.0")), nothing));
  EXPECT_TRUE(says(warnings(slab + held + gravity("[9.81, 0.0, 0.0]") + dropped("2.0")),
                   "no obstacle and no other part ahead of what falls"));
  const std::string touching = replaced(slab, "-1.0, -1.0, -1.1", "-1.0, -1.0, -1.0") + held;
  EXPECT_EQ(warnings(touching + gravity("[0.0, 0.0, -9.81]") + dropped("2.0")), Texts{});
  for (const char* away : {"[9.81, 0.0, 0.0]", "[0.0, 0.0, 9.81]"})
    EXPECT_TRUE(says(warnings(touching + gravity(away) + dropped("2.0")), "no other part ahead of what falls")) << away;
  EXPECT_TRUE(says(warnings(gravity("[0.0, 0.0, -9.81]") + dropped("2.0")), "expected a floor there"));
  const auto ball = [&](const char* height) {
    return replaced(floor_below, "plane\"\ngroup = \"FOOT\"\npoint = [0.0, 0.0, -0.1]\nnormal = [0.0, 0.0, 1.0]",
                    std::string("sphere\"\ngroup = \"FOOT\"\nradius = 2.0\ncentre = [1.0, 1.0, ") + height + "]") +
           gravity("[0.0, 0.0, -9.81]") + dropped("2.0");
  };
  EXPECT_EQ(warnings(ball("-2.1")), Texts{});
  EXPECT_TRUE(says(warnings(ball("9.0")), nothing));
  // On its support it falls as a whole: a shock, where nothing is to be met.
  EXPECT_EQ(
      warnings(gravity("[0.0, 0.0, -9.81]") + dropped("2.0") + "[[support]]\nnodes = \"FOOT\"\nblocked = [\"z\"]\n"),
      Texts{});
}

// (2 x 9.81 x 2)^(1/2) = 6.264.
TEST(LintStart, NamesASpeedAlongGravityBesideAHeight) {
  const std::string fall = floor_below + gravity("[0.0, 0.0, -9.81]");
  EXPECT_TRUE(
      says(warnings(fall + dropped("2.0", "velocity = [0.0, 0.0, -6.0]\n")),
           "velocity has 6 m/s along gravity beside a drop_height of 2 m, which gives 6.264 m/s, and the two are "
           "added to 12.26 m/s"));
  EXPECT_EQ(warnings(fall + dropped("2.0", "velocity = [3.0, 0.0, 0.0]\n")), Texts{});
}

// The body's diagonal is (4 + 4 + 9)^(1/2) = 4.12; (2 x 9.81 x 1000)^(1/2) = 140.1.
TEST(LintStart, NamesHeightsThatNobodyDropsFrom) {
  const std::string fall = floor_below + gravity("[0.0, 0.0, -9.81]");
  EXPECT_TRUE(says(warnings(fall + dropped("1000.0")),
                   "a drop_height of 1000 m, 2.4e+02 times the size of what falls, gives 140.1 m/s; is it written in "
                   "another unit? Lengths of this case are in m, so that 1000 mm are 1"));
  EXPECT_EQ(warnings(fall + dropped("40.0")), Texts{});
  EXPECT_EQ(warnings(fall + dropped("400.0")), Texts{});  // less than 100 times its size
}

// Axial waves of (2 / 1.5)^(1/2) = 1.155 cross the 4.12 of the block 10,000 times in 35,700.
TEST(LongRun, IsNamedWhereNothingMakesItLast) {
  const auto is_long = [](const std::string& rest, const std::string& end) {
    return long_run_warning(Simulation(parse_case(case_of_block(rest + scheme(end)), "case.toml"))).has_value();
  };
  const std::string impact = floor_below + thrown("part = \"body\"");
  EXPECT_FALSE(is_long(impact, "3.5e4"));
  EXPECT_TRUE(is_long(impact, "3.7e4"));
  EXPECT_FALSE(is_long(thrown("part = \"body\""), "1e6"));                   // flies for ever
  EXPECT_FALSE(is_long(floor_below, "1e6"));                                 // settles
  EXPECT_FALSE(is_long(replaced(impact, "-1.0]\n", "-0.002]\n"), "3.7e4"));  // 18 lengths: slow
  EXPECT_FALSE(is_long(impact + gravity("[0.0, 0.0, -1e-4]"), "3.7e4"));     // 2 v / g = 2e4, twice
  EXPECT_TRUE(is_long(impact + gravity("[0.0, 0.0, -1e-3]"), "3.7e4"));      // 2 v / g = 2e3
  EXPECT_FALSE(is_long(impact + "[[spring]]\nnodes = \"HEAD\"\nstiffness = [0.0, 0.0, 1.0]\n", "1e6"));
  EXPECT_FALSE(is_long(impact + "[[support]]\nnodes = \"HEAD\"\nvelocity = { x = 1e-6 }\n", "1e6"));
  EXPECT_FALSE(is_long(floor_below + "[[initial]]\npart = \"body\"\nangular_velocity = [0.0, 0.0, 1.0]\n"
                                     "centre = [1.0, 1.0, 0.0]\nvelocity = [0.0, 0.0, -1.0]\n",
                       "1e6"));
}

}  // namespace
}  // namespace carom::advise_lint_start_test
