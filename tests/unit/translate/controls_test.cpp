// *SECTION CONTROLS of a deck.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "casefile/read_case.hpp"
#include "translate/translate_deck.hpp"
#include "translate_fixture.hpp"

namespace carom::translate_controls_test {
namespace {

using test::good_deck;
using test::replaced;

TranslatedDeck translated(const std::string& text) {
  return translate_deck(text, "x.inp", {}, [](const std::string& path, const Location& where) -> std::string {
    throw CaseError(where, "*INCLUDE", "no file " + path, "");
  });
}

bool has_note(const TranslatedDeck& deck, const std::string& part) {
  return std::any_of(deck.notes.begin(), deck.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(Translate, DistortionControlOfTheSectionsThatNameIt) {
  const auto made = [](const char* controls, const char* step) {
    const std::string named =
        replaced(good_deck, "ELSET=LOWER, MATERIAL=STEEL", "ELSET=LOWER, MATERIAL=STEEL, CONTROLS=C");
    return translated(
        replaced(replaced(named, "*MATERIAL, NAME", std::string(controls) + "\n*MATERIAL, NAME"), "*STEP\n", step));
  };
  const auto parts = [&](const char* controls) {
    return case_of(made(controls, "*STEP, NLGEOM\n").tree, "x.inp").parts;
  };
  const auto ten = parts("*SECTION CONTROLS, NAME=C, DISTORTION CONTROL=YES, HOURGLASS=ENHANCED");
  EXPECT_EQ(**ten[0].distortion_control, 0.1);
  EXPECT_FALSE(ten[1].distortion_control);
  EXPECT_EQ(**parts("*SECTION CONTROLS, NAME=C, DISTORTION CONTROL=YES, LENGTH RATIO=0.25")[0].distortion_control,
            0.25);
  EXPECT_FALSE(parts("*SECTION CONTROLS, NAME=C, DISTORTION CONTROL=NO")[0].distortion_control);
  EXPECT_FALSE(parts("*SECTION CONTROLS, NAME=OTHER, DISTORTION CONTROL=YES")[0].distortion_control);
  EXPECT_THROW(parts("*SECTION CONTROLS, NAME=C, DISTORTION CONTROL=YES, LENGTH RATIO=much"), CaseError);
  const TranslatedDeck small = made("*SECTION CONTROLS, NAME=C, DISTORTION CONTROL=YES", "*STEP\n");
  EXPECT_TRUE(has_note(small, "DISTORTION CONTROL changes nothing at small strain"));
  EXPECT_FALSE(case_of(small.tree, "x.inp").parts[0].distortion_control);
}

/// Abaqus keyword *SECTION CONTROLS: the data line has three factors of the hourglass control, then one of the linear
/// and one of the quadratic bulk viscosity, 1 where none is given; keyword *BULK VISCOSITY: 0.06 and 1.2 where none is.
TEST(Translate, FactorsOfTheBulkViscosityOfASection) {
  const auto parts = [](const std::string& factors, const std::string& viscosity) {
    std::string deck = replaced(good_deck, "ELSET=LOWER, MATERIAL=STEEL", "ELSET=LOWER, MATERIAL=STEEL, CONTROLS=C");
    deck = replaced(deck, "*MATERIAL, NAME", "*SECTION CONTROLS, NAME=C\n" + factors + "\n*MATERIAL, NAME");
    return case_of(translated(replaced(deck, "*DYNAMIC, DIRECT\n1e-6, 1e-3",
                                       "*DYNAMIC, EXPLICIT\n, 1e-3\n*BULK VISCOSITY\n" + viscosity))
                       .tree,
                   "x.inp")
        .parts;
  };
  const auto scaled = parts("1., 1., 1., 0.5, 2.", "0.1, 0.8");
  EXPECT_DOUBLE_EQ(scaled[0].linear_bulk_viscosity, 0.05);
  EXPECT_DOUBLE_EQ(scaled[0].quadratic_bulk_viscosity, 1.6);
  EXPECT_DOUBLE_EQ(scaled[1].linear_bulk_viscosity, 0.1);
  EXPECT_DOUBLE_EQ(parts("1., 1., 1.", "0.1")[0].quadratic_bulk_viscosity, 1.2);
  EXPECT_DOUBLE_EQ(parts("1., 1., 1.", ", 0.8")[0].linear_bulk_viscosity, 0.06);
}

}  // namespace
}  // namespace carom::translate_controls_test
