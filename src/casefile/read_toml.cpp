#include "casefile/read_toml.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
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

/// What helps where a line `key = value` is no TOML.
std::string remedy_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  const std::size_t equals = std::min(line.find('='), line.size());
  const std::string_view key = trimmed(line.substr(0, equals)),
                         value = trimmed(line.substr(std::min(equals + 1, line.size())));
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const std::size_t end_of_number = value.find_first_not_of("+-.0123456789eE ");
  if (!value.empty() && !is_letter(value[0]) && end_of_number != 0 && end_of_number != std::string_view::npos) {
    if (value[end_of_number] == ',') return "Numbers have a point, and nothing between thousands: 210000.0, 2.1e5.";
    if (is_letter(value[end_of_number]))
      return "Numbers stand without a unit: all are in the system that `units` names.";
  }
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
