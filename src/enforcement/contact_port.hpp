// The interface at which an implicit stage meets contact, whichever enforcement it has.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "enforcement/contact_work.hpp"
#include "enforcement/implicit_settings.hpp"
#include "system/effective_solver.hpp"
#include "system/free_modes.hpp"
#include "system/system.hpp"

namespace carom {

/// The beginning of a stage, and how its state follows its unknown y: x = x_hat + s y, v = v_hat + r y.
struct StageStart {
  const State* begin = nullptr;
  const StageMemory* memory = nullptr;  ///< of the stage, in `begin`
  double s = 0.0, r = 0.0;
  double m = 1.0, c = 0.0;                ///< the operator of the stage is m M + c K
  const FreeModes* free = nullptr;        ///< see StageEquation
  std::span<const double> x_predicted{};  ///< where impulses decide which rows are closed
  std::span<const double> force_parts{};  ///< magnitudes of the forces whose sum the residual is, of the last iterate
  double dt = 0.0;                        ///< length of the stage
};

/// By how much contact conditions are still violated at a trial state, as energy, and how much of that is rounding.
struct ContactError {
  double work = 0.0;
  double round_off = 0.0;
};

/// The result of a linear system that a port has solved.
struct PortSolve {
  LinearSolveReport linear;
  std::string failure;  ///< why there is no solution, "" when there is one
};

/// One enforcement of contact within implicit stages. A stage calls begin() once, before anything else; the state that
/// it gives outlives the stage.
class ContactPort {
 public:
  virtual ~ContactPort() = default;
  virtual void begin(const StageStart& start) = 0;
  /// True when the forces are a function of displacement and velocity. Otherwise conditions decide them, and the start
  /// of a run has to find them.
  virtual bool is_law() const = 0;
  /// True when respond() may be asked at any displacement and velocity, until settle() or renew() change its forces.
  /// False when solve() finds forces that are right at the end of its whole correction only.
  virtual bool is_function() const { return false; }
  /// Fills the forces on the rows at displacement x and velocity v.
  virtual void respond(std::span<const double> x, std::span<const double> v, ContactResponse& response) = 0;
  /// The violation, at x and v, of those conditions that `response`, the answer there, does not satisfy by its law.
  virtual ContactError error(std::span<const double> x, std::span<const double> v,
                             const ContactResponse& response) const = 0;
  /// Solves A dy = residual with contact following dy; `response` and `residual` (its forces included) belong to x
  /// and v.
  virtual PortSolve solve(EffectiveSolver& solver, std::span<const double> x, std::span<const double> v,
                          const ContactResponse& response, std::span<const double> residual, double absolute,
                          std::span<double> dy) = 0;
  /// Takes from a residual at x what loads motions that nothing resists, where that is rounding (FreeModes::relieve).
  virtual void relieve(std::span<const double> /*x*/, const ContactResponse& /*response*/,
                       std::span<double> /*residual*/) const {}
  /// Called at equilibrium. Returns true when the contact conditions are met; otherwise it has changed the forces, and
  /// equilibrium must be found again.
  virtual bool settle(std::span<const double> x, const ContactResponse& response) = 0;
  /// Called short of equilibrium, with the 2-norm of the residual. Returns true when it has changed the forces already
  /// now.
  virtual bool renew(std::span<const double> /*x*/, const ContactResponse& /*response*/, double /*residual*/) {
    return false;
  }
  /// d += the stiffness of contact on the diagonal, for the round-off of equilibrium.
  virtual void add_stiffness_diagonal(std::span<double> d) const = 0;
  /// The work of contact over a step. Multipliers work as supports do (StepWeights::support_work): those of the
  /// beginning count (1 - end_weight) times, those of the end end_weight times.
  virtual ContactWork work(const State& begin, const State& end, double end_weight) const = 0;
  /// Writes what the port has kept of a stage, whose solve() has been called, into the memory that the next stage
  /// begins with.
  virtual void leave(StageMemory& /*memory*/) const {}
};

}  // namespace carom
