// What decides the length of the steps of a stage: failures, contact that closes, the stable step.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "build/stage.hpp"
#include "march/energy_guard.hpp"
#include "march/motion_limit.hpp"
#include "march/step_control.hpp"
#include "march/step_notes.hpp"

namespace carom {

/// Contact that closes too far within a step (MotionLimit) has it made again, shorter; what the velocity foretells
/// is cut beforehand. Where the case fixes the step, the run stops. Statics are free to move as far as they like.
/// Implicit stages with time.event_tolerance: a step in which rows close earlier before its end than the tolerance, as
/// a fraction of the usual step, is made again so that it ends at the touch (contact_event); the steps after it are no
/// longer than the tolerance either, and grow again. Both at most eight times in a step. Explicit stages whose stable
/// step changes follow it (StableStepWatch), and a step that meets springs or rates of viscosity for which it was too
/// long is made again.
/// Where contact is springs and the case leaves the explicit step to the program, steps that make energy are made again
/// (EnergyGuard), and what it makes shorter for good stays so for the rest of the stage; so are implicit ones that
/// gain, unless the step is fixed.
class StepGuard {
 public:
  explicit StepGuard(const Stage& stage);

  const StepControl& control() const { return control_; }
  /// Moves the end of the stage; false where the case fixes the step and none ends there.
  bool prolong(double end);
  /// Shortens the step from `now`, number `step`, that has failed for the given reason; false when it may not be
  /// shorter. Explicit steps are halved a few times, once the stable step has been looked at.
  bool shorten(const State& now, long long step, const std::string& failure);
  /// Shortens the step from `now`, number `step`, to what contact may close within it; `rows` are those of `now`.
  /// Throws RunError where the case fixes it.
  void limit_motion(const State& now, const ConstraintRows& rows, long long step);
  /// True when the converged step from `begin` to `end`, number `step`, has to be made again, its length having been
  /// changed. Throws RunError where contact moves too far in a step that the case fixes.
  bool is_to_be_repeated(const State& begin, const State& end, const EnergyGuard::Books& books, long long step);
  /// The step from `begin`, number `step`, counts.
  void accept(const State& begin, const EnergyGuard::Books& books, long long step);
  /// Why steps were cut or kept short, for the log.
  std::vector<std::string> notes() const;
  /// Looks at the stable step of bodies that are deformed where the stage begins: its usual step is that of the mesh.
  /// Throws as follow_stable_step.
  void begin_at(const State& now, long long step);
  /// Looks at the stable step, where it changes, after step number `step`: at that of the contact after every step, at
  /// that of the bodies after every tenth, or after the next where they have changed; steps grow only then. Throws
  /// RunError when it has become too short.
  void follow_stable_step(const State& now, long long step);

 private:
  template <class A>
  friend void fields(A& archive, StepGuard& x) {
    archive("control", x.control_);
    if (x.watch_) archive("watch", *x.watch_);
    archive("rows", x.rows_);
    archive("is_restless", x.is_restless_);
    if (x.energy_) archive("energy", *x.energy_);
    archive("is_at_event", x.is_at_event_);
    archive("cuts", x.cuts_);
    archive("failures", x.failures_);
    archive("notes", x.notes_);
  }

  bool cut_motion(const std::optional<MotionLimit::Overrun>& overrun, const ConstraintRows& rows, double t,
                  long long step);
  bool ends_late(const State& begin, const State& end, long long step);
  bool makes_energy(const State& begin, const State& end, const EnergyGuard::Books& books, long long step);
  bool fits(const State& begin, const State& end, long long step);
  void note(ShortStep reason, double t, long long step, std::string place);
  void note_stable_step(double t, long long step);
  double share() const;
  double longest(std::span<const double> u, double wanted = std::numeric_limits<double>::infinity());

  const Stage& stage_;
  StepControl control_;
  std::optional<StableStepWatch> watch_;        ///< where the stable step changes
  std::shared_ptr<const ConstraintRows> rows_;  ///< of the last step, where it is watched
  double advised_ = 0.0;                        ///< a step that they allow, before it is multiplied by share()
  bool is_restless_ = false;                    ///< the bodies stiffen quickly
  std::optional<EnergyGuard> energy_;           ///< where springs act and steps may be shortened
  std::optional<MotionLimit> motion_;           ///< where there is contact and inertia
  double event_tolerance_ = 0.0;                ///< time; 0: contact events do not cut the step
  bool is_at_event_ = false;                    ///< the present step has been cut to end at a touch
  int cuts_ = 0, failures_ = 0;                 ///< of the present step
  bool is_short_for_bodies_ = false;            ///< no springs of contact bound advised_
  StepNotes notes_;
};

}  // namespace carom
