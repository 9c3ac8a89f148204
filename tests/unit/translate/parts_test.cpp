// *SOLID SECTION of sets with several element types.
#include <gtest/gtest.h>

#include <string>

#include "casefile/read_case.hpp"
#include "translate/translate_deck.hpp"
#include "translate_fixture.hpp"

namespace carom::translate_parts_test {
namespace {

using test::good_deck;
using test::replaced;

Case case_from(const std::string& text) {
  const auto no_file = [](const std::string& path, const Location& where) -> std::string {
    throw CaseError(where, "*INCLUDE", "no file " + path, "");
  };
  return case_of(translate_deck(text, "x.inp", {}, no_file).tree, "x.inp");
}

/// Two wedges on the lower cube, of its set.
std::string with_wedges(const std::string& cubes, const std::string& wedges) {
  return replaced(good_deck, "*ELEMENT, TYPE=C3D8, ELSET=LOWER\n",
                  "19,0,0,2\n20,1,0,2\n*ELEMENT, TYPE=" + wedges +
                      ", ELSET=LOWER\n3,5,8,19,6,7,20\n*ELEMENT, TYPE=" + cubes + ", ELSET=LOWER\n");
}

TEST(Translate, ASetOfSeveralTypesIsOnePart) {
  const Case plain = case_from(with_wedges("C3D8", "C3D6"));
  ASSERT_EQ(plain.parts.size(), 2U);
  EXPECT_EQ(*plain.parts[0].name, "LOWER");
  EXPECT_EQ(*plain.parts[0].cells, "LOWER");
  EXPECT_FALSE(plain.parts[0].formulation);
  const Case reduced = case_from(with_wedges("C3D8R", "C3D6"));
  ASSERT_EQ(reduced.parts.size(), 2U);
  EXPECT_EQ(**reduced.parts[0].formulation, "one_point");
}

TEST(Translate, TypesOfOneCellWithTwoFormulationsAreTwoParts) {
  const std::string nodes = replaced(good_deck, "*ELEMENT, TYPE=C3D8, ELSET=LOWER\n",
                                     "21,2,0,1.1\n22,2,1,1.1\n23,2,0,2.1\n24,2,1,2.1\n"
                                     "*ELEMENT, TYPE=C3D8, ELSET=LOWER\n");
  const Case both = case_from(replaced(nodes, "*ELEMENT, TYPE=C3D8, ELSET=UPPER\n",
                                       "*ELEMENT, TYPE=C3D8R, ELSET=UPPER\n3,12,21,22,13,16,23,24,17\n"
                                       "*ELEMENT, TYPE=C3D8, ELSET=UPPER\n"));
  ASSERT_EQ(both.parts.size(), 3U);
  EXPECT_EQ(*both.parts[1].name, "UPPER C3D8");
  EXPECT_EQ(**both.parts[2].formulation, "one_point");
}

/// Names with blanks stand in quotes, an instance alone or with what it is of, as Abaqus' modeller writes them.
TEST(Translate, NamesOfInstancesMayStandInQuotes) {
  std::string deck = replaced(good_deck, "*HEADING\nTwo cubes\n", "*PART, NAME=\"A Cube\"\n");
  deck = replaced(deck, "*SURFACE, NAME=FLOOR",
                  "*END PART\n*ASSEMBLY\n*INSTANCE, NAME=\"Cube 1\", PART=\"A Cube\"\n"
                  "*END INSTANCE\n*END ASSEMBLY\n*SURFACE, NAME=FLOOR");
  deck = replaced(replaced(deck, "LOWER, S2", "\"Cube 1\".LOWER, S2"), "UPPER, S1", "\"Cube 1.UPPER\", S1");
  deck = replaced(deck, "ELSET=LOWER, MATERIAL", "ELSET=\"Cube 1\".LOWER, MATERIAL");
  deck = replaced(deck, "ELSET=UPPER, MATERIAL", "ELSET=\"cube 1.upper\", MATERIAL");
  deck = replaced(deck, "BASE, 1, 3", "\"Cube 1\".BASE, 1, 3");
  deck = replaced(replaced(deck, "FALLING, 3", "\"Cube 1\".11, 3"), "15, 1, 5.", "\"cube 1\".15, 1, 5.");
  const Case made = case_from(deck);
  EXPECT_EQ(*made.parts[1].name, "CUBE 1.UPPER");
  EXPECT_EQ(*made.supports[0].nodes, "CUBE 1.BASE");
  EXPECT_EQ(**made.loads[0].group, "CUBE 1.15");
  EXPECT_EQ(made.contacts.size(), 1U);
}

}  // namespace
}  // namespace carom::translate_parts_test
