#include "casefile/write_toml.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace carom {

namespace {

struct WriteValue {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return toml_number(value); }
  std::string operator()(const std::string& value) const { return toml_string(value); }
  std::string operator()(const List& value) const {
    std::string text;
    for (const Node& entry : value) text += (text.empty() ? "" : ", ") + toml_value(entry);
    return "[" + text + "]";
  }
  std::string operator()(const Table& value) const {
    std::string text;
    for (const Member& m : value.members) {
      text += (text.empty() ? " " : ", ") + toml_key(m.key) + " = " + toml_value(m.value);
    }
    return "{" + text + " }";
  }
  std::string operator()(Date) const { return "\"\""; }
};

bool is_list_of_tables(const Node& node) {
  const auto* list = std::get_if<List>(&node.value);
  return list != nullptr && !list->empty() && std::holds_alternative<Table>(list->front().value);
}

bool is_section(const Node& node) {
  return std::holds_alternative<Table>(node.value) || is_list_of_tables(node);
}

void write_values(const Table& table, std::string& text) {
  for (const Member& m : table.members) {
    if (!is_section(m.value)) text += toml_key(m.key) + " = " + toml_value(m.value) + "\n";
  }
}

void write_entries(const std::string& path, const List& entries, const SectionComment& comment, std::string& text) {
  for (const Node& entry : entries) {
    text += "\n" + comment(entry) + "[[" + path + "]]\n";
    for (const Member& m : std::get<Table>(entry.value).members) {
      text += toml_key(m.key) + " = " + toml_value(m.value) + "\n";
    }
  }
}

void write_sections(const std::string& path, const Table& table, const SectionComment& comment, std::string& text) {
  for (const Member& m : table.members) {
    const std::string child = join(path, m.key);
    if (is_list_of_tables(m.value)) write_entries(child, std::get<List>(m.value.value), comment, text);
    const auto* section = std::get_if<Table>(&m.value.value);
    if (section == nullptr) continue;
    const auto& members = section->members;
    const auto plain = [](const Member& member) { return !is_section(member.value); };
    if (members.empty() || std::any_of(members.begin(), members.end(), plain))
      text += "\n" + comment(m.value) + "[" + child + "]\n";
    write_values(*section, text);
    write_sections(child, *section, comment, text);
  }
}

}  // namespace

std::string toml_value(const Node& node) {
  return std::visit(WriteValue{}, node.value);
}

std::string write_toml(const Node& root) {
  return write_toml(root, [](const Node&) { return std::string(); });
}

std::string write_toml(const Node& root, const SectionComment& comment) {
  std::string text;
  const Table& table = std::get<Table>(root.value);
  write_values(table, text);
  write_sections("", table, comment, text);
  return text;
}

}  // namespace carom
