// What those that watch a run see of it.
#pragma once

#include <string_view>

#include "build/stage.hpp"
#include "energy/ledger.hpp"
#include "march/shared_state.hpp"
#include "march/verdict.hpp"
#include "schemes/scheme.hpp"

namespace carom {

/// What is known at the end of a step, or of the initial state (step 0).
struct StepView {
  long long step = 0;
  double dt = 0.0;
  int iterations = 0;
  const State& state;
  const Forces& forces;
  const EnergyLedger& ledger;
  const RunMonitor& monitor;
  const Stage& stage;
  double end_weight = 1.0;  ///< of the force at the end in the impulse (Scheme::end_weight)
  const ContactWithin& within;
  bool ends_stage = false;
  bool ends_run = false;
  std::string_view alarm{};  ///< why the run cannot go on after this step; "" where it can
  SharedState shared;        ///< what a rank does not know of the state, it asks for here

  /// What the points of the bodies remember.
  PointStep points() const { return {.dt = dt, .history = state.points, .is_over = true, .alive = state.alive()}; }
  /// No step follows.
  bool is_last() const { return ends_run || !alarm.empty(); }
};

/// Sees the initial state and every finished step, in their order, and changes nothing of the run.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void see(const StepView& view) = 0;
  /// The run ends early with a step (or an initial state) that has been seen as one of many.
  virtual void leave(const StepView& /*view*/) {}
};

}  // namespace carom
