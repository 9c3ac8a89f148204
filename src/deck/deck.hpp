// A deck of Abaqus or CalculiX as its keywords, parameters and data lines; knows nothing of what they mean.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.hpp"

namespace carom {

struct DeckParameter {
  std::string name;   ///< as the table of keywords writes it
  std::string value;  ///< without quotes and outer blanks; "" where there is none
};

/// Data lines that stand together in one file, comments and blank lines among them.
struct DeckChunk {
  const std::string* file = nullptr;  ///< its name
  int first_line = 1;
  std::string_view text;
};

struct DeckKeyword {
  std::string name;  ///< as the table of keywords writes it, else in upper case
  std::vector<DeckParameter> parameters;
  Location where;
  std::vector<DeckChunk> data;

  /// The value of a parameter, or nullptr where it is not given.
  const std::string* parameter(std::string_view wanted) const;
  bool has(std::string_view wanted) const { return parameter(wanted) != nullptr; }
  /// The same in upper case; CaseError where it is not given or has no value.
  std::string required(std::string_view wanted) const;
  /// CaseError at the keyword.
  [[noreturn]] void fail(std::string found, std::string expected, std::string suggestion = {}) const;
};

/// Gives the bytes of an included file by its path; throws CaseError at `where` when it cannot.
using IncludeReader = std::function<std::string(const std::string& path, const Location& where)>;

/// The keywords of a deck in their order, those of included files in the place of *INCLUDE, and the texts they lie in.
struct Deck {
  struct File {
    std::string name, bytes;
  };
  std::vector<std::unique_ptr<File>> files;
  std::vector<DeckKeyword> keywords;
};

/// Does a file begin as a deck does: its first line that is no comment with * and a letter?
bool looks_like_deck(std::string_view bytes);

/// Splits a deck into its keywords. Lines that end with a comma go on, upper and lower case are the same, ** begins
/// a comment. `source` names the file in messages; *INCLUDE counts from its folder. Throws CaseError.
Deck read_deck(std::string bytes, const std::string& source, const IncludeReader& include);

/// Reads files of the disk.
std::string read_included(const std::string& path, const Location& where);

/// In upper case, ASCII letters alone.
std::string upper_case(std::string_view text);
/// The name that a text is, in upper case: quotes may stand around parts of it, as in "Part 1-1".Top.
std::string deck_name(std::string_view text);

}  // namespace carom
