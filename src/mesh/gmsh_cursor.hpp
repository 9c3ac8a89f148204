// A place in the bytes of a Gmsh file: sections, words, and errors that say where they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/terminal_text.hpp"

namespace carom {

/// Reads words of text from the bytes of a file and knows section, line and offset for messages.
/// The bytes must outlive the cursor.
class GmshCursor {
 public:
  GmshCursor(std::string_view bytes, std::string source) : bytes_(bytes), source_(std::move(source)) {}

  /// Skips blank space and reads "$Name"; "" at the end of the file. Throws CaseError when something else stands here.
  std::string next_section();
  /// Throws CaseError unless "$End<section>" comes next.
  void end_section();
  /// Goes past "$End<section>"; throws CaseError when there is none.
  void skip_section();

  /// Begins the next line that is not blank.
  void next_record();
  /// Throws CaseError when something is left on the line.
  void end_record();
  /// The next word on this line; `what` (for the message) when the line or the file ends before it.
  std::string_view word(std::string_view what);
  std::int64_t integer(std::string_view what);
  double real(std::string_view what);
  /// Text in double quotes on this line.
  std::string quoted(std::string_view what);

  /// The next `count` bytes as they are; throws CaseError when the file ends before.
  std::string_view raw(std::size_t count, std::string_view what);
  /// Goes past the next line feed, where the binary data of a section begin.
  void next_line();
  std::size_t remaining() const { return bytes_.size() - position_; }

  /// From now on messages give the byte offset instead of the line.
  void locate_by_offset() { locates_by_offset_ = true; }

  [[noreturn]] void fail(std::string found, std::string expected, std::string suggestion = {}) const;

 private:
  void skip_blanks();
  void skip_space();

  std::string_view bytes_;
  std::string source_;
  std::string section_;
  std::size_t position_ = 0;
  std::size_t failure_ = 0;  ///< where the last word began
  bool locates_by_offset_ = false;
};

}  // namespace carom
