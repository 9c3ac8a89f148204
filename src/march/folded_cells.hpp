// Cells that have folded at a corner.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "build/simulation.hpp"

namespace carom {

/// The cell whose volume at one of its corners has become the least share of that at rest.
struct FlattestCorner {
  Index cell = -1;  ///< position in Solid::cells(); -1: nothing has become smaller
  double share = 1.0;
  double small_strain = 1.0;  ///< the least share among cells of small strain
  bool is_folded() const { return share <= 0.0; }
};

/// The least share of a cell's corners at displacement u: of the volume there over that at rest. 1 of bars.
double flattest_share(const Mesh& mesh, CellType type, std::span<const Index> nodes, std::span<const double> u);

/// Of all cells that are there (alive; empty: all) but bars at displacement u. Those of second order are judged by
/// their corners, as meshes are that are read; of equal shares the first counts. Each rank looks at the cells whose
/// first node is its own; all of them call it.
FlattestCorner flattest_corner(const Simulation& simulation, std::span<const double> u,
                               std::span<const std::uint8_t> alive = {});

/// "cell 12 of part \"rubber\" at (0.1, 0, 2) has folded: ..." and what helps a cell of its formulation.
std::string describe_fold(const Simulation& simulation, const FlattestCorner& corner, std::span<const double> u);

}  // namespace carom
