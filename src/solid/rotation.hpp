// Rotation angles of deformation gradients and of cells.
#pragma once

#include "base/types.hpp"
#include "mesh/mesh.hpp"

namespace carom {

class BatchGradients;

/// Angle (radian, 0 to pi) of the rotation R of F = R U, by Newton's iteration R <- (R + R^-T) / 2 from F (Higham, SIAM
/// J. Sci. Stat. Comput. 7, 1986). pi where det F is not positive or F is not finite.
double rotation_angle(const double F[3][3]);

/// Angle between two vectors, 0 to pi; pi when one of them is zero or not finite.
double angle_between(const Vec3& a, const Vec3& b);

/// A rotation angle (radian) and the cell that has it, a position in Solid::cells(); -1: no cell has been turned.
struct Rotation {
  double angle = 0.0;
  Index cell = -1;
};

/// Takes note of the cell of a batch whose R in the mean F = R U has the largest angle, of bars that by which the axis
/// turns, where it is larger than `largest`. first: position of the batch's first cell. F = 1 + H and 1 + sym H, whose
/// R is 1, differ by W = skew H, so that 2 sqrt(2) sin(angle / 2) = |R - 1| <= |W| / (1 - |H|) in Frobenius' norm (Li,
/// SIAM J. Matrix Anal. Appl. 16, 1995): hardly a cell needs a decomposition.
void follow_rotation(const BatchGradients& gradients, CellType type, int lanes, int count, Index first,
                     Rotation& largest);

}  // namespace carom
