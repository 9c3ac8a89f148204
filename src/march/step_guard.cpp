#include "march/step_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.hpp"
#include "march/contact_event.hpp"
#include "march/failure_text.hpp"
#include "parallel/threads.hpp"
#include "rows/admissible.hpp"

namespace carom {

namespace {

StepControl::Halving halving_of(const Stage& stage) {
  const bool may_halve = !stage.time().fixed && !is_explicit(stage.settings().kind);
  return may_halve ? StepControl::Halving::allowed : StepControl::Halving::forbidden;
}

/// True where the length of the steps is left to the program: of explicit ones altogether, of implicit ones below what
/// the case gives.
bool may_shorten(const Stage& stage) {
  if (is_explicit(stage.settings().kind)) return !stage.time().step;
  return has_inertia(stage.settings().kind) && !stage.time().fixed && stage.system().contact.slots() > 0;
}

const std::string& contact_name(const Model& model, Index contact) {
  return std::visit([](const auto& c) -> const std::string& { return c.name; },
                    model.contacts[static_cast<std::size_t>(contact)]);
}

/// "contact "floor" at node 12"
std::string row_place(const System& system, const Model& model, const ConstraintRows& rows, std::size_t r) {
  const auto node = static_cast<std::size_t>(rows.node[static_cast<std::size_t>(rows.begin[r])]);
  const Vec3& x = system.mesh.coordinates[node];
  const std::string at = fmt::format("at node {} ({:.4g}, {:.4g}, {:.4g})",
                                     system.mesh.node_label(static_cast<Index>(node)), x[0], x[1], x[2]);
  if (rows.source[r] < 0) return at;
  return fmt::format("contact \"{}\" {}", contact_name(model, rows.source[r]), at);
}

/// The row whose change misplaces most energy; rows.size() where none changes.
std::size_t worst_change(const ConstraintRows& rows, const State& begin, const State& end) {
  std::size_t worst = rows.size();
  double most = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double change = -rows.law[r].eps_N * rows.gap_at(r, begin.q) * rows.gap_at(r, end.q);
    if (is_bond(rows.law[r]) || change <= most) continue;
    most = change;
    worst = r;
  }
  return worst;
}

std::string cell_place(const System& system, Index cell) {
  const CellRef& ref = system.solid.cells()[static_cast<std::size_t>(cell)];
  const Vec3& x =
      system.mesh
          .coordinates[static_cast<std::size_t>(system.solid.cells().nodes_of(static_cast<std::size_t>(cell)).front())];
  return fmt::format("cell {} at ({:.4g}, {:.4g}, {:.4g})", system.mesh.cell_label(ref), x[0], x[1], x[2]);
}

}  // namespace

StepGuard::StepGuard(const Stage& stage)
    : stage_(stage),
      control_(stage.begin(), stage.dt(), stage.steps(), halving_of(stage)),
      event_tolerance_(stage.time().event_tolerance.value_or(0.0) * stage.dt()) {
  if (has_inertia(stage.settings().kind) && stage.system().contact.slots() > 0) motion_.emplace(stage.model());
  if (stage.stable_step_changes()) watch_.emplace(stage.watch_stable_step());
  // Linear bodies without contact make no energy at a stable step; what it lends them is much where they vibrate fast.
  const bool may_gain = stage.system().contact.slots() > 0 || !stage.system().solid.is_linear();
  if (may_gain && traits(stage.settings().enforcement).adds_stiffness && may_shorten(stage)) energy_.emplace();
}

bool StepGuard::prolong(double end) {
  const double steps = (end - stage_.begin()) / stage_.dt();
  if (stage_.time().fixed && std::abs(steps - std::round(steps)) > 1e-6) return false;
  control_.end_at(end);
  return true;
}

bool StepGuard::shorten(const State& now, long long step, const std::string& failure) {
  constexpr int most_failures = 6;
  bool is_shorter = false;
  if (!is_explicit(stage_.settings().kind)) {
    is_shorter = control_.halve();
  } else if (failures_ < most_failures) {
    is_restless_ = true;
    if (++failures_ == 1) follow_stable_step(now, step);
    is_shorter = control_.cut(0.5);
  }
  if (is_shorter) note(ShortStep::fails, now.t, step, failure);
  return is_shorter;
}

void StepGuard::note(ShortStep reason, double t, long long step, std::string place) {
  notes_.add(reason, {step, t, control_.dt()}, std::move(place));
}

/// Little is not worth a line: it comes with every deformation.
void StepGuard::note_stable_step(double t, long long step) {
  constexpr double worth = 0.8;
  if (control_.dt() > worth * stage_.dt()) return;
  const bool is_cell = is_short_for_bodies_ && watch_->worst_cell() >= 0;
  note(ShortStep::stiffens, t, step, is_cell ? cell_place(stage_.system(), watch_->worst_cell()) : "");
}

std::vector<std::string> StepGuard::notes() const {
  return notes_.lines(stage_.dt(), energy_remedy(stage_));
}

void StepGuard::limit_motion(const State& now, const ConstraintRows& rows, long long step) {
  if (motion_) cut_motion(motion_->foreseen(now, rows, control_.dt()), rows, now.t, step);
}

bool StepGuard::is_to_be_repeated(const State& begin, const State& end, const EnergyGuard::Books& books,
                                  long long step) {
  constexpr int most_cuts = 8;
  if (watch_ && !fits(begin, end, step)) return true;
  if (energy_ && makes_energy(begin, end, books, step)) return true;
  if (cuts_ == most_cuts) return false;
  const bool is_cut =
      motion_ && cut_motion(motion_->overrun(begin, end, end.forces.rows), *end.forces.rows.rows, begin.t, step);
  if (!is_cut && !ends_late(begin, end, step)) return false;
  ++cuts_;
  return true;
}

