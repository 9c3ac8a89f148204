#include "deck/foreign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "base/errors.hpp"
#include "base/terminal_text.hpp"
#include "base/text_lines.hpp"
#include "deck/keyword_table.hpp"

namespace carom {

namespace {

constexpr const char* read_instead = "a deck of Abaqus or CalculiX (.inp), or a case file (.toml)";

template <std::size_t n>
bool is_one_of(const std::array<std::string_view, n>& words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

/// The first word of a line in upper case, up to a blank, a comma or the * of wide fields.
std::string first_word(std::string_view line) {
  return without_blanks(line.substr(0, line.find_first_of(" \t,*", 1)));
}

/// Names of cards that no other text begins lines with (MSC Nastran Quick Reference Guide, bulk data).
bool is_nastran(std::string_view line) {
  constexpr std::array<std::string_view, 10> cards{"GRID",   "CHEXA",  "CTETRA", "CPENTA", "CQUAD4",
                                                   "CTRIA3", "PSOLID", "PSHELL", "CEND",   "ENDDATA"};
  if (line.find('=') != std::string_view::npos) return false;
  return is_one_of(cards, first_word(line)) || without_blanks(line).starts_with("BEGINBULK");
}

bool is_ansys(std::string_view line) {
  constexpr std::array<std::string_view, 8> commands{"/PREP7", "/BATCH", "/COM",  "/TITLE",
                                                     "/CLEAR", "/UNITS", "/NOPR", "/SOLU"};
  return is_one_of(commands, first_word(line));
}

/// Its keywords are paths, /BEGIN or /NODE (Altair Radioss Reference Guide, Starter input).
bool is_radioss(std::string_view line) {
  return line.size() > 1 && line[0] == '/' && std::isupper(static_cast<unsigned char>(line[1])) != 0;
}

bool is_dyna(std::string_view line) {
  return line.starts_with('*') && is_dyna_keyword(without_blanks(line.substr(1, line.find(',') - 1)));
}

/// nullptr where it may be Carom's to read.
const char* program_of(std::string_view line, bool is_in_deck) {
  if (is_dyna(line)) return "a deck of LS-DYNA";
  if (is_in_deck) return nullptr;  // sets may have any name
  if (is_nastran(line)) return "a file of Nastran";
  if (is_ansys(line)) return "an input file of Ansys";
  if (is_radioss(line)) return "a file of Radioss";
  return nullptr;
}

}  // namespace

bool is_dyna_keyword(std::string_view name) {
  constexpr std::array<std::string_view, 20> families{"AIRBAG",  "BOUNDARY", "CONSTRAINED", "CONTACT",    "CONTROL",
                                                      "DAMPING", "DATABASE", "DEFINE",      "DEFORMABLE", "ELEMENT",
                                                      "EOS",     "INITIAL",  "INTERFACE",   "LOAD",       "MAT",
                                                      "NODE",    "PART",     "RIGIDWALL",   "SECTION",    "SET"};
  if (name == "KEYWORD") return true;
  if (!is_one_of(families, name.substr(0, name.find('_'))) || name.find('_') == std::string_view::npos) return false;
  std::string with_blanks(name);
  std::ranges::replace(with_blanks, '_', ' ');
  return find_keyword(with_blanks) == nullptr;  // *CONTACT_PAIR is misspelt
}

void refuse_foreign(std::string_view bytes, const std::string& path) {
  constexpr std::size_t beginning = std::size_t{1} << 16U;
  bool is_empty = true, has_comments_alone = true, is_in_deck = false;
  int number = 0;
  for (std::size_t at = 0; at < std::min(bytes.size(), beginning);) {
    const std::string_view line = trimmed(take_line(bytes, at));
    ++number;
    if (line.empty()) continue;
    is_empty = false;
    if (line.starts_with("**")) continue;
    has_comments_alone = false;
    is_in_deck = is_in_deck || line.starts_with('*');
    if (const char* const program = program_of(line, is_in_deck))
      throw CaseError({path, number, 0}, "", fmt::format("{}, which seems to be {}", printable(line), program),
                      read_instead,
                      "Bring the mesh by way of Gmsh or of an Abaqus deck (.inp), and write the rest as a case: "
                      "docs/case_format.md has an example of each section.");
  }
  if (is_empty)
    throw CaseError({path, 0, 0}, "", "an empty file", read_instead, "Was it written to its end, and in this folder?");
  if (has_comments_alone)
    throw CaseError({path, 0, 0}, "", "comments alone", read_instead,
                    "A deck has keywords, such as *NODE, behind them.");
}

}  // namespace carom
