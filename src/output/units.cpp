#include "output/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "energy/ledger.hpp"
#include "output/quantities.hpp"
#include "output/readable_unit.hpp"

namespace carom {

namespace {

Dimension dimension_of(std::string_view quantity) {
  const Quantity* found = find_quantity(quantity);
  return found == nullptr ? Dimension::none : found->unit;
}

/// Is it a column of energy.csv? "strain" is an energy there, and a field beside.
bool is_energy(std::string_view column) {
  return std::ranges::find(energy_terms, column, &EnergyTerm::name) != energy_terms.end() ||
         std::ranges::find(aster_names, column) != aster_names.end();
}

}  // namespace

std::optional<UnitSystem> system_of(const Units& units) {
  const auto is_it = [&](UnitSystem system) { return units_of(name(system)) == units; };
  const auto* const found = std::ranges::find_if(unit_systems, is_it);
  return found == unit_systems.end() ? std::nullopt : std::optional(*found);
}

Units units_of(std::string_view label) {
  for (const UnitSystem system : unit_systems) {
    if (name(system) != label) continue;
    const auto unit = [system](Dimension dimension) { return std::string(unit_name(dimension, system)); };
    return {unit(Dimension::length), unit(Dimension::time),   unit(Dimension::mass),
            unit(Dimension::force),  unit(Dimension::stress), unit(Dimension::energy)};
  }
  return {};
}

std::string units_comment(const Units& units) {
  return fmt::format("units: {}, {}, {}, {}, {}, {}", units.length, units.time, units.mass, units.force, units.stress,
                     units.energy);
}

std::optional<Units> parse_units_comment(std::string_view comment) {
  constexpr std::string_view begin = "units: ";
  if (!comment.starts_with(begin)) return std::nullopt;
  comment.remove_prefix(begin.size());
  std::vector<std::string> names(1);
  for (const char c : comment) {
    if (c == ',') {
      names.emplace_back();
    } else if (c != ' ') {
      names.back() += c;
    }
  }
  if (names.size() != 6) return std::nullopt;
  return Units{names[0], names[1], names[2], names[3], names[4], names[5]};
}

ColumnName parse_column(std::string_view column) {
  ColumnName name{{}, column, {}};
  if (const std::size_t dot = column.rfind('.'); dot != std::string_view::npos) {
    name.place = column.substr(0, dot);
    name.quantity = column.substr(dot + 1);
  }
  const std::size_t bar = name.quantity.rfind('_');
  if (bar == std::string_view::npos) return name;
  const std::string_view tail = name.quantity.substr(bar + 1);
  const bool is_rank =
      std::ranges::find(component_names(Form::principal), tail) != component_names(Form::principal).end();
  if (tail.empty() || tail.size() > 2) return name;
  if (!is_rank && tail.find_first_not_of("xyz") != std::string_view::npos) return name;
  name.component = tail;
  name.quantity = name.quantity.substr(0, bar);
  return name;
}

std::string unit_of(const Units& units, Dimension dimension) {
  const std::optional<UnitSystem> system = system_of(units);
  if (!system) return {};
  std::string unit(unit_name(dimension, *system));
  for (const auto& [digit, raised] : {std::pair{'2', "²"}, std::pair{'3', "³"}})
    for (std::size_t at = 0; (at = unit.find(digit)) != std::string::npos;) unit.replace(at, 1, raised);
  return unit;
}

std::optional<double> multiple_of_g(double acceleration, const Units& units) {
  const std::optional<UnitSystem> system = system_of(units);
  if (!system) return std::nullopt;
  return acceleration * si_factor(Dimension::acceleration, *system) / standard_gravity;
}

std::string in_g(double acceleration, const Units& units) {
  const std::optional<double> multiple = multiple_of_g(acceleration, units);
  return multiple ? number_text(*multiple, 4) + " g" : "";
}

std::string unit_of_column(const Units& units, std::string_view column) {
  return unit_of(units, is_energy(column) ? Dimension::energy : dimension_of(parse_column(column).quantity));
}

std::string unit_of_field(const Units& units, std::string_view field) {
  return unit_of(units, dimension_of(field));
}

}  // namespace carom
