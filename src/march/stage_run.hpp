// A stage of a run on its way.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "build/simulation.hpp"
#include "energy/ledger.hpp"
#include "march/step_guard.hpp"
#include "march/step_scale.hpp"
#include "schemes/scheme.hpp"

namespace carom {

/// A step that has been made, and its length.
struct MadeStep {
  double dt = 0.0;
  StepReport report;
};

/// Leads a state through one stage: the scheme, and what decides how long its steps are.
class StageRun {
 public:
  /// Number: of Simulation::stages(). rest: the energy that cannot be told from rounding (rest_energy). The simulation
  /// outlives the object.
  StageRun(const Simulation& simulation, std::size_t number, double rest);

  std::size_t number() const { return number_; }
  const Stage& stage() const { return *s_.stages()[number_]; }
  const Scheme& scheme() const { return *scheme_; }
  bool at_end() const { return steps_.control().at_end(); }
  /// Scheme::solver_name at the begin or at the last change.
  const std::string& solver() const { return solver_; }
  /// Why steps were cut or kept short, for the log.
  std::vector<std::string> notes() const { return steps_.notes(); }

  /// Lets the scheme take over the state that the run has come to with this step. Throws RunError.
  void begin(State& state, long long step);
  /// The same with a new scheme where cells have gone.
  void begin_again(State& state, long long step);
  /// Moves the end of the stage; false where the case fixes the step and none ends there.
  bool prolong(double end) { return steps_.prolong(end); }
  /// A step, of this number, from `begin` to `end` that holds, shortened and made again as often as need be; one that
  /// has not converged where there is none. Throws RunError.
  MadeStep make_step(const State& begin, State& end, const EnergyLedger& ledger, long long step);
  /// Lets the length of the steps follow the stable step, after this one (StepGuard::follow_stable_step).
  void follow_stable_step(const State& state, long long step) { steps_.follow_stable_step(state, step); }
  /// True once when the scheme has come to another solver than solver() says, as where a tangent is not positive
  /// definite.
  bool changes_solver(const State& state);

 private:
  template <class A>
  friend void fields(A& archive, StageRun& x) {
    archive("steps", x.steps_);
    archive("step_scale", x.step_scale_);
    archive("solver", x.solver_);
  }
  void start_scheme(State& state, double dt, long long step);
  void let_follow(State& state) const;

  const Simulation& s_;
  std::size_t number_;
  double mass_;
  std::unique_ptr<Scheme> scheme_;
  StepGuard steps_;
  StepScale step_scale_;
  std::string solver_;
};

}  // namespace carom
