#include "casefile/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

namespace carom {

void refuse(const Node& node, const KeyDescription& key, const ReadContext& at) {
  std::string suggestion;
  const auto* text = std::get_if<std::string>(&node.value);
  if (text != nullptr) {
    const std::string near = nearest(*text, key.options.choices);
    if (!near.empty()) suggestion = fmt::format("Did you mean {}?", toml_string(near));
    if (key.shape == Shape::number || key.shape == Shape::integer) suggestion = "Write the number without quotes.";
  }
  if (suggestion.empty()) suggestion = key.options.remedy;
  throw CaseError(node.where, at.path, describe(node), expected_text(key, at.units), suggestion);
}

namespace {

std::optional<double> as_number(const Node& node) {
  if (const auto* number = std::get_if<double>(&node.value)) return *number;
  if (const auto* integer = std::get_if<std::int64_t>(&node.value)) return static_cast<double>(*integer);
  return std::nullopt;
}

double number(const Node& node, const KeyDescription& key, const ReadContext& at) {
  const std::optional<double> found = as_number(node);
  if (!found || !key.options.range.contains(*found)) refuse(node, key, at);
  return *found;
}

std::int64_t integer(const Node& node, const KeyDescription& key, const ReadContext& at) {
  const auto* found = std::get_if<std::int64_t>(&node.value);
  if (found == nullptr || !key.options.range.contains(static_cast<double>(*found))) refuse(node, key, at);
  return *found;
}

int small_integer(const Node& node, const KeyDescription& key, const ReadContext& at) {
  const std::int64_t found = integer(node, key, at);
  constexpr int most = std::numeric_limits<int>::max();
  if (found > most || found < -most) {
    throw CaseError(node.where, at.path, describe(node), fmt::format("an integer of at most {}", most));
  }
  return static_cast<int>(found);
}

/// What the entries of a list take.
KeyDescription entry_of(const KeyDescription& key, Shape shape) {
  KeyDescription entry = key;
  entry.shape = shape;
  return entry;
}

const List& list(const Node& node, const KeyDescription& key, const ReadContext& at) {
  const auto* found = std::get_if<List>(&node.value);
  if (found == nullptr) refuse(node, key, at);
  return *found;
}

template <std::size_t n>
void decode_numbers(const Node& node, const KeyDescription& key, const ReadContext& at, std::array<double, n>& value) {
  const List& entries = list(node, key, at);
  if (entries.size() != n) refuse(node, key, at);
  for (std::size_t i = 0; i < n; ++i) value[i] = number(entries[i], entry_of(key, Shape::number), at.entry(i));
}

template <std::size_t n>
void decode_integers(const Node& node, const KeyDescription& key, const ReadContext& at, std::array<int, n>& value) {
  const List& entries = list(node, key, at);
  if (entries.size() != n) refuse(node, key, at);
  for (std::size_t i = 0; i < n; ++i) value[i] = small_integer(entries[i], entry_of(key, Shape::integer), at.entry(i));
}

/// Numbers as doubles, integers as std::int64_t.
template <class Number, class Values>
Node encode_list(const Values& values) {
  List entries;
  for (const auto entry : values) entries.push_back({Number{entry}, {}});
  return Node{entries, {}};
}

Node encode_texts(std::span<const Located<std::string>> values) {
  List entries;
  for (const Located<std::string>& entry : values) entries.push_back({*entry, {}});
  return Node{entries, {}};
}

}  // namespace

std::size_t decode_choice(const Node& node, const KeyDescription& key, const ReadContext& at) {
  const std::vector<std::string>& choices = key.options.choices;
  const auto* text = std::get_if<std::string>(&node.value);
  if (text == nullptr) refuse(node, key, at);
  const auto found = std::find(choices.begin(), choices.end(), *text);
  if (found == choices.end()) refuse(node, key, at);
  return static_cast<std::size_t>(found - choices.begin());
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at, bool& value) {
  if (!key.options.choices.empty()) {
    value = decode_choice(node, key, at) == 1;
    return;
  }
  const auto* found = std::get_if<bool>(&node.value);
  if (found == nullptr) refuse(node, key, at);
  value = *found;
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at, int& value) {
  value = key.options.choices.empty() ? small_integer(node, key, at) : static_cast<int>(decode_choice(node, key, at));
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::int64_t& value) {
  value = integer(node, key, at);
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at, double& value) {
  value = number(node, key, at);
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::string& value) {
  const auto* found = std::get_if<std::string>(&node.value);
  if (found == nullptr) refuse(node, key, at);
  if (!key.options.choices.empty() && key.options.others.empty()) decode_choice(node, key, at);
  if (found->empty() && key.options.need == KeyOptions::Need::required) refuse(node, key, at);
  value = *found;
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at, Vec3& value) {
  decode_numbers(node, key, at, value);
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::array<double, 2>& value) {
  decode_numbers(node, key, at, value);
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::array<int, 3>& value) {
  decode_integers(node, key, at, value);
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::array<int, 2>& value) {
  decode_integers(node, key, at, value);
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::array<bool, 3>& axes) {
  const List& entries = list(node, key, at);
  if (entries.empty()) refuse(node, key, at);
  axes = {};
  for (std::size_t i = 0; i < entries.size(); ++i)
    axes[decode_choice(entries[i], entry_of(key, Shape::text), at.entry(i))] = true;
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::vector<double>& value) {
  const List& entries = list(node, key, at);
  if (entries.empty()) refuse(node, key, at);
  value.clear();
  for (std::size_t i = 0; i < entries.size(); ++i)
    value.push_back(number(entries[i], entry_of(key, Shape::number), at.entry(i)));
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at,
            std::vector<std::array<double, 2>>& value) {
  const List& rows = list(node, key, at);
  if (rows.empty()) refuse(node, key, at);
  value.clear();
  for (std::size_t i = 0; i < rows.size(); ++i)
    decode(rows[i], entry_of(key, Shape::pair), at.entry(i), value.emplace_back());
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at,
            std::vector<Located<std::string>>& value) {
  const List& entries = list(node, key, at);
  value.clear();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    std::string choice;
    decode(entries[i], entry_of(key, Shape::text), at.entry(i), choice);
    const auto same = [&choice](const Located<std::string>& other) { return *other == choice; };
    if (std::any_of(value.begin(), value.end(), same)) {
      throw CaseError(entries[i].where, at.entry(i).path, toml_string(choice) + " a second time", "each name once");
    }
    value.push_back({choice, entries[i].where});
  }
}

