// What a case is warned of before it runs.
#include "advise/lint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "advise/approach.hpp"
#include "advise/cost_estimate.hpp"
#include "build/facing.hpp"
#include "record/recorder.hpp"
#include "run_fixture.hpp"

namespace carom::run_lint_test {
namespace {

using namespace test;

const std::string central_differences = "[scheme]\nkind = \"central_differences\"\n[time]\nend = 1.0\n";

std::string moving(double speed) {
  return "[[initial]]\npart = \"body\"\nvelocity = [0.0, 0.0, " + std::to_string(speed) + "]\n";
}

/// A second body of the same material, its lower face at the given height.
std::string second_body(double height) {
  return "[[mesh.block]]\norigin = [0.0, 0.0, " + std::to_string(height) +
         "]\nsize = [2.0, 2.0, 1.0]\ndivisions = [1, 1, 1]\ngroups = { cells = \"OTHER\", zmin = \"UNDER\" }\n"
         "[[part]]\nname = \"other\"\ncells = \"OTHER\"\nmaterial = \"soft\"\n"
         "[[contact]]\nname = \"touch\"\nkind = \"pair\"\ngroup = \"HEAD\"\nmaster = \"UNDER\"\n";
}

/// A rigid sheet of one facet whose normal is along z.
std::string sheet(double height, const std::string& group) {
  return "[[mesh.block]]\nkind = \"quad\"\norigin = [-1.0, -1.0, " + std::to_string(height) +
         "]\nsize = [4.0, 4.0]\ndivisions = [1, 1]\ngroups = { cells = \"SHEET\" }\n"
         "[[contact]]\nname = \"sheet\"\nkind = \"surface\"\nsurface = \"SHEET\"\ngroup = \"" +
         group + "\"\n";
}

bool is_warned(const std::string& rest, const std::string& what) {
  const Case given = parse_case(case_of_block(rest + central_differences), "case.toml");
  const std::vector<std::string> warnings = lint_warnings(Simulation(given));
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& w) { return w.find(what) != std::string::npos; });
}

TEST(Lint, SaysWhenNothingMovesTowardsAContact) {
  const std::string what = "nothing moves towards it";
  // Surfaces 0.5 apart have rows, those 5 apart have none: both are judged.
  for (const double height : {3.5, 8.0}) {
    EXPECT_FALSE(is_warned(second_body(height) + moving(1.0), what)) << height;
    EXPECT_TRUE(is_warned(second_body(height) + moving(-1.0), what)) << height;
    EXPECT_TRUE(is_warned(second_body(height), what)) << height;
  }
}

// Faces of 1 x 1: a ball of 0.5 passes between their nodes, which are 2^(1/2) / 2 from the middle; one of 0.9 sinks
// into it by 0.9 - (0.81 - 0.5)^(1/2) = 0.343, one of 2 by 0.13, an eighth of a cell. A cylinder of 0.6 along an edge
// sinks by 0.6 - (0.36 - 0.25)^(1/2) = 0.268. In a hollow nodes are the deepest themselves.
TEST(Lint, SaysHowDeepARoundObstacleSinksIntoAFace) {
  const auto below = [](const std::string& shape) {
    return "[[contact]]\nname = \"round\"\ngroup = \"FOOT\"\n" + shape + moving(-1.0);
  };
  const auto ball = [&](const char* radius, const char* inside) {
    return below(std::string("kind = \"sphere\"\ncentre = [1.0, 1.0, -3.0]\nradius = ") + radius + "\n" + inside);
  };
  const std::string passes = "passes between their nodes", sinks = "sinks by up to";
  EXPECT_TRUE(is_warned(ball("0.5", ""), passes));
  EXPECT_TRUE(is_warned(ball("0.9", ""), sinks + " 0.34"));
  const std::string cylinder = "kind = \"cylinder\"\npoint = [0.0, 1.0, -3.0]\naxis = [2.0, 0.0, 0.0]\nradius = 0.6\n";
  EXPECT_TRUE(is_warned(below(cylinder), sinks + " 0.27"));
  for (const std::string& what : {passes, sinks}) {
    EXPECT_FALSE(is_warned(ball("2.0", ""), what));
    EXPECT_FALSE(is_warned(ball("9.0", "inside = true\n"), what));
  }
}

