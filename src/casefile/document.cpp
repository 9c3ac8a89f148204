#include "casefile/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

namespace carom {

const Node* Table::find(std::string_view key) const {
  const auto found = std::find_if(members.begin(), members.end(), [key](const Member& m) { return m.key == key; });
  return found == members.end() ? nullptr : &found->value;
}

namespace {

std::string counted(std::size_t n, std::string_view what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

struct Describe {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return toml_number(value); }
  std::string operator()(const std::string& value) const {
    constexpr std::size_t longest = 60;
    return toml_string(value.size() > longest ? value.substr(0, longest) + "..." : value);
  }
  std::string operator()(const List& value) const { return "a list of " + counted(value.size(), "value"); }
  std::string operator()(const Table& value) const { return "a table of " + counted(value.members.size(), "key"); }
  std::string operator()(Date) const { return "a date or time"; }
};

}  // namespace

std::string describe(const Node& node) {
  return std::visit(Describe{}, node.value);
}

const Node* find(const Node& root, std::string_view path) {
  const Node* node = &root;
  while (node != nullptr) {
    const auto* table = std::get_if<Table>(&node->value);
    if (table == nullptr) return nullptr;
    const std::size_t dot = path.find('.');
    node = table->find(path.substr(0, dot));
    if (dot == std::string_view::npos) break;
    path.remove_prefix(dot + 1);
  }
  return node;
}

std::string join(const std::string& path, const std::string& key) {
  return path.empty() ? toml_key(key) : path + "." + toml_key(key);
}

std::string toml_key(const std::string& key) {
  const auto bare = [](unsigned char c) { return c < 128 && (std::isalnum(c) != 0 || c == '_' || c == '-'); };
  return !key.empty() && std::all_of(key.begin(), key.end(), bare) ? key : toml_string(key);
}

std::string toml_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (code < 0x20 || code == 0x7f) {
      quoted += fmt::format("\\u{:04X}", code);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string toml_number(double number) {
  std::array<char, 32> digits{};  // the longest double needs 24
  const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  std::string text(digits.data(), written.ptr);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

}  // namespace carom
