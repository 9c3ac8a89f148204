// Where cells will be too stiff, or too soft, to bend.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "build/simulation.hpp"

namespace carom {

/// Why results may be wrong though the books close: in a few words, and as a warning that says what helps.
struct Doubt {
  std::string brief, warning;
};

/// Stiffness of the thin parts of the bodies over the exact one where they bend; empty of parts that are not thin, that
/// nothing bends, or whose cells (other than HEXA8 and QUAD4) have no columns. A cell is bent as the layer would be,
///   u_a = -x y,  u_t = x^2 / 2 + nu' y^2 / 2   along the layer and across it, from the cell's centre,
/// nu' = nu / (1 - nu) of a plate; of a strip nu, less c w^2 / 2, and u_w = c y w with the c that the cell resists
/// least. With its stiffness at rest K
///   R = u.K u / (E' int y^2 dV),   ratio = 1 + (R - 1) / n^2
/// of n cells through the thickness, E' = E / (1 - nu^2) of a plate, E of a strip. On boxes of full integration that is
/// the parasitic shear (1 - nu) / 2 (a / H)^2 of a cell of length a in a plate of thickness H, and a term of nu (R. D.
/// Cook, D. S. Malkus, M. E. Plesha, R. J. Witt, Concepts and Applications of Finite Element Analysis, 4th ed., 2002,
/// section 3.6). Means over the thin cells, of rods over the ways along which something acts; of plates the worse of
/// both directions.
std::vector<std::optional<double>> bending_stiffness_ratios(const Simulation& simulation);

/// Stiffness of a layer of n fully integrated cells over the exact one from what keeps its volume alone:
/// 1 + ((1 - nu)^2 / (1 - 2 nu) - 1) / n^2.
double volume_stiffness_ratio(int cells, double nu);

/// A warning for each part that bends more than 10 % too stiffly or too easily by its cells: where most of its volume
/// lies in columns of cells from skin to skin that are at most a fifth as long as another column through the same cell,
/// that are not held along their length by a plane of symmetry, and along which something acts (loads, motions,
/// velocities, contact). For fully integrated parts near nu = 0.5 whose fewest cells across make shape changes at
/// constant volume more than 50 % too stiff. And for cells that have too few freedoms to keep their volume.
std::vector<Doubt> locking_doubts(const Simulation& simulation);

}  // namespace carom
