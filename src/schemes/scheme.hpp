// The interface of a time scheme: one step, state in, state out.
#pragma once

#include <string>

#include "schemes/residual_tolerance.hpp"
#include "system/system.hpp"

namespace carom {

/// The request of the run for one step.
struct StepRequest {
  double t_end = 0.0;           ///< time at the end of the step
  double dt = 0.0;              ///< its length
  ResidualTolerance tolerance;  ///< in this step
};

/// The result of a step. A step that has not converged is reported, not thrown; the state at its end then means
/// nothing.
struct StepReport {
  bool converged = false;
  int iterations = 0;         ///< Newton iterations on the contact state (0 for explicit schemes)
  int linear_iterations = 0;  ///< conjugate-gradient iterations, all Newton iterations together
  std::string failure;        ///< why it did not converge; names the rows that cycle
  LedgerIncrement books;
  double rounding = 0.0;  ///< energy of the books that is rounding: of statics
};

/// One step of a scheme. start() makes velocities and accelerations consistent with the supports and the forces at
/// state.t, and fills what else the state holds for the scheme. step() is a function of the state at the beginning and
/// the request: made again, whatever was made in between, or by another scheme of the same kind on the same system, it
/// gives the same bits. A scheme keeps nothing for itself but work space, and results that would be the same if they
/// were made anew (docs/decisions/0008-state-is-the-only-memory.md).
class Scheme {
 public:
  virtual ~Scheme() = default;
  virtual void start(State& state, double dt) = 0;
  /// `end` is another object than `begin`.
  virtual StepReport step(const State& begin, const StepRequest& request, State& end) = 0;
  /// The impulse of the forces over a step is h times their mean, in which the force at the end has this weight and
  /// that at the beginning 1 minus it. Where State::within has a weight of its own, these two share what it leaves.
  virtual double end_weight() const = 0;
  /// The name, for the log, of the linear solver that serves the scheme from this state on.
  virtual std::string solver_name(const State& state) const = 0;
  /// On several ranks, the nodes that a rank knows of the states that its steps end with; null: all.
  virtual const Holding* shared_nodes() const { return nullptr; }
};

}  // namespace carom
