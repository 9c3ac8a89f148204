// How an implicit stage meets contact, whichever enforcement it has.
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

/// Where a stage begins and how its state follows its unknown y: x = x_hat + s y, v = v_hat + r y.
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

/// What contact still violates at a trial state, as energy, and how much of that is rounding.
struct ContactError {
  double work = 0.0;
  double round_off = 0.0;
};

/// What a port makes of a linear system.
struct PortSolve {
  LinearSolveReport linear;
  std::string failure;  ///< why there is no solution, "" when there is one
};

/// One enforcement of contact within implicit stages. begin() comes first, once per stage; the state that it is given
/// outlives the stage.
class ContactPort {
 public:
  virtual ~ContactPort() = default;
  virtual void begin(const StageStart& start) = 0;
  /// True when displacement and velocity decide the forces; else conditions do, and a start has to find them.
  virtual bool is_law() const = 0;
  /// True when respond() answers at any displacement and velocity, until settle() or renew() change its forces; false
  /// when solve() brings forces that belong to the whole of its correction.
  virtual bool is_function() const { return false; }
  /// Forces on the rows at displacement x and velocity v.
  virtual void respond(std::span<const double> x, std::span<const double> v, ContactResponse& response) = 0;
  /// Violation of the conditions that `response`, the answer at x and v, does not satisfy by its law.
  virtual ContactError error(std::span<const double> x, std::span<const double> v,
                             const ContactResponse& response) const = 0;
  /// Solves A dy = residual with contact following dy; `response` and `residual` (its forces included) belong to x
  /// and v.
  virtual PortSolve solve(EffectiveSolver& solver, std::span<const double> x, std::span<const double> v,
                          const ContactResponse& response, std::span<const double> residual, double absolute,
                          std::span<double> dy) = 0;
  /// At equilibrium: true when the contact conditions are met; else the forces have been changed and equilibrium must
  /// be found again.
  virtual bool settle(std::span<const double> x, const ContactResponse& response) = 0;
  /// Short of equilibrium, whose residual has this 2-norm: true when the forces have been changed all the same.
  virtual bool renew(std::span<const double> /*x*/, const ContactResponse& /*response*/, double /*residual*/) {
    return false;
  }
  /// d += the stiffness of contact on the diagonal, for the round-off of equilibrium.
  virtual void add_stiffness_diagonal(std::span<double> d) const = 0;
  /// Work over a step. Multipliers work as supports do (StepWeights::support_work), (1 - end_weight) times those of the
  /// beginning and end_weight times those of the end.
  virtual ContactWork work(const State& begin, const State& end, double end_weight) const = 0;
  /// Writes what the port has kept of the stage, whose solve() has been called, to where the next one looks for it.
  virtual void leave(StageMemory& /*memory*/) const {}
};

/// The port of settings.enforcement.
std::unique_ptr<ContactPort> make_contact_port(const System& system, const ImplicitSettings& settings);

}  // namespace carom
