// A parsed text as a tree of values, each with its place; knows nothing of the format it is written in.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/errors.hpp"

namespace carom {

struct Node;
struct Member;

using List = std::vector<Node>;

/// Named values in the order of the text.
struct Table {
  std::vector<Member> members;

  const Node* find(std::string_view key) const;
};

/// A date or time, which no key takes.
struct Date {};

struct Node {
  std::variant<bool, std::int64_t, double, std::string, List, Table, Date> value;
  Location where;
};

struct Member {
  std::string key;
  Location where;  ///< of the key
  Node value;
};

/// The value as a message shows it: the number or quoted text itself, else its kind ("a list of 2 values").
std::string describe(const Node& node);

/// The node at a dotted path below `root`, or nullptr.
const Node* find(const Node& root, std::string_view path);

/// path.key, with the key quoted where it is not a bare key.
std::string join(const std::string& path, const std::string& key);

/// The key as TOML writes it: bare, or quoted where it must be.
std::string toml_key(const std::string& key);
/// "text" with TOML's escapes.
std::string toml_string(std::string_view text);
/// Shortest decimal number that reads back to the same bits; always with a point or an exponent.
std::string toml_number(double number);

}  // namespace carom
