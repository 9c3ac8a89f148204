// The keywords of Abaqus and CalculiX that Carom knows, and what becomes of each: one table, which the readers, the
// messages and docs/decks.md share.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace carom {

/// What becomes of a keyword.
enum class KeywordUse : std::uint8_t {
  mesh,         ///< nodes, cells, groups, parts
  model,        ///< materials, sections, contact, initial state
  step,         ///< what a step says
  output,       ///< asks for results only: a note
  solver,       ///< steers the other program's solver: a note
  refused,      ///< changes the physics in a way that Carom cannot: the run is refused unless the user accepts it
  refused_mesh  ///< makes nodes or cells: the mesh would not be what the deck means, so there is no accepting it
};

struct KeywordEntry {
  std::string_view name;  ///< with its blanks, "SOLID SECTION"
  KeywordUse use{};
  std::string_view parameters{};  ///< those that are understood, with commas between
  std::string_view noted{};       ///< those that change nothing here and are listed as notes
  std::string_view meaning{};     ///< what becomes of it, or what its loss would mean
};

/// In alphabetical order.
std::span<const KeywordEntry> keyword_table();

/// The entry of a keyword in upper case; blanks do not count, and a beginning of at least four letters that fits one
/// name only will do. nullptr where there is none.
const KeywordEntry* find_keyword(std::string_view name);

/// The entry's name of a parameter in upper case: blanks do not count, and a beginning of at least three letters that
/// fits one name only will do. The text itself, without its blanks, where the entry has no such parameter.
std::string parameter_name(const KeywordEntry& entry, std::string_view given);

/// Is `name` in a list with commas between?
bool is_listed(std::string_view list, std::string_view name);

/// Upper case of ASCII letters, without blanks and tabs.
std::string without_blanks(std::string_view text);

}  // namespace carom
