#include "run/step_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/errors.hpp"
#include "run/contact_event.hpp"

namespace carom {

namespace {

StepControl::Halving halving_of(const Stage& stage) {
  const bool may_halve = !stage.time().fixed && !is_explicit(stage.settings().kind);
  return may_halve ? StepControl::Halving::allowed : StepControl::Halving::forbidden;
}

const std::string& contact_name(const Model& model, Index contact) {
  return std::visit([](const auto& c) -> const std::string& { return c.name; },
                    model.contacts[static_cast<std::size_t>(contact)]);
}

}  // namespace

StepGuard::StepGuard(const Stage& stage)
    : stage_(stage),
      control_(stage.begin(), stage.dt(), stage.steps(), halving_of(stage)),
      event_tolerance_(stage.time().event_tolerance.value_or(0.0) * stage.dt()) {
  if (stage.settings().kind != SchemeKind::statics && stage.system().contact.slots() > 0)
    motion_.emplace(stage.model(), stage.system().solid);
  if (stage.stable_step_changes()) watch_.emplace(stage.watch_stable_step());
}

bool StepGuard::shorten(const State& now, long long step) {
  if (!is_explicit(stage_.settings().kind)) return control_.halve();
  constexpr int most_failures = 6;
  if (failures_ == most_failures) return false;
  if (++failures_ == 1) follow_stable_step(now, now, step);
  return control_.cut(0.5);
}

void StepGuard::limit_motion(const State& now, const ConstraintRows& rows, long long step) {
  if (motion_) cut_motion(motion_->foreseen(now, rows, control_.dt()), now.t, step);
}

bool StepGuard::is_to_be_repeated(const State& begin, const State& end, const Forces& forces, long long step) {
  constexpr int most_cuts = 8;
  const double dt = control_.dt();
  if (watch_ && !watch_->knows(forces.rows)) {
    follow_stable_step(begin, end, step);
    if (control_.dt() < dt * (1.0 - 1e-9)) return true;
  }
  if (cuts_ == most_cuts) return false;
  const bool is_cut = motion_ && cut_motion(motion_->overrun(begin, end, forces.rows), end.t, step);
  if (!is_cut && !ends_late(begin, end, forces)) return false;
  ++cuts_;
  return true;
}

/// Cuts a step that carries contact too far; false where it does not, or is the shortest.
bool StepGuard::cut_motion(const std::optional<MotionLimit::Overrun>& overrun, double t, long long step) {
  if (!overrun) return false;
  if (stage_.time().fixed) {
    throw RunError(
        static_cast<int>(step), t,
        fmt::format("contact \"{}\" closes by {:.3g} of a cell within one step, more than the half that it "
                    "may, and the case fixes the step: lower time.step to about {:.2g}, or leave out "
                    "fixed = true to have such steps cut",
                    contact_name(stage_.model(), overrun->contact), overrun->depth, overrun->fraction * control_.dt()));
  }
  return control_.cut(overrun->fraction);
}

/// Cuts a step in which contact closes long before the end.
bool StepGuard::ends_late(const State& begin, const State& end, const Forces& forces) {
  if (event_tolerance_ == 0.0) return false;
  const std::optional<double> fraction = contact_event(begin, end, forces.rows, event_tolerance_);
  if (!fraction || !control_.cut(*fraction)) return false;
  is_at_event_ = true;
  return true;
}

void StepGuard::accept() {
  control_.accept();
  if (is_at_event_) control_.refine(event_tolerance_);
  is_at_event_ = false;
  cuts_ = failures_ = 0;
}

void StepGuard::follow_stable_step(const State& before, const State& now, long long step) {
  if (!watch_) return;
  const double stable = watch_->update(before, now.q);
  // The estimate may be a percent or two below that of the start, for which no step has to change.
  const double share = stage_.time().step ? 1.0 : std::min(1.0, 1.02 * stage_.time().safety);
  if (control_.limit(share * stable)) return;
  throw RunError(static_cast<int>(step), now.t,
                 fmt::format("the stable step has fallen to {:.3g}, {:.3g} of what it was at the start", stable,
                             share * stable / stage_.dt()));
}

}  // namespace carom
