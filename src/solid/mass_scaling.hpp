// Mass scaling: cells that are too small for the wanted step become heavier.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "solid/solid.hpp"

namespace carom {

/// A cell and what scaling does to it.
struct ScaledCell {
  std::size_t cell = 0;  ///< in Solid::cells()
  double factor = 1.0;   ///< its mass after over before
};

/// What scaling needs.
struct MassGain {
  double added = 0.0;  ///< mass
  double total = 0.0;  ///< mass before, rigid bodies included
  std::size_t cells = 0;
  std::vector<ScaledCell> worst;  ///< at most three, largest factor first

  double share() const { return added / total; }
};

/// Factors s_k = max(1, omega_k^2 / omega^2) on the masses of the cells, one per cell of the solid: with lumped masses
/// no frequency of the bodies is then above `omega_squared` (cell_frequency_bounds; Irons). Solid::lumped_mass
/// makes the mass of the run from them: kinetic energy, momenta and weight are those of the heavier bodies.
std::vector<double> mass_factors(const Solid& solid, double omega_squared);
MassGain mass_gain(const Solid& solid, const std::vector<double>& factors);

/// "3 of 120 cells gain 0.012 of mass, 1.3 % of all; the worst: cell 7 at (...) x 2.1, ..."
std::string describe(const MassGain& gain, const Solid& solid, const Mesh& mesh);

}  // namespace carom
