// For the tests of decks as cases: a deck that is good, and small changes of it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "casefile/read_case.hpp"
#include "translate/translate_deck.hpp"

namespace carom::test {

/// Two cubes, one on the other, the upper one falling. Line numbers are counted here.
inline const std::string good_deck =
    "*HEADING\nTwo cubes\n"                                                                             // 1-2
    "*NODE, NSET=NALL\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"        // 3-11
    "11,0,0,1.1\n12,1,0,1.1\n13,1,1,1.1\n14,0,1,1.1\n15,0,0,2.1\n16,1,0,2.1\n17,1,1,2.1\n18,0,1,2.1\n"  // 12-19
    "*ELEMENT, TYPE=C3D8, ELSET=LOWER\n1,1,2,3,4,5,6,7,8\n"                                             // 20-21
    "*ELEMENT, TYPE=C3D8, ELSET=UPPER\n2,11,12,13,14,15,16,17,18\n"                                     // 22-23
    "*NSET, NSET=BASE, GENERATE\n1, 4\n"                                                                // 24-25
    "*NSET, NSET=FALLING, GENERATE\n11, 18\n"                                                           // 26-27
    "*SURFACE, NAME=FLOOR\nLOWER, S2\n"                                                                 // 28-29
    "*SURFACE, NAME=FOOT\nUPPER, S1\n"                                                                  // 30-31
    "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.8e-9\n"                                 // 32-36
    "*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL\n*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL\n"        // 37-38
    "*BOUNDARY\nBASE, 1, 3\n"                                                                           // 39-40
    "*INITIAL CONDITIONS, TYPE=VELOCITY\nFALLING, 3, -1000.\n"                                          // 41-42
    "*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e6\n"               // 43-45
    "*FRICTION\n0.2\n"                                                                                  // 46-47
    "*CONTACT PAIR, INTERACTION=I\nFOOT, FLOOR\n"                                                       // 48-49
    "*AMPLITUDE, NAME=A\n0., 0., 1e-3, 1.\n"                                                            // 50-51
    "*STEP\n*DYNAMIC, DIRECT\n1e-6, 1e-3\n"                                                             // 52-54
    "*CLOAD, AMPLITUDE=A\n15, 1, 5.\n"                                                                  // 55-56
    "*END STEP\n";                                                                                      // 57

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t found = text.find(from);
  EXPECT_NE(found, std::string::npos) << from;
  return found == std::string::npos ? text : text.replace(found, from.size(), to);
}

inline std::string no_file(const std::string& path, const Location& where) {
  throw CaseError(where, "*INCLUDE", "no file " + path, "");
}

inline TranslatedDeck translated(const std::string& text, const std::vector<std::string>& accepted = {}) {
  return translate_deck(text, "x.inp", accepted, no_file);
}

inline Case case_from(const std::string& text, const std::vector<std::string>& accepted = {}) {
  return case_of(translated(text, accepted).tree, "x.inp");
}

inline bool has_note(const TranslatedDeck& deck, const std::string& part) {
  return std::any_of(deck.notes.begin(), deck.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

inline std::string message_of(const std::string& deck, const std::vector<std::string>& accepted = {}) {
  try {
    translated(deck, accepted);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace carom::test