// The wave presses with rho c v = 1.5 x 1.34 x 0.1 = 0.2, half of the first of the pressures, 0.4 at a depth of 0.04: a
// depth of 0.02, with a slope of 10. That of the last piece, (1e6 - 0.4) / 0.96, is never reached: it bounds the step,
// and says nothing of what a cell of modulus 2.7 feels. A foot has nodes of a quarter of the face and of a cell.
TEST(Lint, JudgesALawOfPressureByTheDepthsThatAreReached) {
  const auto floor = [](const std::string& law) {
    return "[[contact]]\nname = \"floor\"\nkind = \"plane\"\ngroup = \"FOOT\"\npoint = [0.0, 0.0, 0.0]\n"
           "normal = [0.0, 0.0, 1.0]\n" +
           law + moving(-0.1);
  };
  const std::string steep = floor("depths = [0.04, 1.0]\npressures = [0.4, 1e6]\n");
  EXPECT_TRUE(is_warned(steep, "the steepest piece of its pressures makes the explicit step"));
  EXPECT_TRUE(is_warned(steep, "impact at 0.1 will reach a depth of about 0.02 alone"));
  EXPECT_FALSE(is_warned(steep, "times stiffer than a cell"));
  EXPECT_TRUE(is_warned(floor("depths = [0.04, 1.0]\npressures = [40.0, 1e6]\n"), "times stiffer than a cell"));
  EXPECT_TRUE(is_warned(floor("depths = [0.04, 1.0]\npressures = [0.04, 0.4]\n"),
                        "is soft: impact at 0.1 will penetrate by about 0.46"));
  EXPECT_TRUE(
      is_warned(floor("depths = [0.04, 1.0]\npressures = [0.1, 0.1]\n"), "more than the last of its pressures"));
}

/// Waves of speed sqrt(2 x 0.7 / (1.3 x 0.4) / 1.5) = 1.34 cross a cell of 1 in 0.75.
TEST(Lint, SaysWhenNoWaveCrossesACell) {
  const auto is_short = [](const std::string& end) {
    const std::string text = case_of_block("[scheme]\nkind = \"central_differences\"\n[time]\nend = " + end + "\n");
    const std::vector<std::string> warnings = lint_warnings(Simulation(parse_case(text, "case.toml")));
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& w) { return w.find("nothing will deform") != std::string::npos; });
  };
  EXPECT_TRUE(is_short("0.7"));
  EXPECT_FALSE(is_short("0.8"));
}

TEST(Lint, SaysWhenARigidSurfaceShowsItsBack) {
  const std::string what = "look away from";
  EXPECT_FALSE(is_warned(sheet(-0.1, "FOOT") + moving(-1.0), what));
  EXPECT_TRUE(is_warned(sheet(3.1, "HEAD") + moving(-1.0), what));
  // A body that moves towards the back would pass: refused.
  const std::string text = case_of_block(sheet(3.1, "HEAD") + moving(1.0) + central_differences);
  EXPECT_THROW(Simulation(parse_case(text, "case.toml")), CaseError);
}

TEST(Lint, SaysWhenAContactIsReachedAfterTheEnd) {
  const std::string what = "is not reached before the end";
  EXPECT_FALSE(is_warned(second_body(3.5) + moving(1.0), what));
  EXPECT_TRUE(is_warned(second_body(3.5) + moving(0.4), what));  // 0.5 / 0.4 > 1
}

