// Accelerations from forces.
#pragma once

#include <span>
#include <vector>

#include "linalg/conjugate_gradients.hpp"
#include "schemes/system.hpp"

namespace carom {

/// Solves M a = f on the free dofs, the accelerations of the prescribed ones being given: by division (lumped), or by
/// Jacobi conjugate gradients to round-off (consistent: its condition number does not depend on the mesh size, Wathen,
/// IMA Journal of Numerical Analysis 7, 1987).
class MassSolver {
 public:
  explicit MassSolver(const System& system);
  /// a holds the prescribed accelerations on fixed dofs on entry (zero where there is no mass); its other entries are
  /// the start value. Returns the number of iterations, or -1 when they do not converge.
  int solve(std::span<const double> f, std::span<double> a);

 private:
  const System& system_;
  std::vector<double> inverse_diagonal_, rhs_, free_;
  ConjugateGradients cg_;
};

}  // namespace carom
