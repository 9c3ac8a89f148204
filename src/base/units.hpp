// The three unit systems of a case: labels and plausibility only; nothing is ever converted.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace carom {

enum class UnitSystem : std::uint8_t { si, mm_t_s, mm_kg_ms };

inline constexpr std::array unit_systems{UnitSystem::si, UnitSystem::mm_t_s, UnitSystem::mm_kg_ms};

/// Physical dimension of a number in a case file.
enum class Dimension : std::uint8_t {
  none,
  length,
  area,
  mass,
  time,
  force,
  stress,
  energy,
  density,
  velocity,
  acceleration,
  stress_per_length,  ///< penalty stiffness per area
  force_per_length,   ///< penalty stiffness of a node or stop
  damping,            ///< force per velocity
  inertia,            ///< mass times area
  angular_velocity,
  rate,  ///< of strain
  temperature,
  specific_heat,  ///< energy per mass and temperature
  impulse,
  moment,
  momentum,
  angular_momentum
};

/// All dimensions that have units.
inline constexpr std::array dimensions{Dimension::length,
                                       Dimension::area,
                                       Dimension::mass,
                                       Dimension::time,
                                       Dimension::force,
                                       Dimension::stress,
                                       Dimension::energy,
                                       Dimension::density,
                                       Dimension::velocity,
                                       Dimension::acceleration,
                                       Dimension::stress_per_length,
                                       Dimension::force_per_length,
                                       Dimension::damping,
                                       Dimension::inertia,
                                       Dimension::angular_velocity,
                                       Dimension::rate,
                                       Dimension::temperature,
                                       Dimension::specific_heat,
                                       Dimension::impulse,
                                       Dimension::moment,
                                       Dimension::momentum,
                                       Dimension::angular_momentum};

/// "SI", "mm-t-s", "mm-kg-ms": the values of the key `units`.
std::string_view name(UnitSystem system);
/// "stress", "density", ...; "" for none.
std::string_view name(Dimension dimension);
/// Name of the unit, e.g. "MPa" for stress in mm-t-s; "" for a number without dimension.
std::string_view unit_name(Dimension dimension, UnitSystem system);
/// How many SI units one unit of the system is: 1 MPa = 1e6 Pa gives 1e6. 1 for a number without dimension.
double si_factor(Dimension dimension, UnitSystem system);

/// g_n in m/s^2 (3rd General Conference on Weights and Measures, 1901).
inline constexpr double standard_gravity = 9.80665;

}  // namespace carom
