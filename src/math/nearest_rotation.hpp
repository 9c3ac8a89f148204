// The rotation that is part of a deformation.
#pragma once

#include <array>

#include "base/types.hpp"

namespace carom {

/// Columns: where the axes x, y and z go to.
using Columns3 = std::array<Vec3, 3>;

/// R of F = R U with U symmetric and positive definite, by Newton's iteration R <- (R + R^-T) / 2 from F on (N. J.
/// Higham, Computing the polar decomposition with applications, SIAM J. Sci. Stat. Comput. 7, 1986), to round-off.
/// Precondition: det F > 0.
Columns3 nearest_rotation(Columns3 F);

}  // namespace carom
