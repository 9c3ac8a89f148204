// Where fully integrated cells will be too stiff.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace carom {

/// Stiffness of a bent layer of fully integrated linear cells over the exact one: with n cells of length a along the
/// bending through the thickness H,
///   plate:  1 + ((1 - nu)^2 / (1 - 2 nu) - 1) / n^2 + (1 - nu) / 2 (a / H)^2
///   strip:  1 + (1 / (1 - nu^2) - 1) / n^2 + (a / H)^2 / (2 (1 + nu))
/// The last terms are the parasitic shear of a cell whose edges stay straight (R. D. Cook, D. S. Malkus, M. E. Plesha,
/// R. J. Witt, Concepts and Applications of Finite Element Analysis, 4th ed., 2002, section 3.6: strip with n = 1); the
/// others its strain across the thickness, which is constant in a cell and so cannot follow the bending. `plate` is
/// bent in plane strain along its width, `strip` free to contract there.
struct BentLayer {
  int cells = 1;                  ///< n
  double length_to_height = 1.0;  ///< a / H
  double nu = 0.0;
};
double plate_stiffness_ratio(const BentLayer& layer);
double strip_stiffness_ratio(const BentLayer& layer);

/// A warning for each part whose bending the mesh makes more than 20 % too stiff: where most of its volume lies in
/// columns of cells from skin to skin that are at most a fifth as long as another column through the same cell, that
/// are not held along their length by a plane of symmetry, and along which something acts (loads, motions, velocities,
/// contact). And for parts near nu = 0.5 whose fewest cells across make shape changes at constant volume more than 50 %
/// too stiff by the same estimate.
std::vector<std::string> locking_warnings(const Simulation& simulation);

}  // namespace carom