TEST(Lint, CheckRefusesWhatARunRefuses) {
  const auto tables_of = [](const std::string& rest) {
    const Case given = parse_case(case_of_block(rest + central_differences), "case.toml");
    const Simulation simulation(given);
    const RunTables tables(simulation);  // what `carom check` makes as well; touches no file
  };
  const std::string probe = "[[probe]]\nname = \"top\"\ngroup = \"HEAD\"\nquantities = [\"velocity\"]\n";
  const std::string check = "[[check]]\nquantity = \"velocity_w\"\nplace = \"top\"\nvalue = 1.0\ntolerance = 0.1\n";
  EXPECT_NO_THROW(tables_of(probe));
  EXPECT_THROW(tables_of(probe + check), CaseError);
  EXPECT_THROW(tables_of("[[probe]]\nname = \"n\"\nnode = 9999\nquantities = [\"velocity\"]\n"), CaseError);
}

TEST(Lint, SaysWhenSurfacesLookAwayFromEachOther) {
  const std::string what = "looks at";
  const std::string floor =
      "[[contact]]\nname = \"floor\"\nkind = \"plane\"\npoint = [0.0, 0.0, -0.1]\n"
      "normal = [0.0, 0.0, 1.0]\ngroup = ";
  EXPECT_FALSE(is_warned(floor + "\"FOOT\"\n" + moving(-1.0), what));
  EXPECT_TRUE(is_warned(floor + "\"HEAD\"\n" + moving(-1.0), what));
  std::string turned = second_body(3.5);
  turned.replace(turned.find("group = \"HEAD\""), 14, "group = \"FOOT\"");
  EXPECT_FALSE(is_warned(second_body(3.5) + moving(1.0), what));
  EXPECT_TRUE(is_warned(turned + moving(1.0), what));
}

/// A body of one facet of 2 x 2 over four of 1 x 1.
TEST(Lint, SaysWhenTheMasterIsMuchFiner) {
  const std::string what = "2 times as long as those of its master";
  std::string exchanged = second_body(3.5);
  exchanged.replace(exchanged.find("group = \"HEAD\"\nmaster = \"UNDER\""), 31, "group = \"UNDER\"\nmaster = \"HEAD\"");
  for (const std::string method : {"node_to_surface", "surface_to_surface", "two_pass"}) {
    const std::string key = "method = \"" + method + "\"\n" + moving(1.0);
    EXPECT_FALSE(is_warned(second_body(3.5) + key, what)) << method;
    EXPECT_EQ(is_warned(exchanged + key, what), method != "two_pass") << method;
  }
}

TEST(Lint, SaysWhenSurfacesPassByEachOther) {
  const std::string what = "do not come together before the end";
  // 5 ahead: reached in a second at 6, missed at 3, and missed sideways.
  EXPECT_FALSE(is_warned(second_body(8.0) + moving(6.0), what));
  EXPECT_TRUE(is_warned(second_body(8.0) + moving(2.0), what));
  EXPECT_TRUE(is_warned(second_body(8.0) + "[[initial]]\npart = \"body\"\nvelocity = [16.0, 0.0, 6.0]\n", what));
}

TEST(Lint, FollowsTheFunctionOfAnObstacle) {
  // A plane 1 above the head comes down at 2 after t = 0.25: touch at 0.75; at 1 it would come after the end.
  const auto plane = [](double speed) {
    return "[functions.late]\ntime = [0.0, 0.25, 0.25]\nvalue = [0.0, 0.0, 1.0]\n[[contact]]\nname = \"press\"\n"
           "kind = \"plane\"\npoint = [0.0, 0.0, 4.0]\nnormal = [0.0, 0.0, -1.0]\ngroup = \"HEAD\"\n"
           "function = \"late\"\nvelocity = [0.0, 0.0, " +
           std::to_string(-speed) + "]\n";
  };
  const Case given = parse_case(case_of_block(plane(2.0) + central_differences), "case.toml");
  const Simulation simulation(given);
  const std::vector<Approach> found = approaches(simulation, simulation.initial_state());
  EXPECT_NEAR(found.at(0).first_touch, 0.75, 2.0 / 512.0);  // the jump is smeared over an interval
  EXPECT_FALSE(is_warned(plane(2.0), "is not reached before the end"));
  EXPECT_TRUE(is_warned(plane(1.0), "is not reached before the end"));
}

