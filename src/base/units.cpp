#include "base/units.hpp"

#include <cmath>
#include <cstddef>

namespace carom {

namespace {

/// Exponents of length, mass and time, and the names of the unit in SI, mm-t-s and mm-kg-ms.
struct DimensionRow {
  std::string_view name;
  int length, mass, time;
  std::array<std::string_view, 3> units;
};

/// In the order of Dimension.
constexpr std::array<DimensionRow, 23> dimension_rows{{
    {"", 0, 0, 0, {"", "", ""}},
    {"length", 1, 0, 0, {"m", "mm", "mm"}},
    {"area", 2, 0, 0, {"m2", "mm2", "mm2"}},
    {"mass", 0, 1, 0, {"kg", "t", "kg"}},
    {"time", 0, 0, 1, {"s", "s", "ms"}},
    {"force", 1, 1, -2, {"N", "N", "kN"}},
    {"stress", -1, 1, -2, {"Pa", "MPa", "GPa"}},
    {"energy", 2, 1, -2, {"J", "mJ", "J"}},
    {"density", -3, 1, 0, {"kg/m3", "t/mm3", "kg/mm3"}},
    {"velocity", 1, 0, -1, {"m/s", "mm/s", "mm/ms"}},
    {"acceleration", 1, 0, -2, {"m/s2", "mm/s2", "mm/ms2"}},
    {"stress per length", -2, 1, -2, {"Pa/m", "MPa/mm", "GPa/mm"}},
    {"force per length", 0, 1, -2, {"N/m", "N/mm", "kN/mm"}},
    {"force per velocity", 0, 1, -1, {"N s/m", "N s/mm", "kN ms/mm"}},
    {"inertia", 2, 1, 0, {"kg m2", "t mm2", "kg mm2"}},
    {"angular velocity", 0, 0, -1, {"1/s", "1/s", "1/ms"}},
    {"rate", 0, 0, -1, {"1/s", "1/s", "1/ms"}},
    {"temperature", 0, 0, 0, {"K", "K", "K"}},
    {"specific heat", 2, 0, -2, {"J/(kg K)", "mJ/(t K)", "J/(kg K)"}},
    {"impulse", 1, 1, -1, {"N s", "N s", "kN ms"}},
    {"moment", 2, 1, -2, {"N m", "N mm", "kN mm"}},
    {"momentum", 1, 1, -1, {"kg m/s", "t mm/s", "kg mm/ms"}},
    {"angular momentum", 2, 1, -1, {"kg m2/s", "t mm2/s", "kg mm2/ms"}},
}};

struct SystemRow {
  std::string_view name;
  int length, mass, time;  ///< powers of ten of the base units, in m, kg, s
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
