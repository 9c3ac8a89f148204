// The linear systems of implicit steps: (M + s K + G^T D G) x = b on the free dofs.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "schemes/system.hpp"

namespace carom {

enum class SolverKind : std::uint8_t { automatic, conjugate_gradients, cholesky };

struct LinearSolveReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;  ///< 2-norm; 0 for a direct solve
};

/// M and K are those of the system (a linear body), s = beta h^2; D holds the contact tangents, row by row in the
/// row's frame, already times s. Contact never causes a new factorisation.
class EffectiveSolver {
 public:
  virtual ~EffectiveSolver() = default;
  /// Makes the operator ready for this factor s; does nothing when it is the last one.
  virtual void prepare(double s) = 0;
  /// Solves for x (overwritten; zero on fixed dofs) to a residual of at most `absolute` in the 2-norm where the solver
  /// iterates. b is zero on fixed dofs.
  virtual LinearSolveReport solve(std::span<const double> b, const std::vector<RowTangent>& D, double absolute,
                                  std::span<double> x) = 0;
  virtual std::string name() const = 0;
};

/// `automatic` takes conjugate gradients where the Jacobi-preconditioned operator is well conditioned,
///   kappa about 1 + s omega_max^2, so that sqrt(kappa)/2 ln(2/1e-12) iterations stay below 60, and the factorisation
/// elsewhere, unless the mesh has more than two million dofs or contact more than a thousand rows (one
/// back-substitution and a line of a dense matrix each).
std::unique_ptr<EffectiveSolver> make_effective_solver(const System& system, SolverKind kind, double s,
                                                       double omega_max_squared);

}  // namespace carom
