// Values of the case between the tree of the text and the members of the structs: one decode/encode pair per type.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "casefile/case.hpp"
#include "casefile/key.hpp"

namespace carom {

/// Where the reader is.
struct ReadContext {
  const Node& root;
  UnitSystem units;
  std::string path;                  ///< dotted path of the section or key
  const std::string& file;           ///< of the case; what it names is relative to its folder
  const SectionDescription& format;  ///< the root section: where a key that is out of place belongs
  CaseErrors& errors;                ///< what is wrong with keys and sections so far; reading goes on behind it

  ReadContext at(const std::string& key) const { return {root, units, join(path, key), file, format, errors}; }
  ReadContext entry(std::size_t i) const {
    return {root, units, path + "[" + std::to_string(i) + "]", file, format, errors};
  }
};

/// Throws the CaseError "found the node; expected what the key takes", with a near spelling among the choices.
[[noreturn]] void refuse(const Node& node, const KeyDescription& key, const ReadContext& at);

/// Position of the text in the key's choices; CaseError when it is none of them.
std::size_t decode_choice(const Node& node, const KeyDescription& key, const ReadContext& at);

// decode: node -> value; CaseError when the node has another form or is out of range. A bool or int member whose key
// has choices is the position of the choice.
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, bool& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, int& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::int64_t& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, double& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::string& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, Vec3& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::array<double, 2>& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::array<int, 3>& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::array<int, 2>& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::array<bool, 3>& axes);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::vector<double>& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at,
            std::vector<std::array<double, 2>>& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at,
            std::vector<Located<std::string>>& value);
void decode(const Node& node, const KeyDescription& key, const ReadContext& at,
            std::array<Located<std::string>, 3>& value);

template <class T>
requires std::is_enum_v<T>
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, T& value) {
  value = static_cast<T>(decode_choice(node, key, at));
}

template <class T>
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, Located<T>& value) {
  decode(node, key, at, value.value);
  value.where = node.where;
}

template <class T>
void decode(const Node& node, const KeyDescription& key, const ReadContext& at, std::optional<T>& value) {
  decode(node, key, at, value.emplace());
}

// encode: value -> node; nothing for an absent value.
std::optional<Node> encode(bool value, const KeyOptions& options);
std::optional<Node> encode(int value, const KeyOptions& options);
std::optional<Node> encode(std::int64_t value, const KeyOptions& options);
std::optional<Node> encode(double value, const KeyOptions& options);
std::optional<Node> encode(const std::string& value, const KeyOptions& options);
std::optional<Node> encode(const Vec3& value, const KeyOptions& options);
std::optional<Node> encode(const std::array<double, 2>& value, const KeyOptions& options);
std::optional<Node> encode(const std::array<int, 3>& value, const KeyOptions& options);
std::optional<Node> encode(const std::array<int, 2>& value, const KeyOptions& options);
std::optional<Node> encode(const std::array<bool, 3>& axes, const KeyOptions& options);
std::optional<Node> encode(const std::vector<double>& value, const KeyOptions& options);
std::optional<Node> encode(const std::vector<std::array<double, 2>>& value, const KeyOptions& options);
std::optional<Node> encode(const std::vector<Located<std::string>>& value, const KeyOptions& options);
std::optional<Node> encode(const std::array<Located<std::string>, 3>& value, const KeyOptions& options);

template <class T>
requires std::is_enum_v<T> std::optional<Node> encode(T value, const KeyOptions& options) {
  return Node{options.choices.at(static_cast<std::size_t>(value)), {}};
}

template <class T>
std::optional<Node> encode(const Located<T>& value, const KeyOptions& options) {
  return encode(value.value, options);
}

template <class T>
std::optional<Node> encode(const std::optional<T>& value, const KeyOptions& options) {
  return value ? encode(*value, options) : std::nullopt;
}

// The form of a member type's value.
template <class T>
struct Unwrapped {
  using Type = T;
};
template <class T>
struct Unwrapped<Located<T>> : Unwrapped<T> {};
template <class T>
struct Unwrapped<std::optional<T>> : Unwrapped<T> {};

template <class Member>
Shape shape_of(const KeyOptions& options) {
  using T = typename Unwrapped<Member>::Type;
  if constexpr (std::is_same_v<T, std::array<bool, 3>>)
    return Shape::texts;
  else if constexpr (std::is_same_v<T, std::vector<Located<std::string>>>)
    return Shape::texts;
  else if constexpr (std::is_same_v<T, std::array<Located<std::string>, 3>>)
    return Shape::formulas;
  else if constexpr (std::is_same_v<T, std::vector<double>>)
    return Shape::numbers;
  else if constexpr (std::is_same_v<T, std::array<int, 3>>)
    return Shape::integers;
  else if constexpr (std::is_same_v<T, Vec3>)
    return Shape::vector;
  else if constexpr (std::is_same_v<T, std::string> || std::is_enum_v<T>)
    return Shape::text;
  else if constexpr (std::is_same_v<T, double>)
    return Shape::number;
  else if constexpr (std::is_same_v<T, bool>)
    return options.choices.empty() ? Shape::boolean : Shape::text;
  else
    return options.choices.empty() ? Shape::integer : Shape::text;
}

/// The place of a value that was not written is that of its section.
template <class T>
void place_default(T&, const Location&) {}
template <class T>
void place_default(Located<T>& value, const Location& section) {
  value.where = section;
}
inline void place_default(std::vector<Located<std::string>>& value, const Location& section) {
  for (Located<std::string>& entry : value) entry.where = section;
}

}  // namespace carom