/// A body that touches at the start and is moved at its head alone: the flight of free nodes does not say when it
/// closes.
TEST(Lint, SaysNothingFalseOfContactsThatTouch) {
  const std::string press =
      "[functions.ramp]\ntime = [0.0, 1.0]\nvalue = [0.0, 1.0]\n[[support]]\nnodes = \"HEAD\"\n"
      "displacement = { z = -0.1, function = \"ramp\" }\n";
  const std::string under =
      "[[contact]]\nname = \"under\"\nkind = \"plane\"\nnormal = [0.0, 0.0, 1.0]\npoint = [0.0, "
      "0.0, 0.0]\ngroup = \"FOOT\"\n";
  EXPECT_FALSE(is_warned(press + under, "before the end"));
  EXPECT_FALSE(is_warned(press + under, "nothing moves"));
}

/// Of all bodies with each other: one alone may fold, two may be too far apart; a fall together onto a plane says
/// nothing of what comes after.
TEST(Lint, SaysWhenBodiesThatAllTouchStayApart) {
  const std::string what = "no two of its bodies come together";
  const std::string all = "[[contact]]\nname = \"all\"\nkind = \"all\"\n";
  const auto two = [&](double height) {
    std::string text = second_body(height);
    return text.substr(0, text.find("[[contact]]")) + all;
  };
  EXPECT_FALSE(is_warned(all + moving(1.0), "moves towards"));
  EXPECT_FALSE(is_warned(all + moving(1.0), what));
  EXPECT_FALSE(is_warned(two(8.0) + moving(6.0), what));
  EXPECT_TRUE(is_warned(two(8.0) + moving(2.0), what));
  EXPECT_TRUE(is_warned(two(8.0), what));
  const std::string floor =
      "[[contact]]\nname = \"under\"\nkind = \"plane\"\nnormal = [0.0, 0.0, 1.0]\npoint = [0.0, "
      "0.0, -0.1]\ngroup = \"FOOT\"\n[[initial]]\nnodes = \"all\"\nvelocity = [0.0, 0.0, -1.0]\n";
  EXPECT_FALSE(is_warned(two(3.001) + floor, "before the end"));
}

/// Four facets of 1 x 1 under one of 2 x 2: all at once, near, glued, in contact, apart, or parting.
TEST(Lint, NamesBodiesFaceToFaceWithNothingBetweenThem) {
  const std::string what = "face to face";
  const auto two = [](double height, const std::string& kind) {
    const std::string text = second_body(height);
    const std::string alone = text.substr(0, text.find("[[contact]]"));
    return kind.empty() ? alone : replaced(text, "\"pair\"", "\"" + kind + "\"");
  };
  const std::string fall = "[[initial]]\nnodes = \"all\"\nvelocity = [0.0, 0.0, -1.0]\n";
  EXPECT_TRUE(is_warned(two(3.0, "") + fall, what));
  EXPECT_TRUE(is_warned(two(3.0, ""), what));
  EXPECT_TRUE(is_warned(two(3.0, "") + moving(1.0), what));
  EXPECT_TRUE(is_warned(two(3.03, ""), what));  // of a half diagonal of 0.7: 0.04
  EXPECT_TRUE(is_warned(two(2.97, ""), what));
  EXPECT_FALSE(is_warned(two(3.05, ""), what));  // 0.07
  EXPECT_FALSE(is_warned(two(3.0, "") + moving(-1.0), what));
  EXPECT_FALSE(is_warned(two(3.0, "pair"), what));
  EXPECT_FALSE(is_warned(two(3.0, "tie"), what));
  EXPECT_FALSE(is_warned(two(3.0, "") + "[[contact]]\nname = \"any\"\nkind = \"all\"\n", what));
  // An obstacle that both touch does not join them, and a body beside the edge of another is not in front of it.
  const std::string floor =
      "[[contact]]\nname = \"floor\"\nkind = \"plane\"\npoint = [0.0, 0.0, -0.1]\n"
      "normal = [0.0, 0.0, 1.0]\ngroup = \"all\"\n";
  EXPECT_TRUE(is_warned(two(3.0, "") + floor, what));
  EXPECT_FALSE(is_warned(replaced(two(3.0, ""), "origin = [0.0, 0.0", "origin = [2.0, 2.0"), what));
  // Where all nodes of both are led along the normal, nothing can happen between them.
  const std::string held = "[[support]]\nnodes = \"all\"\nblocked = [\"z\"]\n";
  EXPECT_FALSE(is_warned(two(3.0, "") + held, what));
}