void decode(const Node& node, const KeyDescription& key, const ReadContext& at,
            std::array<Located<std::string>, 3>& value) {
  const List& entries = list(node, key, at);
  if (entries.size() != value.size()) refuse(node, key, at);
  for (std::size_t i = 0; i < value.size(); ++i) decode(entries[i], entry_of(key, Shape::text), at.entry(i), value[i]);
}

std::optional<Node> encode(bool value, const KeyOptions& options) {
  if (options.choices.empty()) return Node{value, {}};
  return Node{options.choices.at(value ? 1 : 0), {}};
}

std::optional<Node> encode(int value, const KeyOptions& options) {
  if (options.choices.empty()) return Node{std::int64_t{value}, {}};
  return Node{options.choices.at(static_cast<std::size_t>(value)), {}};
}

std::optional<Node> encode(std::int64_t value, const KeyOptions&) {
  return Node{value, {}};
}

std::optional<Node> encode(double value, const KeyOptions&) {
  return Node{value, {}};
}

std::optional<Node> encode(const std::string& value, const KeyOptions&) {
  return Node{value, {}};
}

std::optional<Node> encode(const Vec3& value, const KeyOptions&) {
  return encode_list<double>(value);
}

std::optional<Node> encode(const std::array<double, 2>& value, const KeyOptions&) {
  return encode_list<double>(value);
}

std::optional<Node> encode(const std::array<int, 3>& value, const KeyOptions&) {
  return encode_list<std::int64_t>(value);
}

std::optional<Node> encode(const std::array<int, 2>& value, const KeyOptions&) {
  return encode_list<std::int64_t>(value);
}

std::optional<Node> encode(const std::array<bool, 3>& axes, const KeyOptions& options) {
  List entries;
  for (std::size_t i = 0; i < 3; ++i) {
    if (axes[i]) entries.push_back({options.choices.at(i), {}});
  }
  if (entries.empty()) return std::nullopt;
  return Node{entries, {}};
}

std::optional<Node> encode(const std::vector<double>& value, const KeyOptions&) {
  if (value.empty()) return std::nullopt;  // a list that is written has a value at least
  return encode_list<double>(value);
}

std::optional<Node> encode(const std::vector<std::array<double, 2>>& value, const KeyOptions& options) {
  List rows;
  for (const std::array<double, 2>& row : value) rows.push_back(*encode(row, options));
  return Node{rows, {}};
}

std::optional<Node> encode(const std::vector<Located<std::string>>& value, const KeyOptions&) {
  return encode_texts(value);
}

std::optional<Node> encode(const std::array<Located<std::string>, 3>& value, const KeyOptions&) {
  return encode_texts(value);
}

}  // namespace carom
