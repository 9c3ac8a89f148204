// Rotation angles of deformation gradients.
#pragma once

#include "base/types.hpp"

namespace carom {

/// Angle (radian, 0 to pi) of the rotation R of F = R U, by Newton's iteration R <- (R + R^-T) / 2 from F (Higham, SIAM
/// J. Sci. Stat. Comput. 7, 1986). pi where det F is not positive or F is not finite.
double rotation_angle(const double F[3][3]);

/// Angle between two vectors, 0 to pi; pi when one of them is zero or not finite.
double angle_between(const Vec3& a, const Vec3& b);

}  // namespace carom
