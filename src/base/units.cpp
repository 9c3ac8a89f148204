#include "base/units.hpp"

#include <cmath>
#include <cstddef>

namespace carom {

namespace {

/// Exponents of length, mass and time, and the names of the unit in SI, mm-t-s and mm-kg-ms.
struct DimensionRow {
  std::string_view name;
  int length = 0, mass = 0, time = 0;
  std::array<std::string_view, 3> units;
};

/// In the order of Dimension.
constexpr std::array<DimensionRow, 23> dimension_rows{{
    {.name = "", .units = {"", "", ""}},
    {.name = "length", .length = 1, .units = {"m", "mm", "mm"}},
    {.name = "area", .length = 2, .units = {"m2", "mm2", "mm2"}},
    {.name = "mass", .mass = 1, .units = {"kg", "t", "kg"}},
    {.name = "time", .time = 1, .units = {"s", "s", "ms"}},
    {.name = "force", .length = 1, .mass = 1, .time = -2, .units = {"N", "N", "kN"}},
    {.name = "stress", .length = -1, .mass = 1, .time = -2, .units = {"Pa", "MPa", "GPa"}},
    {.name = "energy", .length = 2, .mass = 1, .time = -2, .units = {"J", "mJ", "J"}},
    {.name = "density", .length = -3, .mass = 1, .units = {"kg/m3", "t/mm3", "kg/mm3"}},
    {.name = "velocity", .length = 1, .time = -1, .units = {"m/s", "mm/s", "mm/ms"}},
    {.name = "acceleration", .length = 1, .time = -2, .units = {"m/s2", "mm/s2", "mm/ms2"}},
    {.name = "stress per length", .length = -2, .mass = 1, .time = -2, .units = {"Pa/m", "MPa/mm", "GPa/mm"}},
    {.name = "force per length", .mass = 1, .time = -2, .units = {"N/m", "N/mm", "kN/mm"}},
    {.name = "force per velocity", .mass = 1, .time = -1, .units = {"N s/m", "N s/mm", "kN ms/mm"}},
    {.name = "inertia", .length = 2, .mass = 1, .units = {"kg m2", "t mm2", "kg mm2"}},
    {.name = "angular velocity", .time = -1, .units = {"1/s", "1/s", "1/ms"}},
    {.name = "rate", .time = -1, .units = {"1/s", "1/s", "1/ms"}},
    {.name = "temperature", .units = {"K", "K", "K"}},
    {.name = "specific heat", .length = 2, .time = -2, .units = {"J/(kg K)", "mJ/(t K)", "J/(kg K)"}},
    {.name = "impulse", .length = 1, .mass = 1, .time = -1, .units = {"N s", "N s", "kN ms"}},
    {.name = "moment", .length = 2, .mass = 1, .time = -2, .units = {"N m", "N mm", "kN mm"}},
    {.name = "momentum", .length = 1, .mass = 1, .time = -1, .units = {"kg m/s", "t mm/s", "kg mm/ms"}},
    {.name = "angular momentum", .length = 2, .mass = 1, .time = -1, .units = {"kg m2/s", "t mm2/s", "kg mm2/ms"}},
}};

struct SystemRow {
  std::string_view name;
  int length = 0, mass = 0, time = 0;  ///< powers of ten of the base units, in m, kg, s
};

/// In the order of UnitSystem.
constexpr std::array<SystemRow, 3> system_rows{{{"SI", 0, 0, 0}, {"mm-t-s", -3, 3, 0}, {"mm-kg-ms", -3, 0, -3}}};

const DimensionRow& row(Dimension dimension) {
  return dimension_rows.at(static_cast<std::size_t>(dimension));
}
const SystemRow& row(UnitSystem system) {
  return system_rows.at(static_cast<std::size_t>(system));
}

}  // namespace

std::string_view name(UnitSystem system) {
  return row(system).name;
}

std::string_view name(Dimension dimension) {
  return row(dimension).name;
}

std::string_view unit_name(Dimension dimension, UnitSystem system) {
  return row(dimension).units.at(static_cast<std::size_t>(system));
}

double si_factor(Dimension dimension, UnitSystem system) {
  const DimensionRow& d = row(dimension);
  const SystemRow& s = row(system);
  return std::pow(10.0, d.length * s.length + d.mass * s.mass + d.time * s.time);
}

}  // namespace carom
