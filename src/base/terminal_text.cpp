#include "base/terminal_text.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace carom {

std::string terminal_text(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool is_plain_control = (c < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (c == 0xc2 && next >= 0x80 && next < 0xa0) {
      safe += fmt::format("\\x{:02x}", next);
      ++i;
    } else if (is_plain_control) {
      safe += fmt::format("\\x{:02x}", c);
    } else {
      safe += text[i];
    }
  }
  return safe;
}

std::string printable(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string result(1, '\'');
  for (const char c : text.substr(0, kMost)) {
    if (c >= 32 && c < 127)
      result += c;
    else
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return result + (text.size() > kMost ? "...'" : "'");
}

}  // namespace carom
