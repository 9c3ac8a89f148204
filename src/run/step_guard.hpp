// What decides the length of the steps of a stage: failures, contact that closes, the stable step.
#pragma once

#include <optional>

#include "run/contact_event.hpp"
#include "run/stage.hpp"
#include "run/step_control.hpp"

namespace carom {

/// Implicit stages with time.event_tolerance: a step in which rows close earlier before its end than the tolerance, as
/// a fraction of the usual step, is made again so that it ends at the touch (contact_event), at most eight times; the
/// steps after it are no longer than the tolerance either, and grow again. Explicit stages whose stable step changes: a
/// step with springs on rows that the last estimate did not know is made again where they make it unstable; and one in
/// which rows that move close by more than half of the smallest cell ends at the touch, since a row that deep may be
/// lost in the next step.
class StepGuard {
 public:
  explicit StepGuard(const Stage& stage);

  const StepControl& control() const { return control_; }
  bool halve() { return control_.halve(); }

  /// True when the converged step from `begin` to `end`, number `step`, has to be made again, its length having been
  /// changed.
  bool is_to_be_repeated(const State& begin, const State& end, const Forces& forces, long long step);
  /// The step counts.
  void accept();
  /// Re-estimates the stable step, where it changes, after step number `step`. Throws RunError when it has become too
  /// short.
  void follow_stable_step(const State& before, const State& now, long long step);

 private:
  const Stage& stage_;
  StepControl control_;
  std::optional<StableStepWatch> watch_;     ///< where the stable step changes
  std::optional<EventTolerance> tolerance_;  ///< where contact events cut the step
  int cuts_ = 0;                             ///< of the present step
};

}  // namespace carom
