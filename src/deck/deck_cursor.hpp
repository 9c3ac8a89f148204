// A place in the data lines of a keyword: fields, numbers, and errors that say where they are.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "deck/deck.hpp"

namespace carom {

/// Goes through the data lines of a keyword; blank lines and comments are passed over. The deck must outlive it.
class DeckCursor {
 public:
  explicit DeckCursor(const DeckKeyword& keyword) : keyword_(keyword) {}

  /// Goes to the next line; false where there is none.
  bool next_line();
  /// Is nothing left on the line?
  bool at_end() const { return rest_begin_ > line_.size(); }
  /// The next field of the line, without outer blanks and quotes; "" where it is blank or the line has ended.
  std::string_view field();
  /// The next field as a number; `what` is for the message. Exponents may be written with D.
  std::int64_t integer(std::string_view what);
  double real(std::string_view what);
  /// The same, or what stands for a blank field.
  double real_or(double otherwise, std::string_view what);
  /// Throws where the line goes on with something; `expected` is for the message.
  void end_line(std::string expected);
  /// The whole line without outer blanks.
  std::string_view line() const;
  Location where() const;

  [[noreturn]] void fail(std::string found, std::string expected, std::string suggestion = {}) const;

 private:
  const DeckKeyword& keyword_;
  std::size_t chunk_ = 0, position_ = 0;
  int line_number_ = 0, next_number_ = 0;
  const std::string* file_ = nullptr;
  std::string_view line_;
  std::size_t rest_begin_ = 1;
};

/// The text as a number, or nothing.
std::optional<std::int64_t> as_integer(std::string_view text);
std::optional<double> as_real(std::string_view text);

}  // namespace carom