/// Cuts a step that makes energy or misplaces it.
bool StepGuard::makes_energy(const State& begin, const State& end, const EnergyGuard::Books& books, long long step) {
  if (!is_explicit(stage_.settings().kind)) {
    if (!energy_->gains_too_much(books) || !control_.halve()) return false;
    note(ShortStep::makes_energy, begin.t, step, "");
    return true;
  }
  const std::optional<double> fraction = energy_->cut(begin, end, end.forces.rows, books);
  if (!fraction || !control_.cut(*fraction)) return false;
  const ConstraintRows& rows = *end.forces.rows.rows;
  if (energy_->has_made_energy()) {
    note(ShortStep::makes_energy, begin.t, step, worst_place(stage_.system(), end));
  } else {
    const std::size_t worst = worst_change(rows, begin, end);
    note(ShortStep::misplaces, begin.t, step,
         worst < rows.size() ? row_place(stage_.system(), stage_.model(), rows, worst) : "");
  }
  return true;
}

/// Cuts a step that carries contact too far; false where it does not, or is the shortest.
bool StepGuard::cut_motion(const std::optional<MotionLimit::Overrun>& overrun, const ConstraintRows& rows, double t,
                           long long step) {
  if (!overrun) return false;
  if (stage_.time().fixed) {
    throw RunError(
        static_cast<int>(step), t,
        fmt::format("contact \"{}\" closes by {:.3g} of a cell within one step, more than the half that it "
                    "may, and the case fixes the step: lower time.step to about {:.2g}, or leave out "
                    "fixed = true to have such steps cut",
                    contact_name(stage_.model(), overrun->contact), overrun->depth, overrun->fraction * control_.dt()));
  }
  if (!control_.cut(overrun->fraction)) return false;
  note(ShortStep::carries_too_far, t, step, row_place(stage_.system(), stage_.model(), rows, overrun->row));
  return true;
}

/// Cuts a step in which contact closes long before the end.
bool StepGuard::ends_late(const State& begin, const State& end, long long step) {
  if (event_tolerance_ == 0.0) return false;
  const std::optional<double> fraction = contact_event(begin, end, end.forces.rows, event_tolerance_);
  if (!fraction || !control_.cut(*fraction)) return false;
  note(ShortStep::ends_at_touch, begin.t, step, "");
  is_at_event_ = true;
  return true;
}

void StepGuard::accept(const State& begin, const EnergyGuard::Books& books, long long step) {
  control_.accept();
  if (energy_) {
    const double share = energy_->share();
    energy_->accept(books);
    if (!watch_) control_.limit(energy_->share() * stage_.dt());
    if (energy_->share() < share) note(ShortStep::makes_energy, begin.t, step, "");
  }
  if (is_at_event_) control_.refine(event_tolerance_);
  is_at_event_ = false;
  cuts_ = failures_ = 0;
}

/// What a run takes of the steps that are advised. The estimate may be a percent or two below that of the start, for
/// which no step has to change.
double StepGuard::share() const {
  if (stage_.time().step) return 1.0;
  return (energy_ ? energy_->share() : 1.0) * std::min(1.0, 1.02 * stage_.time().safety);
}

/// The longest step from displacement u, where rows_ stand; where it is longer than `wanted`, no more than that may be
/// known of it.
double StepGuard::longest(std::span<const double> u, double wanted) {
  static const ConstraintRows none;
  const StableStep steps = watch_->with(rows_ ? *rows_ : none, u, wanted / share());
  advised_ = stage_.time().step ? steps.dt : steps.advised();
  is_short_for_bodies_ = steps.dt_free < 1.01 * advised_;
  return share() * advised_;
}

/// False when springs, viscosity or distortion control act at the end that need a step at least 2^(1/8) shorter than
/// the one that met them, which is the length of the next ones then.
bool StepGuard::fits(const State& begin, const State& end, long long step) {
  const Forces& forces = end.forces;
  rows_ = forces.rows.rows;
  const bool resists = forces.stored.distortion > 0.0;
  if (resists) watch_->follow_bodies(end);
  const bool is_damped = watch_->follow_damping(end.points);
  const double dt = control_.dt(), least = dt * std::exp2(-1.0 / 8.0);
  const double longest = this->longest(end.q, dt);
  bool springs_act = false;
  for (std::size_t r = 0; r < forces.rows.status.size(); ++r)
    springs_act = springs_act || (forces.rows.status[r] != RowStatus::open && !is_bond(rows_->law[r]));
  if ((!springs_act && !is_damped && !resists) || longest >= least || !control_.limit(longest)) return true;
  if (control_.dt() >= dt) return true;
  note_stable_step(begin.t, step);
  return false;
}

void StepGuard::begin_at(const State& now, long long step) {
  if (!watch_ || is_zero(now.q)) return;
  is_restless_ = true;
  follow_stable_step(now, step);
}

void StepGuard::follow_stable_step(const State& now, long long step) {
  if (!watch_) return;
  constexpr long long every = 10;
  constexpr double restless = 0.05;  // change of the bodies' frequency after which they are looked at again at once
  const bool is_due = step % every == 0 || is_restless_;
  if (is_due) is_restless_ = watch_->follow_bodies(now) > restless;
  if (!is_due && share() * advised_ >= control_.dt()) return;
  const double longest = this->longest(now.q);
  if (!is_due && longest >= control_.dt()) return;
  const double before = control_.dt();
  if (control_.limit(longest)) {
    if (control_.dt() < before) note_stable_step(now.t, step);
    return;
  }
  throw RunError(static_cast<int>(step), now.t,
                 fmt::format("the stable step has fallen to {:.3g}, {:.3g} of what it was at the start", longest,
                             longest / stage_.dt()));
}

}  // namespace carom
