// Cells whose neighbours do not hold the modes that reduced integration leaves without a stiffness.
#pragma once

#include <string>
#include <vector>

#include "build/simulation.hpp"

namespace carom {

/// A warning for each part of reduced integration with cells that are the only ones across their body in two
/// directions. HEXA20 with eight points has 48 strains for its 54 modes of deformation, QUAD8 with four points 12
/// for 13. Cells side by side do not share the modes that this leaves free, but a single cell has them, and so has a
/// straight column of HEXA20 (n + 1 of n > 1 cells; tests/unit/solid/locking_test.cpp).
std::vector<std::string> lone_cell_warnings(const Simulation& simulation);

}  // namespace carom
