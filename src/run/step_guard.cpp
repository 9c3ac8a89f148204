#include "run/step_guard.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"

namespace carom {

namespace {

StepControl::Halving halving_of(const Stage& stage) {
  const bool may_halve = !stage.time().fixed && !is_explicit(stage.settings().kind);
  return may_halve ? StepControl::Halving::allowed : StepControl::Halving::forbidden;
}

std::optional<EventTolerance> event_tolerance_of(const Stage& stage) {
  const std::optional<double>& given = stage.time().event_tolerance;
  if (given) return EventTolerance{.time = *given * stage.dt()};
  if (!is_explicit(stage.settings().kind) || stage.system().contact.is_fixed()) return std::nullopt;
  const std::vector<double>& lengths = stage.system().solid.cell_lengths();
  return EventTolerance{.depth = 0.5 * *std::min_element(lengths.begin(), lengths.end())};
}

}  // namespace

StepGuard::StepGuard(const Stage& stage)
    : stage_(stage),
      control_(stage.begin(), stage.dt(), stage.steps(), halving_of(stage)),
      tolerance_(event_tolerance_of(stage)) {
  if (stage.stable_step_changes()) watch_.emplace(stage.watch_stable_step());
}

bool StepGuard::is_to_be_repeated(const State& begin, const State& end, const Forces& forces, long long step) {
  constexpr int most_cuts = 8;
  const double dt = control_.dt();
  if (watch_ && !watch_->knows(forces.rows)) {
    follow_stable_step(begin, end, step);
    if (control_.dt() < dt * (1.0 - 1e-9)) return true;
  }
  if (!tolerance_ || cuts_ == most_cuts) return false;
  const std::optional<double> fraction = contact_event(begin, end, forces.rows, *tolerance_);
  if (!fraction || !control_.cut(*fraction)) return false;
  ++cuts_;
  return true;
}

void StepGuard::accept() {
  control_.accept();
  if (cuts_ > 0 && tolerance_->time > 0.0) control_.refine(tolerance_->time);
  cuts_ = 0;
}

void StepGuard::follow_stable_step(const State& before, const State& now, long long step) {
  if (!watch_) return;
  const double stable = watch_->update(before.q, now.q);
  // The estimate may be a percent or two below that of the start, for which no step has to change.
  const double share = stage_.time().step ? 1.0 : std::min(1.0, 1.02 * stage_.time().safety);
  if (control_.limit(share * stable)) return;
  throw RunError(static_cast<int>(step), now.t,
                 fmt::format("the stable step has fallen to {:.3g}, {:.3g} of what it was at the start", stable,
                             share * stable / stage_.dt()));
}

}  // namespace carom
