// Tangent of isotropic linear elasticity.
#pragma once

#include <array>

#include "material/linear_elastic.hpp"

namespace carom {

/// 6 x 6 matrix D with sigma = D eps in Voigt order xx, yy, zz, xy, yz, zx (shear strains 2 eps_ij); row-major, stress.
using VoigtMatrix = std::array<std::array<double, 6>, 6>;

/// D = lambda m m^T + G diag(2, 2, 2, 1, 1, 1), m = (1, 1, 1, 0, 0, 0).
VoigtMatrix tangent(const LinearElastic& material);

}  // namespace carom
