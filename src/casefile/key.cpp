#include "casefile/key.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

bool Range::contains(double number) const {
  if (!std::isfinite(number)) return false;
  if (low && (number < low->value || (number == low->value && low->side == Bound::Side::open))) return false;
  return !(high && (number > high->value || (number == high->value && high->side == Bound::Side::open)));
}

Range range_of(const Interval& interval) {
  const auto bound = [](double value, bool is_closed) {
    return std::isfinite(value) ? std::optional(Bound{value, is_closed ? Bound::Side::closed : Bound::Side::open})
                                : std::nullopt;
  };
  return {bound(interval.low, interval.is_closed_low), bound(interval.high, interval.is_closed_high)};
}

Range greater_than(double low) {
  return {Bound{low, Bound::Side::open}, {}};
}

Range at_least(double low) {
  return {Bound{low, Bound::Side::closed}, {}};
}

Range between_open(double low, double high) {
  return {Bound{low, Bound::Side::open}, Bound{high, Bound::Side::open}};
}

namespace {

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string shape_text(const KeyDescription& key) {
  const std::vector<std::string>& choices = key.options.choices;
  const std::string& others = key.options.others;
  switch (key.shape) {
    case Shape::boolean:
      return "true or false";
    case Shape::integer:
      return "an integer";
    case Shape::number:
      return "a number";
    case Shape::text:
      if (choices.size() == 1) return quoted_list(choices);
      return choices.empty() ? "a text in quotes" : "one of " + quoted_list(choices);
    case Shape::vector:
      return "three numbers [x, y, z]";
    case Shape::pair:
      return "two numbers [x, y]";
    case Shape::integers:
      return "three integers [nx, ny, nz]";
    case Shape::integer_pair:
      return "two integers [nx, ny]";
    case Shape::numbers:
      return "a list of numbers";
    case Shape::pairs:
      return "a list of rows [x, y], each of two numbers";
    case Shape::texts:
      if (choices.empty()) return "a list of texts";
      return "a list of some of " + quoted_list(choices) + (others.empty() ? "" : ", " + others);
    case Shape::formulas:
      return "three formulas [\"...\", \"...\", \"...\"] in quotes, of x, y and z";
    case Shape::named_vectors:
      return "a table { NAME = [x, y, z], ... }";
    case Shape::section:
      return "a section [" + key.key + "]";
    case Shape::sections:
      return "sections [[" + key.key + "]]";
    case Shape::named_sections:
      return "sections [" + key.key + ".NAME]";
  }
  return "";
}

}  // namespace

bool applies(const KeyDescription& key, const std::string& kind) {
  return key.options.kinds.empty() || has(key.options.kinds, kind);
}

bool required(const KeyDescription& key, const std::string& kind) {
  return applies(key, kind) && (key.options.need == KeyOptions::Need::required || has(key.options.required_for, kind));
}

std::string range_text(const Range& range) {
  const auto sign = [](const Bound& bound, const char* direction) {
    return fmt::format("{}{} {}", direction, bound.side == Bound::Side::closed ? "=" : "", bound.value);
  };
  std::string text;
  if (range.low) text = sign(*range.low, ">");
  if (range.high) text += (text.empty() ? "" : " and ") + sign(*range.high, "<");
  return text;
}

std::string expected_text(const KeyDescription& key, UnitSystem units) {
  std::string text = shape_text(key);
  const std::string range = range_text(key.options.range);
  if (!range.empty()) text += " " + range;
  const std::string_view unit = unit_name(key.options.unit, units);
  if (!unit.empty()) text += fmt::format(" in {}", unit);
  return text;
}

std::string quoted_list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + toml_string(word);
  return text;
}

}  // namespace carom
