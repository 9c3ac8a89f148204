// The nonlinear equation that every implicit scheme solves, once or more per step.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "enforcement/contact_port.hpp"
#include "enforcement/implicit_settings.hpp"
#include "schemes/anderson_mixing.hpp"
#include "schemes/forcing_term.hpp"
#include "schemes/imposed_motion.hpp"
#include "schemes/residual_tolerance.hpp"

namespace carom {

/// m M y + k F(x) = contact(x, v) + known on the free dofs, with x = x_hat + s y and v = v_hat + r y; the imposed dofs
/// are where their motions lead, and their y is what the mass feels.
struct StageEquation {
  double m = 1.0, k = 1.0;
  double s = 0.0, r = 0.0;
  double dt = 0.0;        ///< length of the stage
  std::size_t place = 0;  ///< of the stage in State::stages
  double share = 0.0;     ///< of the stage's own work that its residual may leave unbooked, whatever else is asked
  const FreeModes* free = nullptr;  ///< where m = 0 leaves motions that only contact holds
  std::span<const double> x_hat{}, v_hat{}, known{};
  std::span<const double> x_predicted{};  ///< see StageStart
  std::span<const ImposedStep> imposed{};
};

struct StageReport {
  bool converged = false;
  int iterations = 0, linear_iterations = 0;
  std::string failure;
  double rounding = 0.0;  ///< energy that the residual may leave unbooked, where that is rounding
};

/// The internal force of a stage. value() fills the internal forces of `end` at end.q, and all else that follows from
/// the bodies there; factor x K(tangent_at) is its tangent.
struct StageForce {
  std::function<void(const PointStep& step, State& end)> value;
  std::function<std::span<const double>(std::span<const double> x)> tangent_at;
  double factor = 1.0;
};

/// Newton's method with m M + k s K(x) and the contact of a port. Equilibrium is reached when energy and momentum that
/// the residual could leave unbooked are at most the given tolerance, or at most what rounding leaves. The tangent of
/// rows that move (turning normals, changing weights) is not complete; AndersonMixing makes up for what is missing.
class ImplicitStage {
 public:
  /// ratio: k s / m of the usual step; omega_max_squared: a bound of the spectrum of M^-1 K. Both choose the solver.
  ImplicitStage(const System& system, const ImplicitSettings& settings, double ratio, double omega_max_squared);
  /// The same stage with a port and a force of the caller's.
  ImplicitStage(const System& system, const ImplicitSettings& settings, double ratio, double omega_max_squared,
                std::unique_ptr<ContactPort> port, StageForce force);

  /// Solves for end.a = y, whose prescribed entries are given and whose others are the start value; end.q, end.v, the
  /// contact history and the memory of the stage (that of the beginning on entry) follow. end.forces: external is
  /// given; internal, contact and rows are filled.
  StageReport solve(const StageEquation& equation, const State& begin, const ResidualTolerance& allowed, State& end);
  /// Fills the memory of the stage in the state that a run begins with.
  void start_memory(State& state, std::size_t place) const;
  /// Does what start_memory() does, and fills the contact forces and their history.
  void start(State& state, std::size_t place);

  /// Adds springs to the operator, not to the equation, so that the operator has an inverse where only contact holds a
  /// body.
  void hold(const std::vector<DofSpring>& springs);

  const ContactPort& port() const { return *port_; }
  std::string solver_name(const State& state, std::size_t place = 0) const {
    return solver_->name(place < state.stages.size() ? state.stages[place] : StageMemory{});
  }

 private:
  struct Residual;
  Residual residual(const StageEquation& equation, const State& begin, State& end);
  Residual shorten(const StageEquation& equation, const State& begin, Residual error, State& end);
  bool is_equilibrium(const StageEquation& equation, const Residual& error, double wanted, const Residual& before,
                      const Residual& earlier) const;
  std::string improve(const StageEquation& equation, const State& begin, double absolute, State& end,
                      StageReport& report);
  void leave(const StageEquation& equation, StageMemory& memory) const;
  std::string cycling_rows(const std::vector<RowStatus>& before, const Forces& forces) const;

  /// c of the operator m M + c K.
  double stiffness_share(const StageEquation& equation) const { return force_.factor * equation.k * equation.s; }

  const System& system_;
  int max_iterations_;
  double reach_;  ///< ContactGeometry::reach
  std::unique_ptr<EffectiveSolver> solver_;
  std::unique_ptr<ContactPort> port_;
  StageForce force_;
  AndersonMixing mixing_;
  ForcingTerm forcing_{true};
  std::vector<double> residual_, force_parts_;
  std::vector<double> correction_;                            ///< the last step of Newton's method
  std::vector<double> stiffness_diagonal_, closed_diagonal_;  ///< of K and the springs; of all contact rows, closed
  bool is_improved_ = false;                                  ///< the stage under way has made a Newton step
  bool has_more_inertia_ = false;                             ///< than the equation, in the operator of the last step
  double slope_ = 0.0;                                        ///< of the residual along the last step, before it
  double softest_ = std::numeric_limits<double>::infinity();  ///< smallest entry of K's diagonal above 0
  double body_force_ = 0.0;  ///< 2-norm of the forces by which rigid bodies that turn round (Solid)
};

/// The force F(x) of the bodies, which fills their energies and the history of their points as well.
StageForce force_of_bodies(const System& system);

/// Sets the imposed entries of y so that the scheme's own rule gives the velocity at the end, v = v_hat + r y: momentum
/// is then exact.
void impose_on_stage(const StageEquation& equation, std::span<double> y);

/// Makes the first state of an implicit scheme: start_with_supports, the forces, multipliers included, and
/// accelerations in equilibrium with them. dt: the first step.
void start_in_equilibrium(const System& system, ImplicitStage& stage, double dt, State& state, std::size_t place = 0);

}  // namespace carom
