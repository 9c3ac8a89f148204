// What those who write decks get wrong by hand, said in the words of the deck: its line, its numbers, its names.
#include <gtest/gtest.h>

#include <string>

#include "translate_fixture.hpp"

namespace carom::translate_messages_test {
namespace {

using test::case_from;
using test::good_deck;
using test::has_note;
using test::message_of;
using test::replaced;
using test::translated;

TEST(TranslateMessages, AMisspeltWordHasTheNearestThatIsKnown) {
  const std::string keyword =
      message_of(replaced(good_deck, "*SOLID SECTION, ELSET=UPPER", "*SOLID SECTON, ELSET=UPPER"));
  EXPECT_NE(
      keyword.find("x.inp:38: *SOLID SECTON: an unknown keyword. Did you mean *SOLID SECTION? What it means would "
                   "be lost."),
      std::string::npos)
      << keyword;
  const std::string parameter = message_of(replaced(good_deck, "*BOUNDARY\n", "*BOUNDARY, AMPLITUTE=A\n"));
  EXPECT_NE(parameter.find("x.inp:39: *BOUNDARY: the parameter AMPLITUTE is not known. Did you mean AMPLITUDE? What it "
                           "changes would be lost."),
            std::string::npos)
      << parameter;
  const std::string far = message_of(good_deck + "*PHLOGISTON\n");
  EXPECT_NE(far.find("*PHLOGISTON: an unknown keyword. What it means would be lost."), std::string::npos) << far;
}

TEST(TranslateMessages, ElementsWithoutASectionAreNamedWithTheLineOfTheirKeyword) {
  EXPECT_EQ(
      message_of(replaced(good_deck, "*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL\n", "")),
      "x.inp:22: *ELEMENT: found element 2 without a section; expected a *SOLID SECTION of all solids, plane cells "
      "and bars. Add *SOLID SECTION, ELSET=UPPER, MATERIAL=...");
  EXPECT_EQ(
      message_of(replaced(replaced(good_deck, "*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL\n", ""),
                          "*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL\n", "")),
      "x.inp: found no *SOLID SECTION; expected a *SOLID SECTION of the elements, with its ELSET and the NAME of a "
      "*MATERIAL. Elements that are to move have a material by their section.");
}

TEST(TranslateMessages, AnUnknownMaterialIsSaidAtItsSection) {
  EXPECT_EQ(message_of(replaced(good_deck, "ELSET=UPPER, MATERIAL=STEEL", "ELSET=UPPER, MATERIAL=STEAL")),
            "x.inp:38: *SOLID SECTION: found the unknown material STEAL; expected the NAME of a *MATERIAL (STEEL). Did "
            "you mean STEEL?");
  // Nothing refers to STEEL now: it is left out, and known all the same.
  const std::string none = replaced(replaced(good_deck, "ELSET=UPPER, MATERIAL=STEEL", "ELSET=UPPER, MATERIAL=ALU"),
                                    "ELSET=LOWER, MATERIAL=STEEL", "ELSET=LOWER, MATERIAL=ALU");
  EXPECT_NE(message_of(none).find("x.inp:37: *SOLID SECTION: found the unknown material ALU; expected the NAME of a "
                                  "*MATERIAL (STEEL)"),
            std::string::npos)
      << message_of(none);
}

/// The two cubes as plane squares.
std::string squares(const std::string& data) {
  return "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*ELEMENT, TYPE=CPE4, ELSET=ALL\n1,1,2,3,4\n*MATERIAL, NAME=STEEL\n*ELASTIC\n"
         "210000., 0.3\n*DENSITY\n7.8e-9\n*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n" +
         data + "*STEP\n*DYNAMIC, DIRECT\n1e-6, 1e-3\n*END STEP\n";
}

TEST(TranslateMessages, AThicknessOfZeroIsNone) {
  for (const char* zero : {"0.\n", "-2.\n"})
    EXPECT_EQ(message_of(squares(zero)),
              "x.inp:14: *SOLID SECTION: found a thickness of " + std::string(zero[0] == '0' ? "0" : "-2") +
                  "; expected a thickness > 0, or no data line for one of 1. Masses and forces are those of cells so "
                  "thick.");
  for (const char* none : {"", ",\n"}) {
    EXPECT_EQ(case_from(squares(none)).parts.front().thickness, 1.0);
    EXPECT_TRUE(has_note(translated(squares(none)), "no thickness in a data line: it is 1"));
  }
  EXPECT_EQ(case_from(squares("2.5\n")).parts.front().thickness, 2.5);
}

TEST(TranslateMessages, TitlesKeepTheirLetters) {
  EXPECT_EQ(case_from(replaced(good_deck, "Two cubes",
                               "Pr\xc3\xbc"
                               "fst\xc3\xbc"
                               "ck"))
                .title,
            "Pr\xc3\xbc"
            "fst\xc3\xbc"
            "ck");
  EXPECT_EQ(case_from(replaced(good_deck, "Two cubes", "Sto\xdf")).title, "Sto\xc3\x9f");  // Latin-1
  EXPECT_EQ(
      message_of(replaced(good_deck, "NSET=BASE", "NSET=F\xdcSSE")),
      "x.inp:24: *NSET: found 'NSET=F\xc3\x9cSSE'; expected letters of ASCII, without umlauts and accents. Rename it, "
      "wherever the deck has it.");
}

TEST(TranslateMessages, RangesBeyondTheNodesAreSaid) {
  EXPECT_TRUE(has_note(translated(replaced(good_deck, "BASE, GENERATE\n1, 4\n", "BASE, GENERATE\n1, 10\n")),
                       "x.inp:25: BASE: 2 of the 10 numbers of the range 1 to 10 are no nodes; left out"));
  EXPECT_NE(
      message_of(replaced(good_deck, "BASE, GENERATE\n1, 4\n", "BASE, GENERATE\n100, 140, 10\n"))
          .find("x.inp:25: *NSET: found the range 100 to 140 by 10 for BASE, none of which is the number of a node; "
                "expected numbers of nodes, the largest of which is 18. Are the numbers those of another part or "
                "instance?"),
      std::string::npos);
}

}  // namespace
}  // namespace carom::translate_messages_test
