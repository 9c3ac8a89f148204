// Files of other programs that are given as decks or cases.
#include "deck/foreign.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/errors.hpp"
#include "deck/deck.hpp"

namespace carom::deck_foreign_test {
namespace {

std::string message_of(const std::string& text) {
  try {
    refuse_foreign(text, "x.inp");
  } catch (const CaseError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Foreign, FilesAreNamedByTheLineThatShowsIt) {
  const std::string rest =
      "; expected a deck of Abaqus or CalculiX (.inp), or a case file (.toml). Bring the mesh by way of Gmsh or of an "
      "Abaqus deck (.inp), and write the rest as a case: docs/case_format.md has an example of each section.";
  EXPECT_EQ(message_of("$ comment\n*KEYWORD\n*NODE\n1,0,0,0\n"),
            "x.inp:2: found '*KEYWORD', which seems to be a deck of LS-DYNA" + rest);
  EXPECT_EQ(message_of("*TITLE\na bar\n*control_termination\n1.0\n"),
            "x.inp:3: found '*control_termination', which seems to be a deck of LS-DYNA" + rest);
  EXPECT_EQ(message_of("*NODE\n1,0,0,0\n*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n"),
            "x.inp:3: found '*ELEMENT_SOLID', which seems to be a deck of LS-DYNA" + rest);
  EXPECT_EQ(message_of("$ bulk\nSOL 101\nCEND\nBEGIN BULK\n"),
            "x.inp:3: found 'CEND', which seems to be a file of Nastran" + rest);
  EXPECT_EQ(message_of("GRID*    1               0.      0.\n"),
            "x.inp:1: found 'GRID*    1               0.      0.', which seems to be a file of Nastran" + rest);
  EXPECT_EQ(message_of("#RADIOSS STARTER\n/BEGIN\nbar\n"),
            "x.inp:2: found '/BEGIN', which seems to be a file of Radioss" + rest);
  EXPECT_EQ(message_of("/PREP7\nN,1,0,0,0\n"),
            "x.inp:1: found '/PREP7', which seems to be an input file of Ansys" + rest);
}

TEST(Foreign, FilesWithoutAnythingAreEmpty) {
  const std::string expected = "; expected a deck of Abaqus or CalculiX (.inp), or a case file (.toml). ";
  for (const char* empty : {"", "\n \n"})
    EXPECT_EQ(message_of(empty),
              "x.inp: found an empty file" + expected + "Was it written to its end, and in this folder?");
  EXPECT_EQ(message_of("** only\n** comments\n"),
            "x.inp: found comments alone" + expected + "A deck has keywords, such as *NODE, behind them.");
}

// Sets may be called GRID, keywords may be misspelt, and keys of cases may be anything.
TEST(Foreign, DecksAndCasesAreNot) {
  for (const char* text : {"*HEADING\nGRID 1\n*NODE\n1,0,0,0\n", "*BOUNDARY\nGRID, 1, 3\n/NODE\n", "*SOLID_SECTION\n",
                           "*CONTACT_PAIR\n", "title = \"a\"\n[mesh]\n", "# a comment\nGRID = 1\n"})
    EXPECT_EQ(message_of(text), "no error") << text;
}

}  // namespace
}  // namespace carom::deck_foreign_test
