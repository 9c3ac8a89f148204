// Accelerations from forces.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "contact/closing_rows.hpp"
#include "linalg/conjugate_gradients.hpp"
#include "system/effective_solver.hpp"
#include "system/system.hpp"

namespace carom {

/// Solves M a = f on the free dofs, the accelerations of the prescribed ones being given: by division (lumped), or by
/// Jacobi conjugate gradients to round-off (consistent: its condition number does not depend on the mesh size, Wathen,
/// IMA Journal of Numerical Analysis 7, 1987). Free dofs without mass get no acceleration.
class MassSolver {
 public:
  explicit MassSolver(const System& system);
  ~MassSolver();
  /// Factors a consistent mass, so that each solve from here on is one back-substitution: where many are to come.
  /// Systems of more than half a million dofs stay with the conjugate gradients.
  void factorise();
  /// a holds the prescribed accelerations on fixed dofs on entry (zero where there is no mass); its other entries are
  /// the start value. Returns the number of iterations, or -1 when they do not converge.
  int solve(std::span<const double> f, std::span<double> a);
  /// EffectiveSolver::halves of the factors; empty where there are none.
  std::function<std::vector<HalfPanel>(const SparseColumns&)> halves() const {
    return factors_ ? factors_->halves() : std::function<std::vector<HalfPanel>(const SparseColumns&)>{};
  }
  /// The message when it does not converge.
  static constexpr const char* failure =
      "the accelerations cannot be solved for: the forces are not finite or the mass is not positive";
  /// The name of the solver, for the log.
  std::string name() const;

 private:
  const System& system_;
  std::vector<double> inverse_diagonal_, rhs_, free_;  ///< of a consistent mass
  ConjugateGradients cg_;
  std::unique_ptr<EffectiveSolver> factors_;
};

/// The operator A = M: from forces on rows to accelerations, or from impulses to velocities. Refers to the solver.
ContactOperator mass_operator(const System& system, MassSolver& solver);

}  // namespace carom
