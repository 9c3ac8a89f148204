#include "report/case_differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include "casefile/read_toml.hpp"
#include "casefile/write_toml.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

/// The values of a tree by their paths, in its order.
struct Flat {
  std::string folder;
  std::vector<std::string> paths;
  std::map<std::string, std::string> values;

  void set(const std::string& path, const Node& node) {
    std::string value = toml_value(node);
    if (const auto* text = std::get_if<std::string>(&node.value); text != nullptr && !text->empty()) {
      const fs::path file = fs::path(folder) / *text;
      std::error_code error;
      if (fs::exists(file, error)) value = toml_string(fs::weakly_canonical(file, error).generic_string());
    }
    if (values.emplace(path, value).second) paths.push_back(path);
  }
};

/// How the entries of a list are told apart: by their names where each has its own.
std::vector<std::string> names_of(const List& entries) {
  std::vector<std::string> names;
  for (const Node& entry : entries) {
    const Node* name = find(entry, "name");
    const auto* text = name == nullptr ? nullptr : std::get_if<std::string>(&name->value);
    if (text != nullptr) names.push_back(*text);
  }
  if (std::set(names.begin(), names.end()).size() == entries.size()) return names;
  names.clear();
  for (std::size_t i = 0; i < entries.size(); ++i) names.push_back(fmt::format("{}", i + 1));
  return names;
}

void flatten(const Node& node, const std::string& path, Flat& flat) {
  if (path == "title" || path == "check") return;
  if (const auto* table = std::get_if<Table>(&node.value)) {
    for (const Member& member : table->members) flatten(member.value, join(path, member.key), flat);
    return;
  }
  const auto* list = std::get_if<List>(&node.value);
  const auto is_table = [](const Node& entry) { return std::holds_alternative<Table>(entry.value); };
  if (list == nullptr || list->empty() || !std::all_of(list->begin(), list->end(), is_table)) {
    flat.set(path, node);
    return;
  }
  const std::vector<std::string> names = names_of(*list);
  for (std::size_t i = 0; i < list->size(); ++i) flatten((*list)[i], fmt::format("{}[{}]", path, names[i]), flat);
}

}  // namespace

std::vector<KeyDifference> case_differences(const std::vector<CaseText>& cases) {
  std::vector<Flat> all;
  for (const CaseText& one : cases) {
    all.push_back({one.folder, {}, {}});
    flatten(read_toml(one.text, one.folder), "", all.back());
  }
  std::vector<KeyDifference> differences;
  std::set<std::string> seen;
  for (const Flat& flat : all) {
    for (const std::string& path : flat.paths) {
      if (!seen.insert(path).second) continue;
      KeyDifference difference{path, {}};
      for (const Flat& other : all) {
        const auto found = other.values.find(path);
        difference.values.push_back(found == other.values.end() ? "–" : found->second);
      }
      const bool is_same = std::all_of(difference.values.begin(), difference.values.end(),
                                       [&](const std::string& value) { return value == difference.values.front(); });
      if (!is_same) differences.push_back(std::move(difference));
    }
  }
  return differences;
}

}  // namespace carom