TEST(Lint, AdvisesMoreStiffnessThanIsChosen) {
  const auto given = parse_case(case_of_block(second_body(3.5) + moving(1.0) + central_differences), "case.toml");
  for (const std::string& w : lint_warnings(Simulation(given))) {
    const auto at = w.find("; stiffness ");
    if (at == std::string::npos) continue;
    const std::size_t instead = w.find(" instead of ");
    ASSERT_NE(instead, std::string::npos) << w;
    EXPECT_GT(std::stod(w.substr(at + 12)), std::stod(w.substr(instead + 12))) << w;
    return;
  }
  ADD_FAILURE() << "an impact at the speed of sound is not called soft";
}

TEST(Lint, SaysWhichStopMakesTheStepSmall) {
  const auto stop = [](double stiffness, double damping) {
    return "[[contact]]\nname = \"stop\"\nkind = \"stop\"\ngroup = \"FOOT\"\nnormal = [0.0, 0.0, 1.0]\ngap = 0.1\n"
           "stiffness = " +
           std::to_string(stiffness) + "\ndamping = " + std::to_string(damping) + "\n" + moving(-1.0);
  };
  EXPECT_FALSE(is_warned(stop(1.0, 0.0), "explicit step"));
  EXPECT_TRUE(is_warned(stop(1e6, 0.0), "its stiffness makes the explicit step"));
  EXPECT_TRUE(is_warned(stop(1.0, 1e4), "its damping makes the explicit step"));
}

/// A block of three layers of cells gives a sixth of its mass away by its foot, a third of it by foot and head.
TEST(Lint, SaysWhenTheModifiedMassTakesMostOfABody) {
  const auto is_told = [](const std::string& contacts) {
    const std::string scheme = "[scheme]\nkind = \"modified_mass\"\n[time]\nend = 1.0\n";
    const std::vector<std::string> warnings =
        lint_warnings(Simulation(parse_case(case_of_block(contacts + scheme), "case.toml")));
    return std::ranges::any_of(
        warnings, [](const std::string& w) { return w.find("of all mass from contact nodes") != std::string::npos; });
  };
  EXPECT_FALSE(is_told(sheet(-0.1, "FOOT")));
  EXPECT_TRUE(is_told(sheet(-0.1, "FOOT") + "[[contact]]\nname = \"roof\"\nkind = \"plane\"\nnormal = [0.0, 0.0, "
                                            "-1.0]\npoint = [0.0, 0.0, 4.0]\ngroup = \"HEAD\"\n"));
}

