// Lines of a text.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace carom {

/// Without blanks at its ends.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// The next line from `at` on, which moves behind it.
inline std::string_view take_line(std::string_view bytes, std::size_t& at) {
  const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
  const std::string_view line = bytes.substr(at, end - at);
  at = std::min(end + 1, bytes.size());
  return line;
}

}  // namespace carom
