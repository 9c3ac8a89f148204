// Cells that supports strain: what bounds an explicit step where no free node does.
#pragma once

#include <limits>

#include "system/system.hpp"

namespace carom {

/// The cells in which supports alone change the distance between nodes. Their nodes have no equation, so that no
/// vibration of the bodies knows these cells; an explicit step is bounded by
///   - omega_max_squared, the largest of their own frequency bounds (cell_frequency_bounds), by the scheme's
///     mass: what would bound it if they were free;
///   - dt_strain, the longest step in which none of these distances changes its logarithm by more than
///     most_imposed_strain. Not where nodes part faster than the fastest wave would run between them, as where a
///     displacement jumps.
struct DrivenCells {
  double omega_max_squared = 0.0;  ///< 0: no cell is strained by supports
  double dt_strain = std::numeric_limits<double>::infinity();
  Index first = -1;  ///< the first of the cells, a position in Solid::cells()
  Index count = 0;
};
/// The largest change of the logarithm of a distance in one step. The error that it leaves in laws was measured with
/// `carom material` against steps a hundred times as short (the update of finite flow is of first order in the step):
/// Johnson and Cook's law in simple shear to gamma = 1, 0.1 % of the shear stress, as much as 0.5 % of it in the normal
/// stresses, 0.006 % of the plastic strain; in tension to 0.5 and back 0.1 % of the stress.
inline constexpr double most_imposed_strain = 0.005;

/// The driven cells of the motion between two times.
DrivenCells driven_cells(const System& system, double begin, double end);

/// cell_frequency_bounds for the scheme's mass instead of the lumped one. Mass scaling multiplies the mass of a
/// node by one factor in all cells there. Nodes without mass follow the others.
std::vector<double> cell_bounds(const System& system);

}  // namespace carom
