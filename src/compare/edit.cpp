#include "compare/edit.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "casefile/read_toml.hpp"

namespace carom::compare {

namespace {

/// `name` or `name[index]`.
struct Step {
  std::string_view name;
  std::optional<std::size_t> index;
};

Step step_of(std::string_view text) {
  const std::size_t bracket = text.find('[');
  if (bracket == std::string_view::npos || !text.ends_with(']')) return {text, {}};
  std::size_t index = 0;
  std::from_chars(text.data() + bracket + 1, text.data() + text.size() - 1, index);
  return {text.substr(0, bracket), index};
}

Node* member(Node& node, std::string_view key) {
  auto* table = std::get_if<Table>(&node.value);
  if (table == nullptr) return nullptr;
  const auto found =
      std::find_if(table->members.begin(), table->members.end(), [key](const Member& m) { return m.key == key; });
  return found == table->members.end() ? nullptr : &found->value;
}

Node* child(Node& node, const Step& step) {
  Node* found = member(node, step.name);
  if (found == nullptr || !step.index) return found;
  auto* list = std::get_if<List>(&found->value);
  return list != nullptr && *step.index < list->size() ? &(*list)[*step.index] : nullptr;
}

void set_member(Node& node, const std::string& key, Node value) {
  if (Node* old = member(node, key)) {
    *old = std::move(value);
  } else {
    std::get<Table>(node.value).members.push_back({key, {}, std::move(value)});
  }
}

double number_of(const Node& node) {
  if (const auto* integer = std::get_if<std::int64_t>(&node.value)) return static_cast<double>(*integer);
  return std::get<double>(node.value);
}

/// Position of the longest edge of a block.
std::size_t longest_edge(const Node& block) {
  const List& size = std::get<List>(find(block, "size")->value);
  const auto longest = std::max_element(size.begin(), size.end(),
                                        [](const Node& a, const Node& b) { return number_of(a) < number_of(b); });
  return static_cast<std::size_t>(longest - size.begin());
}

}  // namespace

Node* find_at(Node& root, std::string_view path) {
  Node* node = &root;
  while (node != nullptr && !path.empty()) {
    const std::size_t dot = path.find('.');
    node = child(*node, step_of(path.substr(0, dot)));
    path = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
  }
  return node;
}

void set_key(Node& root, const std::string& section, const std::string& key, Node value) {
  if (member(root, section) == nullptr) set_member(root, section, Node{Table{}, {}});
  set_member(*member(root, section), key, std::move(value));
}

bool erase_at(Node& root, std::string_view path) {
  const std::size_t dot = path.rfind('.');
  Node* parent = dot == std::string_view::npos ? &root : find_at(root, path.substr(0, dot));
  auto* table = parent == nullptr ? nullptr : std::get_if<Table>(&parent->value);
  if (table == nullptr) return false;
  const std::string_view key = dot == std::string_view::npos ? path : path.substr(dot + 1);
  return std::erase_if(table->members, [key](const Member& m) { return m.key == key; }) > 0;
}

Node value_of(const std::string& word) {
  try {
    const Node root = read_toml("value = " + word + "\n", "command line");
    if (const Node* value = find(root, "value")) return *value;
  } catch (const CaseError&) {  // a bare word
  }
  return {word, {}};
}

double number_at(Node& root, std::string_view path) {
  return number_of(*find_at(root, path));
}

std::vector<std::string> set_scheme(Node& root, const std::string& name_key, const std::string& word) {
  std::size_t end = word.find(':');
  set_key(root, "scheme", name_key, {word.substr(0, end), {}});
  std::vector<std::string> paths{join("scheme", name_key)};
  while (end != std::string::npos) {
    const std::size_t begin = end + 1;
    end = word.find(':', begin);
    const std::string part = word.substr(begin, end == std::string::npos ? end : end - begin);
    const std::size_t equals = part.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw CaseError({"command line"}, "scheme." + name_key, toml_string(word), "NAME or NAME:KEY=VALUE:...");
    }
    const std::string key = part.substr(0, equals);
    set_key(root, "scheme", key, value_of(part.substr(equals + 1)));
    paths.push_back(join("scheme", key));
  }
  return paths;
}

void set_cells(Node& root, int cells) {
  Node* blocks = find_at(root, "mesh.block");
  if (blocks == nullptr || find_at(root, "mesh.file") != nullptr) {
    throw CaseError({"command line"}, "--cells", "a case whose mesh comes from a file",
                    "a case of [[mesh.block]]s alone", "Meshes of files are made finer by --refine 0,1,2.");
  }
  for (Node& block : std::get<List>(blocks->value)) {
    Node& given = *member(block, "divisions");
    if (!std::holds_alternative<List>(given.value)) {  // of a bar
      given.value = std::int64_t{cells};
      continue;
    }
    const std::size_t longest = longest_edge(block);
    List& divisions = std::get<List>(given.value);
    const double scale = cells / number_of(divisions[longest]);
    for (std::size_t i = 0; i < divisions.size(); ++i) {
      const double old = number_of(divisions[i]);
      if (i == longest) {
        divisions[i].value = std::int64_t{cells};
      } else if (old > 1.0) {
        divisions[i].value = std::max(std::int64_t{1}, static_cast<std::int64_t>(std::lround(old * scale)));
      }
    }
  }
}

int cells_of(const Node& root) {
  const Node* blocks = find(root, "mesh.block");
  if (blocks == nullptr) return 0;
  const Node& first = std::get<List>(blocks->value).front();
  const Node& divisions = *find(first, "divisions");
  if (!std::holds_alternative<List>(divisions.value)) return static_cast<int>(number_of(divisions));
  return static_cast<int>(number_of(std::get<List>(divisions.value)[longest_edge(first)]));
}

}  // namespace carom::compare
