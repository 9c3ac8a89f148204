// Decks as keywords and data lines: what the manuals of Abaqus and CalculiX say of their syntax.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "deck/deck_cursor.hpp"
#include "deck/keyword_table.hpp"
#include "deck/statements.hpp"

namespace carom::deck_test {
namespace {

std::string no_file(const std::string& path, const Location& where) {
  throw CaseError(where, "*INCLUDE", "no file " + path, "");
}

Deck read(const std::string& text, const IncludeReader& include = no_file) {
  return read_deck(text, "x.inp", include);
}

/// The fields of all data lines, line by line.
std::vector<std::vector<std::string>> fields_of(const DeckKeyword& keyword) {
  std::vector<std::vector<std::string>> lines;
  for (DeckCursor at(keyword); at.next_line();) {
    lines.emplace_back();
    while (!at.at_end()) lines.back().emplace_back(at.field());
  }
  return lines;
}

using Lines = std::vector<std::vector<std::string>>;

TEST(Deck, BeginsWithAStarAndALetterAfterComments) {
  EXPECT_TRUE(looks_like_deck("** made by hand\n\n*Heading\n"));
  EXPECT_TRUE(looks_like_deck("  *node\r\n"));
  EXPECT_FALSE(looks_like_deck("** only a comment\n"));
  EXPECT_FALSE(looks_like_deck("*1\n"));
  EXPECT_FALSE(looks_like_deck("$MeshFormat\n"));
  EXPECT_FALSE(looks_like_deck(""));
}

TEST(Deck, CaseBlanksQuotesAndLineEndsDoNotMatter) {
  const Deck deck = read("*sOlId Section , eLset = \"my set\", material=Steel\r\n1.0,\r\n*SOLIDSECTION,ELSET=B\n");
  ASSERT_EQ(deck.keywords.size(), 2U);
  EXPECT_EQ(deck.keywords[0].name, "SOLID SECTION");
  EXPECT_EQ(deck.keywords[1].name, "SOLID SECTION");
  EXPECT_EQ(*deck.keywords[0].parameter("ELSET"), "my set");
  EXPECT_EQ(*deck.keywords[0].parameter("MATERIAL"), "Steel");
  EXPECT_EQ(deck.keywords[0].required("ELSET"), "MY SET");
  EXPECT_EQ(fields_of(deck.keywords[0]), (Lines{{"1.0"}}));
}

TEST(Deck, AbbreviationsThatFitOneNameOnly) {
  const Deck deck = read("*BOUND, AMP=A\n*ELAS\n*CONT\n*AMPL, DEF=TABULAR\n");
  EXPECT_EQ(deck.keywords[0].name, "BOUNDARY");
  EXPECT_TRUE(deck.keywords[0].has("AMPLITUDE"));
  EXPECT_EQ(deck.keywords[1].name, "ELASTIC");
  EXPECT_EQ(deck.keywords[2].name, "CONT");  // CONTACT, CONTACT PAIR, CONTROLS, ...
  EXPECT_TRUE(deck.keywords[3].has("DEFINITION"));
}

TEST(Deck, KeywordLinesGoOnAfterAComma) {
  const Deck deck = read("*ELEMENT, TYPE=C3D8,\n** between\n ELSET=A\n1, 2\n");
  ASSERT_EQ(deck.keywords.size(), 1U);
  EXPECT_EQ(*deck.keywords[0].parameter("ELSET"), "A");
  DeckCursor at(deck.keywords[0]);
  ASSERT_TRUE(at.next_line());
  EXPECT_EQ(at.where().line, 4);
}

TEST(Deck, CommentsAndBlankLinesAreNoDataAndCountAsLines) {
  const Deck deck = read("*NODE\n** one\n\n1, 2.\n  ** two\n3\n");
  EXPECT_EQ(fields_of(deck.keywords[0]), (Lines{{"1", "2."}, {"3"}}));
  DeckCursor at(deck.keywords[0]);
  at.next_line();
  EXPECT_EQ(at.where().line, 4);
  at.next_line();
  EXPECT_EQ(at.where().line, 6);
}

TEST(Deck, FieldsMayBeBlankAndACommaAtTheEndBeginsNone) {
  const Deck deck = read("*STATIC\n , 1.0,, 2 ,\n");
  EXPECT_EQ(fields_of(deck.keywords[0]), (Lines{{"", "1.0", "", "2"}}));
}

TEST(Deck, NumbersOfFortran) {
  EXPECT_EQ(as_real("1.5D-3"), 1.5e-3);
  EXPECT_EQ(as_real("1.5d+3"), 1.5e3);
  EXPECT_EQ(as_real("+2."), 2.0);
  EXPECT_EQ(as_real(".5E1"), 5.0);
  EXPECT_FALSE(as_real("1.5F3"));
  EXPECT_FALSE(as_real("nan"));
  EXPECT_FALSE(as_real("inf"));
  EXPECT_FALSE(as_real("1e999"));
  EXPECT_EQ(as_real("1e-999"), 0.0);
  EXPECT_FALSE(as_real(""));
  EXPECT_EQ(as_integer("+12"), 12);
  EXPECT_FALSE(as_integer("12."));
}

TEST(Deck, IncludedFilesStandInTheirPlaceAndMayGoOnWithData) {
  const std::map<std::string, std::string> files{{"sub/nodes.inc", "2, 1.\n*INCLUDE, INPUT=more.inc\n"},
                                                 {"sub/more.inc", "3, 2.\n"}};
  const Deck deck = read("*NODE\n1, 0.\n*INCLUDE, INPUT=sub/nodes.inc\n4, 3.\n*ELSET, ELSET=A\n",
                         [&](const std::string& path, const Location&) { return files.at(path); });
  ASSERT_EQ(deck.keywords.size(), 2U);
  EXPECT_EQ(fields_of(deck.keywords[0]), (Lines{{"1", "0."}, {"2", "1."}, {"3", "2."}, {"4", "3."}}));
  DeckCursor at(deck.keywords[0]);
  at.next_line();
  at.next_line();
  EXPECT_EQ(to_string(at.where()), "sub/nodes.inc:1");
}

/// Abaqus keywords such as *NODE and *ELEMENT: INPUT names a file of their data lines.
TEST(Deck, DataLinesMayStandInAFileOfTheirOwn) {
  const auto files = [](const std::string& text) {
    return [text](const std::string& path, const Location&) { return path == "sub/nodes.dat" ? text : ""; };
  };
  const std::string text = "*NODE, NSET=N, INPUT=sub/nodes.dat\n*ELSET, ELSET=A\n1\n";
  const Deck deck = read(text, files("** two\n1, 0.\n2, 1.\n"));
  ASSERT_EQ(deck.keywords.size(), 2U);
  EXPECT_EQ(fields_of(deck.keywords[0]), (Lines{{"1", "0."}, {"2", "1."}}));
  EXPECT_TRUE(deck.keywords[0].has("NSET"));
  EXPECT_FALSE(deck.keywords[0].has("INPUT"));
  DeckCursor at(deck.keywords[0]);
  at.next_line();
  EXPECT_EQ(to_string(at.where()), "sub/nodes.dat:2");
  try {
    read(text, files("1, 0.\n*ELEMENT\n"));
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_EQ(to_string(error.where()), "sub/nodes.dat:2");
  }
}

TEST(Deck, InstancesRepeatTheKeywordsOfTheirPart) {
  const Deck deck = read(
      "*PART, NAME=P\n*NODE\n1,1.,0.,0.\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n"
      "*INSTANCE, NAME=J, PART=p\n0.,0.,2.\n0.,0.,0.,0.,0.,1.,90.\n*END INSTANCE\n*NSET, NSET=N\n*END "
      "ASSEMBLY\n*STEP\n");
  const Statements statements = statements_of(deck);
  ASSERT_EQ(statements.list.size(), 4U);
  EXPECT_EQ(statements.scopes[1].prefix, "I.");
  EXPECT_EQ(statements.list[1].scope, 2);
  EXPECT_EQ(statements.list[2].keyword->name, "NSET");
  EXPECT_EQ(statements.list[2].scope, 0);
  const Vec3 x = statements.scopes[2].placement.of({1.0, 0.0, 0.0});  // (1, 0, 2), turned by a right angle about z
  EXPECT_NEAR(x[0], 0.0, 1e-15);
  EXPECT_NEAR(x[1], 1.0, 1e-15);
  EXPECT_EQ(x[2], 2.0);
}

TEST(Deck, TheTableIsInOrderAndItsNamesAreFound) {
  std::set<std::string> names;
  for (const KeywordEntry& entry : keyword_table()) {
    EXPECT_TRUE(names.insert(std::string(entry.name)).second) << entry.name;
    EXPECT_EQ(find_keyword(entry.name), &entry) << entry.name;
    EXPECT_EQ(find_keyword(without_blanks(entry.name)), &entry) << entry.name;
    EXPECT_FALSE(entry.meaning.empty()) << entry.name;
  }
}

}  // namespace
}  // namespace carom::deck_test
