// Names of units for headers and axes. Nothing is ever converted.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/units.hpp"

namespace carom {

/// Unit names of a consistent system.
struct Units {
  std::string length, time, mass, force, stress, energy;
  friend bool operator==(const Units&, const Units&) = default;
};

/// The system that these are the names of, if there is one.
std::optional<UnitSystem> system_of(const Units& units);

/// Unit names of "SI", "mm-t-s" or "mm-kg-ms"; empty names for any other label.
Units units_of(std::string_view label);

/// "units: m, s, kg, N, Pa, J" (length, time, mass, force, stress, energy): the comment line of every table.
std::string units_comment(const Units& units);

/// The reverse of units_comment, or nothing when the line (without "# ") is not one.
std::optional<Units> parse_units_comment(std::string_view comment);

/// What a column of a table holds: "B.displacement_z" is {"B", "displacement", "z"}, "dt" is {"", "dt", ""}. The views
/// point into the name.
struct ColumnName {
  std::string_view place, quantity, component;
};
ColumnName parse_column(std::string_view column);

/// Name of the unit of a dimension, e.g. "m/s²"; "" where there is none, or where the system is unknown.
std::string unit_of(const Units& units, Dimension dimension);

/// An acceleration as a multiple of standard_gravity, e.g. "3134 g"; "" where the system
/// is unknown.
std::string in_g(double acceleration, const Units& units);
/// Its number alone.
std::optional<double> multiple_of_g(double acceleration, const Units& units);

/// Unit of a column of energy.csv, contact.csv or probes.csv by its name, e.g. "m/s" for "B.velocity_z" in SI; "" for
/// numbers without a unit.
std::string unit_of_column(const Units& units, std::string_view column);

/// Unit of a field of the frames by its name, e.g. "N" for "contact_force" in SI; "" for numbers without a unit.
std::string unit_of_field(const Units& units, std::string_view field);

}  // namespace carom
