// Upper bounds of the frequencies and dampings of cells, from their own matrices.
#pragma once

#include <span>
#include <vector>

#include "solid/blocks.hpp"

namespace carom {

/// cell_frequency_bounds of each of some cells; 0 of those of nodal parts.
std::vector<double> frequency_bounds(const SolidCells& cells);

/// Bounds of the eigenvalues of M^-1 C per cell: of a linear bulk viscosity of coefficient 1, and of the viscosity of
/// hourglass modes. C is what the tangent of a step has more than that without one, times its length. Empty without
/// viscosity.
struct DampingBounds {
  std::vector<double> bulk, hourglass;
};
DampingBounds damping_bounds(const SolidCells& cells);

/// largest_damping of some cells.
double largest_damping(const SolidCells& cells, const DampingBounds& bounds, std::span<const double> history);

}  // namespace carom
