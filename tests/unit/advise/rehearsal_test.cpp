// What the first steps of a run say of all of them.
#include "advise/rehearsal.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "advise/check_summary.hpp"
#include "advise/stage_time.hpp"
#include "march/march.hpp"
#include "run_fixture.hpp"

namespace carom::advise_rehearsal_test {
namespace {

using namespace test;

constexpr double long_enough = 1e3;
const std::string wall =
    "[[contact]]\nname = \"wall\"\nkind = \"plane\"\ngroup = \"HEAD\"\npoint = [0.0, 0.0, 3.1]\n"
    "normal = [0.0, 0.0, -1.0]\n[[initial]]\npart = \"body\"\nvelocity = [0.0, 0.0, 1.0]\n";
const std::string hits_the_wall = wall + "[scheme]\nkind = \"central_differences\"\n[time]\nend = 1.0\n";

Simulation simulation_of(const std::string& rest) {
  return Simulation(parse_case(case_of_block(rest), "case.toml"));
}

TEST(Rehearsal, OfAShortRunIsTheRun) {
  const Simulation s = simulation_of(hits_the_wall);
  March march(s);
  march.start();
  while (!march.at_end()) march.step();
  const Rehearsal seen = rehearse(s, long_enough);
  EXPECT_TRUE(seen.is_whole);
  EXPECT_EQ(seen.t, s.end());
  EXPECT_EQ(foretell(s, 0, seen).steps, march.steps());
  EXPECT_EQ(foretell(s, 0, seen).seconds, seen.seconds);
}

TEST(Rehearsal, MakesNoStepThatIsExpectedToTakeLonger) {
  const Simulation s = simulation_of(hits_the_wall);
  const Rehearsal none = rehearse(s, 1e-12);
  EXPECT_TRUE(none.stages.empty());
  EXPECT_EQ(foretell(s, 0, none).steps, expected_steps(*s.stages()[0], s));
}

// A quarter of the run in 100 steps, the later half of which were a thousandth long: 750 more, and 1.2 times as many
// where the springs of the pair have not been met (contact_cut).
TEST(Rehearsal, GoesOnAsItsLaterHalf) {
  const Simulation s = simulation_of(
      "[[mesh.block]]\norigin = [0.0, 0.0, 3.1]\nsize = [2.0, 2.0, 1.0]\ndivisions = [1, 1, 1]\n"
      "groups = { cells = \"OTHER\", zmin = \"UNDER\" }\n[[part]]\nname = \"other\"\ncells = \"OTHER\"\n"
      "material = \"soft\"\n[[contact]]\nname = \"touch\"\nkind = \"pair\"\ngroup = \"HEAD\"\n"
      "master = \"UNDER\"\n[scheme]\nkind = \"central_differences\"\n[time]\nend = 1.0\n");
  Rehearsal seen{.stages = {{100, 2.0}}, .t = 0.25, .seconds = 2.0, .late_dt = 1e-3, .late_seconds = 0.01};
  EXPECT_EQ(foretell(s, 0, seen).steps, 100 + 900);
  EXPECT_NEAR(foretell(s, 0, seen).seconds, 2.0 + 9.0, 1e-12);
  seen.has_touched = true;
  EXPECT_EQ(foretell(s, 0, seen).steps, 100 + 750);
}

TEST(Rehearsal, CountsEachStageByItself) {
  const Simulation s = simulation_of(wall +
                                     "[scheme]\nkind = \"newmark\"\n[time]\nend = 0.02\nstep = 0.01\n"
                                     "[[stage]]\nkind = \"newmark\"\nend = 0.05\nstep = 0.01\n");
  const Rehearsal seen = rehearse(s, long_enough);
  ASSERT_EQ(seen.stages.size(), 2U);
  EXPECT_EQ(foretell(s, 0, seen).steps, 2);
  EXPECT_EQ(foretell(s, 1, seen).steps, 3);
  // A stage that has been left takes what it took; one that was not reached takes what is expected.
  const Rehearsal first{.stages = {{7, 1.0}}, .t = 0.02, .seconds = 1.0, .late_dt = 0.01, .late_seconds = 0.5};
  EXPECT_EQ(foretell(s, 0, first).steps, 7);
  EXPECT_EQ(foretell(s, 1, first).steps, 3);
}

// Pulled by twice what it can bear at its head: no equilibrium is left near half of the load.
TEST(Rehearsal, SaysBeforehandThatARunWillStop) {
  const auto pulled = [](const std::string& stress) {
    const std::string held = case_of_block(
        "[[support]]\nnodes = \"FOOT\"\ndisplacement = { x = 0.0, y = 0.0, z = 0.0 }\n"
        "[[load]]\ngroup = \"HEAD\"\npressure = -" +
        stress + "\nfunction = \"ramp\"\n[functions.ramp]\ntime = [0.0, 1.0]\nvalue = [0.0, 1.0]\n" +
        "[scheme]\nkind = \"statics\"\n[time]\nend = 1.0\nstep = 0.25\n");
    return Simulation(parse_case(replaced(held, "law = \"linear_elastic\"",
                                          "law = \"j2_small_strain\"\nyield_stress = 0.01\nhardening_modulus = 0.0"),
                                 "case.toml"));
  };
  const auto says_so = [](const Examination& found) {
    return std::ranges::any_of(found.warnings, [](const std::string& warning) {
      return warning.starts_with("the run will not come to its end: ");
    });
  };
  const Examination stops = examine(pulled("0.02"), "", long_enough), ends = examine(pulled("0.005"), "", long_enough);
  EXPECT_TRUE(says_so(stops)) << stops.text();
  EXPECT_FALSE(says_so(ends)) << ends.text();
  EXPECT_NE(ends.summary.find(", to the end\n"), std::string::npos) << ends.summary;
  EXPECT_EQ(stops.summary.find(", to the end\n"), std::string::npos) << stops.summary;
}

}  // namespace
}  // namespace carom::advise_rehearsal_test
