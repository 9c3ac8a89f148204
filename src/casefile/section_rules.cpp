#include "casefile/section_rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "output/quantities.hpp"

namespace carom {

Location place_of(const Node& section, const std::string& key) {
  const Node* node = find(section, key);
  return node != nullptr ? node->where : section.where;
}

namespace {

double norm(const Vec3& v) {
  return std::hypot(v[0], v[1], v[2]);
}

/// A unit vector is left as it is, so that a case written and read again is the same to the last bit.
void normalise(Vec3& v) {
  const double length = norm(v);
  constexpr double round_off = 1e-14;
  if (std::abs(length - 1.0) <= round_off) return;
  for (double& component : v) component /= length;
}

}  // namespace

void check_name(const Located<std::string>& name, const std::string& path) {
  const auto forbidden = [](unsigned char c) { return c < 0x20 || c == 0x7f || c == ',' || c == '"'; };
  if (!name->empty() && std::none_of(name->begin(), name->end(), forbidden)) return;
  throw CaseError(name.where, path, toml_string(*name), "a name without commas, quotes and control characters");
}

void check_direction(Located<Vec3>& direction, const std::string& path) {
  const double length = norm(*direction);
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw CaseError(direction.where, path, fmt::format("a vector of length {}", length),
                    "a direction, such as [0, 0, 1]");
  }
  normalise(direction.value);
}

void check_function(CaseFunction& function, const Node& node, const ReadContext& at) {
  const std::vector<double>& time = function.function.time;
  const std::size_t values = function.function.value.size();
  if (values != time.size()) {
    throw CaseError(place_of(node, "value"), at.at("value").path, fmt::format("{} values", values),
                    fmt::format("{}, one for each time", time.size()));
  }
  for (std::size_t i = 1; i < time.size(); ++i) {
    const bool third = i >= 2 && time[i] == time[i - 2];
    if (time[i] >= time[i - 1] && !third) continue;
    throw CaseError(std::get<List>(find(node, "time")->value)[i].where, at.at("time").entry(i).path,
                    fmt::format("{} after {}", time[i], time[i - 1]),
                    "times in increasing order, the same time at most twice");
  }
}

std::string names_of_part_quantities() {
  std::vector<std::string_view> names;
  for (const Quantity& quantity : quantities())
    if (quantity.place == Place::part) names.push_back(quantity.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void check_probe(CaseProbe& probe, const Node& node, const ReadContext& at) {
  check_name(probe.name, at.at("name").path);
  if (probe.quantities.empty()) {
    throw CaseError(place_of(node, "quantities"), at.at("quantities").path, "an empty list", "at least one quantity");
  }
  for (const Located<std::string>& quantity : probe.quantities) {
    const Quantity* found = find_quantity(*quantity);
    if (found == nullptr) continue;  // what the points of a law remember, or nothing (check_quantities)
    const bool is_of_part = found->place == Place::part;
    if (is_of_part != probe.part.has_value())
      throw CaseError(quantity.where, at.at("quantities").path,
                      fmt::format("\"{}\" {} a part", *quantity, is_of_part ? "without" : "of"),
                      is_of_part ? "part = ... beside it" : fmt::format("one of {}", names_of_part_quantities()));
  }
  const auto find_asked = [&](std::string_view name) {
    return std::ranges::find_if(probe.quantities, [&](const Located<std::string>& q) { return *q == name; });
  };
  if (probe.quality_factor && !probe.shock)
    throw CaseError(place_of(node, "quality_factor"), at.at("quality_factor").path, "a quality factor without shock",
                    "shock = true beside it");
  if (probe.shock && find_asked("acceleration") == probe.quantities.end() &&
      find_asked("local_acceleration") == probe.quantities.end())
    throw CaseError(place_of(node, "shock"), at.at("shock").path, "shock without an acceleration",
                    "\"acceleration\" or \"local_acceleration\" among the quantities");
  const auto force = find_asked("section_force");
  if (force == probe.quantities.end()) {
    if (!probe.side) return;
    throw CaseError(place_of(node, "side"), at.at("side").path, "a side without section_force",
                    "side only where quantities have \"section_force\"");
  }
  if (!probe.group || !probe.side) {
    throw CaseError(force->where, at.at("quantities").path,
                    fmt::format("\"section_force\" without {}", probe.group ? "side" : "group"),
                    "a group of nodes on the section and the side whose cells are summed",
                    "Add for example side = [0, 0, 1].");
  }
  if (!(norm(*probe.side) > 0.0)) {
    throw CaseError(place_of(node, "side"), at.at("side").path, "a vector of length 0",
                    "a direction, such as [0, 0, 1]");
  }
}

void check_check(CaseCheck& check, const Node&, const ReadContext& at) {
  if (!check.value || **check.value != 0.0 || check.absolute) return;
  throw CaseError(check.value->where, at.at("value").path, "0 with a relative tolerance", "absolute = true",
                  "A difference relative to 0 means nothing; give the tolerance in the unit of the quantity.");
}

}  // namespace carom
