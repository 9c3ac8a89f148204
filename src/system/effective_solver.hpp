// The linear systems of implicit steps: (m M + c K + G^T D G) x = b on the free dofs.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linalg/half_solution.hpp"
#include "model/compatibility.hpp"
#include "model/options.hpp"
#include "system/dof_spring.hpp"
#include "system/system.hpp"

namespace carom {

struct LinearSolveReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;       ///< 2-norm; 0 for a direct solve
  bool is_indefinite = false;  ///< it broke down, since the operator is not positive definite
  std::size_t worst = 0;       ///< dof that moves most in what A does not resist, where it has not converged
};

/// A = m M + c K(u) of the system, and the springs of hold(); D holds the contact tangents, row by row in the row's
/// frame, times the slope of x in the unknown. Contact never causes a new factorisation.
class EffectiveSolver {
 public:
  virtual ~EffectiveSolver() = default;
  /// True when a solve to fewer digits costs less.
  virtual bool iterates() const = 0;
  /// Gives springs that are part of A from the next prepare() on. None of them is on a fixed dof.
  void hold(std::vector<DofSpring> springs) { springs_ = std::move(springs); }
  /// Begins a stage, which goes on from what its memory holds. The memory outlives the stage.
  virtual void begin(const StageMemory& memory) = 0;
  /// Writes into the memory what the next stage goes on from; before the first stage, what that one starts with.
  virtual void leave(StageMemory& memory) const = 0;
  /// Makes A ready at the displacement u, the end of `step` (whose history outlives the solves); a linear body does
  /// nothing when m and c are the last ones. Returns what is wrong with A, "" when nothing is.
  virtual std::string prepare(double m, double c, std::span<const double> u, const PointStep& step = {}) = 0;
  /// Solves (A + G^T D G) x = b for x (overwritten; zero on fixed dofs) to a residual of at most `absolute` in the
  /// 2-norm where the solver iterates. b is zero on fixed dofs; D may be empty.
  virtual LinearSolveReport solve(std::span<const double> b, const std::shared_ptr<const ConstraintRows>& rows,
                                  const std::vector<RowTangent>& D, double absolute, std::span<double> x) = 0;
  /// Overwrites the dof vectors b (one after the other, zero on fixed dofs) by A^-1 b, close to round-off.
  virtual LinearSolveReport invert(std::span<double> b, int columns) = 0;
  /// Halves of A^-1 for sparse dof vectors (InverseOperator::half); empty where the solver has no factors L L^T.
  virtual std::function<std::vector<HalfPanel>(const SparseColumns&)> halves() { return {}; }
  /// The name, for the log, of the solver that goes on from this memory.
  virtual std::string name(const StageMemory& memory) const = 0;
  /// A number that grows whenever A becomes another operator.
  std::size_t operators_made() const { return operators_made_; }

 protected:
  std::size_t operators_made_ = 0;
  std::vector<DofSpring> springs_;
};

/// "node 17 at (0, 1, 2) moves along z", for messages.
std::string describe_motion(const Mesh& mesh, std::size_t dof);

/// The kind of solver that `automatic` stands for; any other kind is returned as it is. ratio: c / m of the usual step
/// (infinite for statics). Conjugate gradients where the Jacobi-preconditioned operator is well conditioned,
///   kappa about 1 + (c / m) omega_max^2, so that sqrt(kappa)/2 ln(2/1e-12) iterations stay below 60:
/// beyond that a factorisation is cheaper up to about 50,000 dofs (a linear body factors once), and multigrid above
/// (measured on bars of 8 x 8 x 160 and 16 x 16 x 320 cells). Contact of more than a thousand rows goes to multigrid as
/// well, since each row costs a factorisation one back-substitution and one line of a dense matrix. Bodies that are not
/// linear factor in every iteration, but their tangents may turn indefinite, which ends iterations: they are given up
/// for multigrid only where a factorisation takes gigabytes. Exact contact asks for a column of the inverse per row, or
/// three per contact node where rows of linear bodies move: a factorisation gives them cheaply, iterations do not.
SolverKind chosen_solver(const System& system, SolverKind kind, EnforcementKind enforcement, double ratio,
                         double omega_max_squared);

/// kind: not automatic. Cholesky factors give way to L D L^T where the operator is not positive definite
/// (TangentFactors).
std::unique_ptr<EffectiveSolver> make_effective_solver(const System& system, SolverKind kind);

}  // namespace carom
