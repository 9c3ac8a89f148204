// Building the tree of a case: values with their places in the deck.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "casefile/document.hpp"

namespace carom {

inline Node text_node(std::string text, const Location& where) {
  return {std::move(text), where};
}
inline Node number_node(double number, const Location& where) {
  return {number, where};
}
inline Node numbers_node(const std::vector<double>& numbers, const Location& where) {
  List list;
  for (const double number : numbers) list.push_back({number, where});
  return {std::move(list), where};
}
inline Node vector_node(const Vec3& v, const Location& where) {
  return numbers_node({v[0], v[1], v[2]}, where);
}
inline Node texts_node(const std::vector<std::string>& texts, const Location& where) {
  List list;
  for (const std::string& text : texts) list.push_back({text, where});
  return {std::move(list), where};
}

/// A table that is filled key by key, all of one place.
class TableMaker {
 public:
  explicit TableMaker(Location where) : where_(std::move(where)) {}

  TableMaker& add(const std::string& key, Node value) {
    table_.members.push_back({key, value.where, std::move(value)});
    return *this;
  }
  TableMaker& text(const std::string& key, std::string value) { return add(key, text_node(std::move(value), where_)); }
  TableMaker& number(const std::string& key, double value) { return add(key, number_node(value, where_)); }
  TableMaker& vector(const std::string& key, const Vec3& value) { return add(key, vector_node(value, where_)); }
  TableMaker& truth(const std::string& key, bool value) { return add(key, {value, where_}); }
  Node node() { return {std::move(table_), where_}; }

 private:
  Location where_;
  Table table_;
};

}  // namespace carom