TEST(Simulation, RefusesMasslessNodesOfABodyThatYields) {
  const auto refusal = [](const std::string& kind, const std::string& law) {
    std::string text = case_of_block(sheet(-0.1, "FOOT") + "[scheme]\nkind = \"" + kind + "\"\n[time]\nend = 1.0\n");
    text.replace(text.find("linear_elastic\""), 15, law);
    try {
      const Simulation simulation(parse_case(text, "case.toml"));
    } catch (const CaseError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string yielding = "j2_small_strain\"\nyield_stress = 0.01";
  EXPECT_EQ(refusal("modified_mass", "linear_elastic\""), "");
  EXPECT_EQ(refusal("central_differences", yielding), "");
  EXPECT_NE(refusal("modified_mass", yielding).find("takes the inertia of contact nodes"), std::string::npos);
}

// Newton's law of nodes: bodies rebound by their own waves (docs/schemes.md, "Restitution").
TEST(Lint, SaysThatRestitutionIsNoneOfBodies) {
  const auto is_told = [](const std::string& restitution) {
    const Case given =
        parse_case(case_of_block("[[contact]]\nname = \"floor\"\nkind = \"plane\"\npoint = [0.0, 0.0, -0.1]\n"
                                 "normal = [0.0, 0.0, 1.0]\ngroup = \"FOOT\"\nrestitution = " +
                                 restitution + "\n[scheme]\nkind = \"moreau_jean\"\n[time]\nend = 1.0\nstep = 0.1\n"),
                   "case.toml");
    const std::vector<std::string> warnings = lint_warnings(Simulation(given));
    return std::ranges::any_of(warnings, [](const std::string& w) { return w.find("not of their bodies") != w.npos; });
  };
  EXPECT_TRUE(is_told("0.5"));
  EXPECT_FALSE(is_told("0.0"));
}

TEST(Lint, SaysWhatIsHardToBelieve) {
  const std::string floor =
      "[[contact]]\nname = \"floor\"\nkind = \"plane\"\npoint = [0.0, 0.0, -0.1]\n"
      "normal = [0.0, 0.0, 1.0]\ngroup = \"FOOT\"\nfriction = ";
  EXPECT_FALSE(is_warned(floor + "2.0\n", "a friction of"));
  EXPECT_TRUE(is_warned(floor + "30.0\n", "a friction of 30"));
  const std::string gravity = "[[load]]\ngravity = [0.0, 0.0, -9.81]\n";
  EXPECT_FALSE(is_warned(gravity, "counts twice"));
  EXPECT_TRUE(is_warned(gravity + gravity, "counts twice"));
  EXPECT_FALSE(is_warned(gravity + "[[load]]\ngravity = [0.0, 9.81, 0.0]\n", "counts twice"));
}

/// 76 x 76 nodes of a foot, 5,776 rows; a dense compliance has 5,461 with friction at most, 16,384 without.
TEST(Lint, SaysWhereMoreRowsMayTouchThanExactContactTakes) {
  const auto is_told = [](const std::string& friction, const std::string& scheme) {
    std::string text = case_of_block(
        "[[contact]]\nname = \"floor\"\nkind = \"plane\"\npoint = [0.0, 0.0, 0.0]\n"
        "normal = [0.0, 0.0, 1.0]\ngroup = \"FOOT\"\nfriction = " +
        friction + "\n[scheme]\nkind = " + scheme + "\n[time]\nend = 1.0\nstep = 0.001\n");
    text.replace(text.find("[2, 2, 3]"), 9, "[75, 75, 1]");
    const std::vector<std::string> warnings = cost_warnings(Simulation(parse_case(text, "case.toml")), "");
    return std::ranges::any_of(warnings,
                               [](const std::string& w) { return w.find("up to 5776 rows") != std::string::npos; });
  };
  EXPECT_TRUE(is_told("0.3", "\"newmark\"\nenforcement = \"lagrange\""));
  EXPECT_FALSE(is_told("0.0", "\"newmark\"\nenforcement = \"lagrange\""));
  EXPECT_FALSE(is_told("0.3", "\"newmark\"\nenforcement = \"penalty\""));
  EXPECT_FALSE(is_told("0.3", "\"cd_lagrange\""));
}

/// A square of 2 x 2 unit cells in plane strain that falls onto a floor, whose nodes have a spring of 0.1 each.
double foretold_penetration(double thickness) {
  const Case given = parse_case(
      "units = \"SI\"\n[[mesh.block]]\nkind = \"quad\"\nsize = [2.0, 2.0]\n"
      "divisions = [2, 2]\ngroups = { cells = \"BODY\", ymin = \"FOOT\" }\n"
      "[materials.m]\nlaw = \"linear_elastic\"\nE = 2.0\nnu = 0.3\nrho = 1.5\n"
      "[[part]]\nname = \"body\"\ncells = \"BODY\"\nmaterial = \"m\"\n"
      "section = \"plane_strain\"\nthickness = " +
          std::to_string(thickness) +
          "\n[[initial]]\npart = \"body\"\nvelocity = [0.0, -1.0, 0.0]\n"
          "[[contact]]\nname = \"floor\"\nkind = \"plane\"\ngroup = \"FOOT\"\n"
          "measure = \"node\"\nstiffness = 0.1\npoint = [0.0, -0.1, 0.0]\n"
          "normal = [0.0, 1.0, 0.0]\n" +
          central_differences,
      "case.toml");
  const std::string before = "will penetrate by about ";
  for (const std::string& w : lint_warnings(Simulation(given)))
    if (w.find(before) != std::string::npos) return std::stod(w.substr(w.find(before) + before.size()));
  ADD_FAILURE() << "nothing is said of the penetration";
  return 0.0;
}

// Half of the thickness is half of the area that a plane wave presses on the same springs: rho c v t L / (3 k), with
// c^2 = 2 x 0.7 / (1.3 x 0.4) / 1.5 and the length L = 2 of the foot. It is said to three digits.
TEST(Lint, PressesOnSpringsOfNodesByTheAreaOfThePlaneBody) {
  const double c = std::sqrt(2.0 * 0.7 / (1.3 * 0.4) / 1.5);
  for (const double thickness : {1.0, 0.5}) {
    const double exact = 1.5 * c * thickness * 2.0 / 0.3;
    EXPECT_NEAR(foretold_penetration(thickness), exact, 5e-3 * exact) << thickness;
  }
}

// A bar along x that stands on end: its end looks upward, to the back of a sheet whose normal is along z.
TEST(Facing, TheEndOfABarLooksTheWayTheBarStandsNow) {
  const Case given = parse_case(R"(units = "SI"
[[mesh.block]]
kind = "bar"
end = [1.0, 0.0, 0.0]
divisions = 1
groups = { cells = "BAR", end = "END" }
[[mesh.block]]
kind = "quad"
origin = [-1.0, -1.0, 1.1]
size = [3.0, 2.0]
divisions = [1, 1]
groups = { cells = "SHEET" }
[materials.m]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "bar"
cells = "BAR"
material = "m"
section = "bar"
area = 1.0
[[contact]]
name = "sheet"
kind = "surface"
surface = "SHEET"
group = "END"
)" + central_differences,
                                "case.toml");
  const Simulation s(given);
  State state;
  state.q.assign(3 * s.mesh().node_count(), 0.0);
  state.v = state.q;
  EXPECT_FALSE(shows_its_back(s.model(), 0, state));
  const auto end = static_cast<std::size_t>(s.mesh().nodes_of("END").at(0));
  state.q[3 * end] = -1.0;
  state.q[3 * end + 2] = 1.0;
  EXPECT_TRUE(shows_its_back(s.model(), 0, state));
}

// What the bodies cost is measured: twelve cells for some ten steps are a matter of less than a second.
TEST(CostEstimate, OfAFewStepsIsAShortTime) {
  const CostEstimate cost =
      estimate_cost(Simulation(parse_case(case_of_block(moving(1.0) + central_differences), "case.toml")));
  EXPECT_GT(cost.seconds, 0.0);
  EXPECT_LT(cost.seconds, 1.0);
}

}  // namespace
}  // namespace carom::run_lint_test
