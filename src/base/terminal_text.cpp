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
