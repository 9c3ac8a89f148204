#include "casefile/read_toml.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <tuple>

#include "base/text_lines.hpp"

namespace carom {

namespace {

class Converter {
 public:
  explicit Converter(std::string file) : file_(std::move(file)) {}

  Node node(const toml::node& from) const {
    Node to;
    to.where = place(from.source());
    if (const auto* boolean = from.as_boolean())
      to.value = boolean->get();
    else if (const auto* integer = from.as_integer())
      to.value = integer->get();
    else if (const auto* number = from.as_floating_point())
      to.value = number->get();
    else if (const auto* text = from.as_string())
      to.value = text->get();
    else if (const auto* list = from.as_array())
      to.value = list_of(*list);
    else if (const auto* table = from.as_table())
      to.value = table_of(*table);
    else
      to.value = Date{};
    return to;
  }

  Location place(const toml::source_region& region) const {
    return {file_, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
  }

 private:
  List list_of(const toml::array& from) const {
    List to;
    to.reserve(from.size());
    for (const toml::node& entry : from) to.push_back(node(entry));
    return to;
  }

  /// In the order of the text: toml++ keeps tables sorted by name.
  Table table_of(const toml::table& from) const {
    Table to;
    to.members.reserve(from.size());
    for (const auto& [key, value] : from)
      to.members.push_back({std::string(key.str()), place(key.source()), node(value)});
    std::stable_sort(to.members.begin(), to.members.end(), [](const Member& a, const Member& b) {
      return std::tie(a.where.line, a.where.column) < std::tie(b.where.line, b.where.column);
    });
    return to;
  }

  std::string file_;
};

/// Refuses keys of more parts than any table has levels: they are read by recursion.
void check_keys(std::string_view text, const std::string& name) {
  constexpr std::ptrdiff_t most = 256;
  int line = 0;
  while (!text.empty()) {
    ++line;
    const std::string_view row = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), row.size() + 1));
    const std::string_view key = row.substr(0, row.find_first_of("=#\"'"));
    const std::ptrdiff_t dots = std::count(key.begin(), key.end(), '.');
    if (dots >= most)
      throw CaseError(Location{name, line, 1}, "", fmt::format("a key of {} parts", dots + 1),
                      fmt::format("at most {}", most), "Keys of a case have two or three parts, as materials.steel.E.");
  }
}

/// A line of the text, from 1.
std::string_view line_of(std::string_view text, int number) {
  std::size_t at = 0;
  for (; number > 1; --number) take_line(text, at);
  return take_line(text, at);
}

/// The number at the beginning of a word as TOML has it; nothing where it is one already, or none.
std::optional<std::string> mended_number(std::string_view word) {
  const auto take = [&word](std::string_view of) {
    const std::string_view taken = word.substr(0, word.find_first_not_of(of));
    word.remove_prefix(taken.size());
    return std::string(taken);
  };
  const auto take_one = [&word](std::string_view of) {
    const bool is_there = !word.empty() && of.find(word.front()) != std::string_view::npos;
    std::string taken(word.substr(0, is_there ? 1 : 0));
    word.remove_prefix(taken.size());
    return taken;
  };
  constexpr std::string_view digits = "0123456789";
  const std::string_view given = word;
  std::string text = take_one("+-");
  const std::string whole = take(digits), point = take_one("."), part = take(digits);
  if (whole.empty() && part.empty()) return std::nullopt;
  std::string exponent = take_one("eEdD");
  if (!exponent.empty()) {
    exponent = "e" + take_one("+-");
    const std::string power = take(digits);
    exponent += power.empty() ? "0" : power;
  }
  if (!word.empty()) return std::nullopt;
  text += whole.empty() ? "0" : whole;
  if (!point.empty()) text += "." + (part.empty() ? "0" : part);
  text += exponent;
  return text == given ? std::nullopt : std::optional(text);
}

/// The first number of a line, outside of texts, that TOML has in another form, and how to write it.
std::string remedy_of_number(std::string_view values) {
  constexpr std::string_view between = " \t\r=,[]{}";
  while (!values.empty()) {
    if (const char c = values.front(); c == '"' || c == '\'') {
      values.remove_prefix(std::min(values.find(c, 1), values.size() - 1) + 1);
      continue;
    }
    const std::string_view word = values.substr(0, values.find_first_of(between));
    if (const std::optional<std::string> mended = mended_number(word))
      return fmt::format(
          "Numbers have digits on both sides of their point, and e before an exponent: write {} instead "
          "of {}.",
          *mended, word);
    values.remove_prefix(std::max<std::size_t>(word.size(), 1));
  }
  return {};
}

/// What helps where a line `key = value` is no TOML.
std::string remedy_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  const std::size_t equals = std::min(line.find('='), line.size());
  const std::string_view key = trimmed(line.substr(0, equals)),
                         value = trimmed(line.substr(std::min(equals + 1, line.size())));
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const std::size_t end_of_number = value.find_first_not_of("+-.0123456789eE ");
  const bool is_number = !value.empty() && !is_letter(value[0]) && end_of_number != 0;
  const char behind = is_number && end_of_number != std::string_view::npos ? value[end_of_number] : '\0';
  if (behind == ',') return "Numbers have a point, and nothing between thousands: 210000.0, 2.1e5.";
  if (std::string number = remedy_of_number(value.empty() ? line : value); !number.empty()) return number;
  if (is_letter(behind)) return "Numbers stand without a unit: all are in the system that `units` names.";
  if (!value.empty() && is_letter(value[0]) && value.find_first_of("\"'[]{},") == std::string_view::npos)
    return fmt::format("Texts stand in quotes: {} = \"{}\"", key, value);
  return "Check quotes, brackets and commas here.";
}

}  // namespace

Node read_toml(std::string_view text, const std::string& name) {
  const Converter converter(name);
  check_keys(text, name);
  try {
    Node root = converter.node(toml::parse(text, name));
    root.where = {name, 1, 1};
    return root;
  } catch (const toml::parse_error& error) {
    const std::string reason(error.description());
    const bool repeated = reason.find("redefine") != std::string::npos;
    const Location place = converter.place(error.source());
    throw CaseError(place, "", "a syntax error (" + reason + ")", "TOML",
                    repeated ? "A name may be given once; sections that repeat are written [[name]]."
                             : remedy_of(line_of(text, place.line)));
  }
}

}  // namespace carom
