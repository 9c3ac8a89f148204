#include "base/terminal_text.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <utility>

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

bool shows_colours(std::FILE* stream) {
  const char *no = std::getenv("NO_COLOR"), *kind = std::getenv("TERM");
  const bool is_unwanted = no != nullptr && *no != '\0', is_plain = kind == nullptr || std::string_view(kind) == "dumb";
  winsize size{};  // mpirun gives its processes terminals without any, and writes what comes to its own output
  return !is_unwanted && !is_plain && ::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
}

std::string with_colours(std::string_view text) {
  constexpr std::string_view red = "\x1b[1;31m", yellow = "\x1b[1;33m", green = "\x1b[1;32m", blue = "\x1b[36m",
                             off = "\x1b[0m";
  constexpr std::pair<std::string_view, std::string_view> beginnings[]{
      {"error:", red},      {"FAILED", red},  {"failed:", red}, {"good, with doubts:", yellow}, {"warning:", yellow},
      {"stopped:", yellow}, {"good:", green}, {"note:", blue},  {"ready to run", green}};
  std::string coloured;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const auto found = std::ranges::find_if(beginnings, [&](const auto& b) { return line.starts_with(b.first); });
    if (found == std::end(beginnings))
      coloured += line;
    else
      coloured += fmt::format("{}{}{}{}", found->second, found->first, off, line.substr(found->first.size()));
    text.remove_prefix(line.size());
    if (text.empty()) break;
    coloured += '\n';
    text.remove_prefix(1);
  }
  return coloured;
}

void print_to_terminal(std::FILE* stream, std::string_view text) {
  const std::string safe = terminal_text(text);
  std::fputs((shows_colours(stream) ? with_colours(safe) : safe).c_str(), stream);
}

namespace {

/// Bytes of the character of UTF-8 that begins the text (RFC 3629); 0 where none does.
std::size_t character_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  if (length == 0 || text.size() < length) return 0;
  const auto goes_on = [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; };
  return std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length), goes_on) ? length : 0;
}

/// U+0000 to U+001F, and U+007F to U+009F.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  return first < 0x20 || first == 0x7f || (first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0);
}

}  // namespace

std::string as_utf8(std::string_view text) {
  std::string result;
  bool is_utf8 = true;
  for (std::size_t i = 0, length = 0; i < text.size() && is_utf8; i += length) {
    length = character_length(text.substr(i));
    is_utf8 = length > 0;
    if (is_utf8) result += is_control(text.substr(i, length)) ? "?" : text.substr(i, length);
  }
  if (is_utf8) return result;
  result.clear();
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || (byte >= 0x7f && byte < 0xa0))
      result += '?';
    else if (byte < 0x80)
      result += c;
    else
      result += {static_cast<char>(0xc0U | byte >> 6U), static_cast<char>(0x80U | (byte & 0x3fU))};
  }
  return result;
}

std::string printable(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string result(1, '\'');
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t length = character_length(text.substr(i));
    if (i + std::max<std::size_t>(length, 1) > most) break;
    if (length == 0 || is_control(text.substr(i, length)))
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i++]));
    else
      result += text.substr(i, length), i += length;
  }
  return result + (i < text.size() ? "...'" : "'");
}

}  // namespace carom
