// What is refused between the case file and the first step, with its message.
#include <gtest/gtest.h>

#include "run_fixture.hpp"

namespace carom::run_model_test {
namespace {

using namespace test;

const std::string newmark_for_one_second = R"(
[scheme]
kind = "newmark"
[time]
end = 1.0
step = 0.1
)";

std::string plane(const std::string& group, double height) {
  return "[[contact]]\nname = \"wall\"\nkind = \"plane\"\nnormal = [0.0, 0.0, 1.0]\nmeasure = \"node\"\nstiffness = "
         "5.0\n" +
         ("group = \"" + group + "\"\npoint = [0.0, 0.0, " + std::to_string(height) + "]\n");
}

TEST(Groups, UnknownNameHasANearSpellingAndAPlace) {
  const CaseError e = case_error(case_of_block(plane("FOOD", -1.0) + newmark_for_one_second));
  EXPECT_EQ(e.key(), "contact.group");
  EXPECT_EQ(e.found(), "\"FOOD\", which the mesh does not have");
  EXPECT_EQ(e.suggestion().substr(0, 39), "Did you mean \"FOOT\"? The mesh has: BODY");
  EXPECT_EQ(e.where().file, "case.toml");
  EXPECT_EQ(e.where().line, 21);  // 14 lines of the block, and the seventh of the section
}

TEST(Groups, WithoutSolidCellsCannotBeAPart) {
  const CaseError e = case_error(
      case_of_block("[[part]]\nname = \"foot\"\ncells = \"FOOT\"\nmaterial = \"soft\"\n" + newmark_for_one_second));
  EXPECT_EQ(e.key(), "part.cells");
  EXPECT_EQ(e.found(), "\"FOOT\", a group of QUAD4 cells");
}

TEST(Parts, MayNotShareACell) {
  const CaseError e = case_error(
      case_of_block("[[part]]\nname = \"again\"\ncells = \"BODY\"\nmaterial = \"soft\"\n" + newmark_for_one_second));
  EXPECT_EQ(e.found(), "cell 1 in part \"body\" and in part \"again\"");
  EXPECT_EQ(e.expected(), "every cell in one part only");
}

TEST(InterfaceContact, MayNotBeMadeOfCellsOfAPart) {
  const CaseError e = case_error(
      case_of_block("[[contact]]\nname = \"wall\"\nkind = \"interface\"\ngroup = \"BODY\"\nstiffness = 1.0\n" +
                    newmark_for_one_second));
  EXPECT_EQ(e.found(), "cell 1 of \"BODY\", which belongs to part \"body\"");
}

TEST(Contact, NodesWithoutMassMustBeHeld) {
  const std::string held = "blocked = [\"x\", \"y\", \"z\"]";
  const std::string text = replaced(read_text(CAROM_SOURCE_DIR "/cases/sdnv100/as_published.toml"), "as_published.msh",
                                    CAROM_SOURCE_DIR "/cases/sdnv100/as_published.msh");
  for (const std::string two : {"\"x\", \"y\"", "\"x\", \"z\"", "\"y\", \"z\""}) {
    const CaseError e = case_error(replaced(text, held, "blocked = [" + two + "]"));
    EXPECT_EQ(e.key(), "contact.group") << two;
    EXPECT_NE(e.found().find("of \"CONTACT\", which belongs to no part and is not held in x, y and z"),
              std::string::npos)
        << e.found();
  }
}

TEST(Contact, MayNotPenetrateAtTheStart) {
  const CaseError e = case_error(case_of_block(plane("FOOT", 0.25) + newmark_for_one_second));
  const std::string what =
      "9 rows of \"wall\" that penetrate at the start, the worst by 0.25 (0.25 of a cell): 0.25 at (";
  EXPECT_EQ(e.found().substr(0, what.size()), what);
}

// The second bar is put one length to the left, where the first one is: far deeper than the rows of a pair look.
TEST(Contact, MayNotBeginWithBodiesInsideOfEachOther) {
  for (const auto& [file, gap, moved, cell] :
       {std::array{"grazing.toml", "origin = [0.0, 0.0, 0.01]", "origin = [0.0, 0.0, -1.0]", "HEXA8"},
        std::array{"grazing_strip.toml", "origin = [0.0, 0.01, 0.0]", "origin = [0.0, -1.0, 0.0]", "QUAD4"}}) {
    std::string text = read_text(std::string(CAROM_SOURCE_DIR "/cases/two_bars/") + file);
    const std::size_t at = text.find(gap);
    ASSERT_NE(at, std::string::npos) << file;
    const CaseError e = case_error(text.replace(at, std::string_view(gap).size(), moved));
    EXPECT_NE(e.found().find("deep inside of another body at the start"), std::string::npos) << e.found();
    EXPECT_NE(e.found().find(std::string("inside of ") + cell), std::string::npos) << e.found();
  }
}

TEST(Contact, OfAPairTakesTwoSurfaces) {
  const CaseError e = case_error(case_of_block(
      "[[contact]]\nname = \"c\"\nkind = \"pair\"\ngroup = \"FOOT\"\nmaster = \"FOOT\"\n" + newmark_for_one_second));
  EXPECT_EQ(e.found(), "\"FOOT\", which is the group as well");
}

// The block of 2 x 2 x 3 cells has 34 nodes on its skin; without its head's faces the middle node of the head goes. 24
// of them stand on edges.
TEST(Contact, OfAllLeavesOutWhatIsExcluded) {
  const auto slots = [](const std::string& exclude) {
    const Case given = parse_case(
        case_of_block("[[contact]]\nname = \"c\"\nkind = \"all\"\n" + exclude + newmark_for_one_second), "case.toml");
    return Simulation(given).contact().slots();
  };
  const std::size_t of_edges = 8 * 4 * (2 + 2 + 3);  // eight per segment; those around what is excluded still stick out
  const std::size_t sharp = 24U;
  EXPECT_EQ(slots(""), 34U + sharp + of_edges);
  EXPECT_EQ(slots("exclude = [\"HEAD\"]\n"), 33U + sharp + of_edges);
  EXPECT_EQ(slots("exclude = [\"HEAD\", \"FOOT\"]\n"), 32U + sharp + of_edges);
  EXPECT_EQ(case_error(case_of_block("[[contact]]\nname = \"c\"\nkind = \"all\"\nexclude = [\"HED\"]\n" +
                                     newmark_for_one_second))
                .key(),
            "contact.exclude");
}

TEST(Contact, MayTouchAtTheStart) {
  const Case given = parse_case(case_of_block(plane("FOOT", 0.0) + newmark_for_one_second), "case.toml");
  const Simulation simulation(given);
  EXPECT_EQ(simulation.contact().slots(), 9U);
}

TEST(Step, AboveTheStableOneIsRefusedForCentralDifferences) {
  const std::string text = case_of_block("[scheme]\nkind = \"central_differences\"\n[time]\nend = 1.0\n");
  const Case given = parse_case(text, "case.toml");
  const double stable = Simulation(given).stable().dt;
  EXPECT_LE(Simulation(given).dt(), 0.9 * stable * (1.0 + 1e-12));  // the documented default of `safety`
  const CaseError e = case_error(text + "step = " + std::to_string(1.01 * stable) + "\n");
  EXPECT_EQ(e.key(), "time.step");
  EXPECT_EQ(e.expected().substr(0, 24), "at most the stable step ");
}

TEST(Step, WhenFixedMustDivideTheEnd) {
  const CaseError e =
      case_error(case_of_block("[scheme]\nkind = \"newmark\"\n[time]\nend = 1.0\nstep = 0.3\nfixed = true\n"));
  EXPECT_EQ(e.key(), "time.end");
  EXPECT_EQ(e.found(), "3.33333333 steps of 0.3 to 1");
}

TEST(Step, OtherwiseIsShortenedToReachTheEnd) {
  const Case given =
      parse_case(case_of_block("[scheme]\nkind = \"newmark\"\n[time]\nend = 1.0\nstep = 0.3\n"), "case.toml");
  const Simulation simulation(given);
  EXPECT_EQ(simulation.steps(), 4);
  EXPECT_EQ(simulation.dt(), 0.25);
}

TEST(Supports, ContradictingEachOtherAreNamed) {
  const CaseError e = case_error(case_of_block(
      "[[support]]\nnodes = \"FOOT\"\nblocked = [\"z\"]\n[[support]]\nnodes = \"BODY\"\nvelocity = { z = 1.0 }\n" +
      newmark_for_one_second));
  EXPECT_NE(e.found().find("node 1 has two different motions along z: from \"support[0] on FOOT"), std::string::npos)
      << e.found();
}

/// The CaseError that running the case throws; nothing has been run then.
CaseError run_error(const std::string& text) {
  const TemporaryCase one(text);
  try {
    one.run();
  } catch (const CaseError& e) {
    return e;
  }
  ADD_FAILURE() << "no error";
  return {{}, "", "", ""};
}

const std::string probe = "[[probe]]\nname = \"head\"\ngroup = \"HEAD\"\nquantities = [\"displacement\"]\n";

TEST(Checks, OfUnknownQuantitiesHaveANearSpelling) {
  const CaseError e = run_error(case_of_block(
      probe + newmark_for_one_second +
      "[[check]]\nquantity = \"displacment_z\"\nplace = \"head\"\nvalue = 0.0\ntolerance = 1.0\nabsolute = true\n"));
  EXPECT_EQ(e.key(), "check.quantity");
  EXPECT_EQ(e.found(), "\"head.displacment_z\", which no table of this run holds");
  EXPECT_EQ(e.suggestion(), "Did you mean \"head.displacement_z\"?");
}

}  // namespace
}  // namespace carom::run_model_test
