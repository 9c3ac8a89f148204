#include "translate/temperatures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace carom {

namespace {

bool gives_temperatures(const Statement& s) {
  return s.keyword->name == "INITIAL CONDITIONS" && s.keyword->required("TYPE") == "TEMPERATURE";
}

std::map<Index, double> temperatures_of_nodes(const Translation& t) {
  std::map<Index, double> given;
  for (const Statement& s : t.statements.list) {
    if (!gives_temperatures(s)) continue;
    for (DeckCursor at(*s.keyword); at.next_line();) {
      const std::string target(at.field());
      const double temperature = at.real("the temperature");
      for (const Index n : t.mesh.mesh.nodes_of(t.node_group(at, s, target))) given[n] = temperature;
    }
  }
  return given;
}

std::set<double> temperatures_of(const Translation& t, const std::string& material) {
  const std::map<Index, double> given = temperatures_of_nodes(t);
  std::set<double> found;
  for (const Statement& s : t.statements.list) {
    if (s.keyword->name != "SOLID SECTION" || s.keyword->required("MATERIAL") != material || given.empty()) continue;
    const std::string key = key_of(t.mesh.names.element_sets, t.scope(s), s.keyword->required("ELSET"));
    if (key.empty()) continue;
    for (const DeckNames::Cells& cells : t.mesh.names.element_sets.at(key))
      for (const Index n : t.mesh.mesh.nodes_of(cells.group)) {
        const auto of_node = given.find(n);
        found.insert(of_node == given.end() ? 0.0 : of_node->second);
      }
  }
  return found;
}

/// A temperature, with what holds at it.
template <class Values>
using AtTemperatures = std::vector<std::pair<double, Values>>;

/// Linear between two temperatures, by mix(a, b, share of b), and constant outside.
template <class Values, class Mix>
Values at_temperature(const AtTemperatures<Values>& all, double temperature, const Mix& mix) {
  const auto above = std::ranges::find_if(all, [&](const auto& entry) { return entry.first >= temperature; });
  if (above == all.begin()) return all.front().second;
  if (above == all.end()) return all.back().second;
  const auto& [low, below] = *(above - 1);
  return mix(below, above->second, (temperature - low) / (above->first - low));
}

double mixed(double a, double b, double share) {
  return a + share * (b - a);
}

double stress_at(const HardeningCurve& curve, double strain) {
  const auto above = std::ranges::find_if(curve, [&](const auto& point) { return point.first >= strain; });
  if (above == curve.begin()) return curve.front().second;
  if (above == curve.end()) return curve.back().second;
  const auto& [low, stress] = *(above - 1);
  return mixed(stress, above->second, (strain - low) / (above->first - low));
}

/// At the strains of both.
HardeningCurve mixed_curve(const HardeningCurve& a, const HardeningCurve& b, double share) {
  std::set<double> strains;
  for (const HardeningCurve* curve : {&a, &b})
    for (const auto& [strain, stress] : *curve) strains.insert(strain);
  HardeningCurve made;
  for (const double strain : strains)
    made.emplace_back(strain, mixed(stress_at(a, strain), stress_at(b, strain), share));
  return made;
}

void refuse_falling(const DeckCursor& at, double before, double temperature) {
  if (temperature < before)
    at.fail(fmt::format("the temperature {:g} after {:g}", temperature, before), "temperatures in increasing order");
}

/// The temperature for which a table of several is taken.
double chosen(Translation& t, const std::string& material, const DeckKeyword& keyword) {
  const double start = initial_temperature(t, material);
  if (t.heats())
    t.findings.refuse(keyword, keyword.where, "values that depend on the temperature, which changes",
                      fmt::format("Those at the start, at {:g}, would hold.", start));
  else
    t.findings.note(keyword.where, fmt::format("*{} at the temperature of the start, {:g}", keyword.name, start));
  return start;
}

}  // namespace

double initial_temperature(Translation& t, const std::string& material) {
  const std::set<double> given = t.mesh.is_whole ? temperatures_of(t, material) : std::set<double>{};
  if (given.empty()) return 0.0;
  if (given.size() == 1) return *given.begin();
  const auto first = std::ranges::find_if(t.statements.list, gives_temperatures);
  t.findings.refuse(*first->keyword, first->keyword->where,
                    fmt::format("several temperatures in the material {}, or none at some nodes", material),
                    fmt::format("All of it would begin at {:g}.", *given.begin()));
  return *given.begin();
}

std::vector<double> values_at_start(Translation& t, const std::string& material, const DeckKeyword& keyword,
                                    std::size_t least, std::size_t most, const std::string& what) {
  AtTemperatures<std::vector<double>> all;
  for (DeckCursor at(keyword); at.next_line();) {
    std::vector<double> values;
    while (!at.at_end() && values.size() < most) values.push_back(at.real_or(0.0, what));
    if (values.size() < least) at.fail(fmt::format("{} values", values.size()), what);
    values.resize(most);
    const double temperature = at.real_or(0.0, "the temperature");
    if (!all.empty()) refuse_falling(at, all.back().first, temperature);
    all.emplace_back(temperature, std::move(values));
  }
  if (all.empty()) keyword.fail("0 values", what);
  if (all.size() == 1) return all.front().second;
  return at_temperature(all, chosen(t, material, keyword), [](const auto& a, const auto& b, double share) {
    std::vector<double> made(a.size());
    std::ranges::transform(a, b, made.begin(), [&](double x, double y) { return mixed(x, y, share); });
    return made;
  });
}

HardeningCurve curve_at_start(Translation& t, const std::string& material, const DeckKeyword& plastic) {
  AtTemperatures<HardeningCurve> all;
  for (DeckCursor at(plastic); at.next_line();) {
    const double stress = at.real("the yield stress"), strain = at.real_or(0.0, "the plastic strain");
    const double temperature = at.real_or(0.0, "the temperature");
    at.end_line("yield stress, plastic strain, temperature");
    if (!all.empty()) refuse_falling(at, all.back().first, temperature);
    if (all.empty() || all.back().first != temperature) all.push_back({temperature, {}});
    all.back().second.emplace_back(strain, stress);
  }
  if (all.empty()) plastic.fail("no data", "lines of yield stress, plastic strain");
  if (all.size() == 1) return all.front().second;
  return at_temperature(all, chosen(t, material, plastic), mixed_curve);
}

}  // namespace carom
