// Eigenvalues and eigenvectors of symmetric tensors.
#pragma once

#include <array>

#include "base/types.hpp"

namespace carom {

/// values[i] belongs to axes[i]; the axes are orthonormal and right-handed.
struct PrincipalAxes {
  Vec3 values{};
  std::array<Vec3, 3> axes{};
};

/// Of the symmetric tensor with the diagonal xx, yy, zz and the entries xy, yz, zx, by Jacobi's rotations (G. H. Golub,
/// C. F. Van Loan, Matrix Computations, 1996, section 8.4) to round-off. A diagonal tensor keeps its axes and their
/// order.
PrincipalAxes principal_axes(const Vec3& diagonal, const Vec3& off_diagonal);

}  // namespace carom
