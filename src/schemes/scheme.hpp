// The interface of a time scheme: one step, state in, state out.
#pragma once

#include <span>
#include <string>

#include "schemes/system.hpp"

namespace carom {

/// What the run asks of a step.
struct StepRequest {
  double t_end = 0.0;           ///< time at the end of the step
  double dt = 0.0;              ///< its length
  double work_tolerance = 0.0;  ///< energy that the residual may leave unbooked in this step
};

/// What became of a step. Not converging is a return value: the state and the scheme stay as they were.
struct StepReport {
  bool converged = false;
  int iterations = 0;         ///< Newton iterations on the contact state (0 for explicit schemes)
  int linear_iterations = 0;  ///< conjugate-gradient iterations, all Newton iterations together
  std::string failure;        ///< why it did not converge; names the rows that cycle
  LedgerIncrement books;
};

/// Contact at an instant within a step, for schemes that solve for it there, and the weight of its forces in the
/// impulse of the step (0: there is none).
struct ContactWithin {
  double weight = 0.0;
  const ContactResponse* rows = nullptr;
  std::span<const double> u{};
};

/// One step of a scheme. start() makes velocities and accelerations consistent with the supports and the forces at
/// state.t; step() must be given the state that start() or the last converged step() has left.
class Scheme {
 public:
  virtual ~Scheme() = default;
  virtual void start(State& state, double dt) = 0;
  virtual StepReport step(const State& begin, const StepRequest& request, State& end) = 0;
  /// Takes the last converged step back, so that another may be made from the state that it began with. Not twice in a
  /// row.
  virtual void take_back() = 0;
  /// Forces of the last started or converged state.
  virtual const Forces& forces() const = 0;
  /// Weight of the force at the end of a step in its impulse, 1 minus that of the force at its beginning: of what
  /// contact_within() leaves.
  virtual double end_weight() const = 0;
  /// Of the last converged step.
  virtual ContactWithin contact_within() const { return {}; }
  /// Name of the linear solver that serves the scheme, for the log.
  virtual std::string solver_name() const = 0;
};

}  // namespace carom
