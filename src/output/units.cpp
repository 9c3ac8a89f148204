#include "output/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/units.hpp"
#include "energy/ledger.hpp"

namespace carom {

namespace {

/// Unit of a moment: a force times a length, and so on; empty when a factor is unknown.
std::string product(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? std::string() : a + " " + b;
}

std::string per(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? std::string() : a + "/" + b;
}

}  // namespace

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
  if (tail.empty() || tail.size() > 2 || tail.find_first_not_of("xyz") != std::string_view::npos) return name;
  name.component = tail;
  name.quantity = name.quantity.substr(0, bar);
  return name;
}

std::string unit_of_column(const Units& units, std::string_view column) {
  const std::string_view quantity = parse_column(column).quantity;
  const std::string velocity = per(units.length, units.time);
  if (quantity == "time" || quantity == "dt") return units.time;
  if (quantity == "displacement" || quantity == "penetration") return units.length;
  if (quantity == "velocity") return velocity;
  if (quantity == "acceleration") return velocity.empty() ? std::string() : velocity + "²";
  if (quantity == "stress") return units.stress;
  if (quantity == "force" || quantity == "section_force") return units.force;
  if (quantity == "impulse") return product(units.force, units.time);
  if (quantity == "moment") return product(units.force, units.length);
  if (quantity == "momentum" || quantity == "momentum_error") return product(units.mass, velocity);
  if (quantity == "angular_momentum" || quantity == "angular_momentum_error")
    return velocity.empty() ? std::string() : product(units.mass, units.length + "²/" + units.time);
  const auto is_term = [&](const EnergyTerm& term) { return term.name == quantity; };
  const bool is_energy = std::any_of(energy_terms.begin(), energy_terms.end(), is_term) ||
                         std::find(aster_names.begin(), aster_names.end(), quantity) != aster_names.end();
  if (is_energy || quantity == "imbalance") return units.energy;
  return {};
}

std::string unit_of_field(const Units& units, std::string_view field) {
  if (field == "von_mises" || field == "contact_pressure") return units.stress;
  if (field == "contact_force") return units.force;
  if (field == "contact_gap") return units.length;
  if (field == "temperature_rise") return "K";
  return unit_of_column(units, field);
}

}  // namespace carom
