#include "march/march.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/errors.hpp"
#include "build/build_mesh.hpp"
#include "march/body_scales.hpp"
#include "march/failure_text.hpp"
#include "march/folded_cells.hpp"
#include "march/inside_out.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

RunMonitor::StageKind kind_of(const Stage& stage, const State& begin) {
  const bool is_static = !has_inertia(stage.settings().kind);
  const double of_accelerations = is_static ? 0.0 : 0.125 * stage.dt() * stage.dt() * begin.forces.inertia_power;
  return {stage.reversible_energy(), is_static, is_explicit(stage.settings().kind), of_accelerations};
}

}  // namespace

March::March(const Simulation& simulation)
    : s_(simulation), state_(simulation.initial_state()), end_(simulation.end()) {
  std::fill(state_.v.begin(), state_.v.end(), 0.0);  // they begin with their stage
  if (!s_.model().erosion.empty()) erosions_.emplace(s_);
}

bool March::at_end() const {
  return steps_->control().at_end() && stage_number_ + 1 == s_.stages().size();
}

/// What has been started goes out as it is; what has not is made ready for what comes in.
void March::keep(Archive& archive) {
  archive("stage", stage_number_);
  if (stage_number_ >= s_.stages().size()) throw ArchiveError("it is of a stage that the case has not");
  if (!is_started()) {
    scheme_ = stage().make_scheme();
    steps_.emplace(stage());
    step_scale_.emplace(s_.model(), stage(), rest_energy(s_.solid(), reach(s_.mesh())));
    ledger_.emplace(EnergyTerms{}, Momentum{}, 0.0);
    monitor_.emplace(*ledger_, RunMonitor::Bodies{}, kind_of(stage(), state_));
  }
  keep_state(archive);
  keep_topology(archive);
  archive("steps", *steps_);
  archive("step_scale", *step_scale_);
  archive("ledger", *ledger_);
  archive("monitor", *monitor_);
  archive("end", end_);
  archive("step", step_);
  archive("dt", dt_);
  archive("iterations", iterations_);
  archive("solver", solver_);
  archive("log", log_);
  archive("dt_smallest", dt_smallest_);
  archive("dt_largest", dt_largest_);
  archive("body_strain", body_strain_);
}

/// What points remember goes out cell by cell, so that another instruction set can take it in.
void March::keep_state(Archive& archive) {
  using Lay = std::vector<double> (Solid::*)(std::span<const double>) const;
  const auto laid = [&](const std::vector<double>& history, Lay lay) {
    try {
      return (s_.solid().*lay)(history);
    } catch (const std::invalid_argument& e) {
      throw ArchiveError(e.what());
    }
  };
  const auto placed = [&](const std::shared_ptr<const TangentPlace>& at, Lay lay) {
    return at ? std::make_shared<const TangentPlace>(TangentPlace{at->dt, at->u, laid(at->points, lay)}) : nullptr;
  };
  std::vector<double> own = std::move(state_.points);
  const std::vector<double> sent = laid(own, &Solid::history_by_cell);
  state_.points = sent;
  std::vector<std::shared_ptr<const TangentPlace>> own_places, sent_places;
  for (StageMemory& stage : state_.stages) {
    own_places.push_back(stage.grids_at);
    stage.grids_at = placed(stage.grids_at, &Solid::history_by_cell);
    sent_places.push_back(stage.grids_at);
  }
  archive("state", state_);
  // What has come back unchanged keeps its own order: it went out.
  state_.points = state_.points == sent ? std::move(own) : laid(state_.points, &Solid::history_of_lanes);
  for (std::size_t i = 0; i < state_.stages.size(); ++i) {
    std::shared_ptr<const TangentPlace>& at = state_.stages[i].grids_at;
    at = i < sent_places.size() && at == sent_places[i] ? own_places[i] : placed(at, &Solid::history_of_lanes);
  }
}

/// Of the topology it is `alive` alone that goes out; the rest follows from it.
void March::keep_topology(Archive& archive) {
  if (!erosions_) return;
  std::vector<std::uint8_t> alive(state_.alive().begin(), state_.alive().end());
  archive("alive", alive);
  archive("eroded", erosions_->so_far());
  if (std::ranges::equal(alive, state_.alive())) return;
  state_.topology = alive.empty() ? nullptr : erosions_->topologies().of(std::move(alive));
}

void March::prolong(double end) {
  if (!(end > state_.t)) {
    throw std::invalid_argument(fmt::format("an end at {:.9g}, and the run has come to {:.9g} already", end, state_.t));
  }
  if (stage_number_ + 1 < s_.stages().size())
    throw std::invalid_argument("the last stage has not begun, and its end alone can be moved");
  if (!steps_->prolong(end)) {
    throw std::invalid_argument(
        fmt::format("the step is fixed at {:.9g}, and no whole number of them leads from {:.9g} to {:.9g}",
                    stage().dt(), stage().begin(), end));
  }
  end_ = end;
}

std::vector<double> March::hand_over(std::vector<double> State::*values) {
  std::vector<double> given = std::move(state_.*values);
  state_.*values = given;
  return given;
}

void March::start() {
  begin_stage();
  show();
}

void March::leave() {
  for (Observer* observer : observers_) observer->leave(view());
}

void March::show() {
  for (Observer* observer : observers_) observer->see(view());
}

StepView March::view() const {
  return {step_,
          dt_,
          iterations_,
          state_,
          state_.forces,
          *ledger_,
          *monitor_,
          stage(),
          scheme_->end_weight(),
          state_.within,
          steps_->control().at_end(),
          at_end(),
          alarm_};
}

/// Puts what follows rigid bodies where these are: schemes know nothing of it.
void March::let_follow() {
  const Embedding& embedding = s_.model().embedding;
  for (std::vector<double>* values : {&state_.q, &state_.v, &state_.a}) embedding.spread(*values);
}

/// What the velocities of the state have more than those before, by the mass of the stage.
March::GivenMotion March::given_motion(const std::vector<double>& v_before) const {
  std::vector<double> p(v_before.size());
  stage().mass().apply(v_before, p);
  const double kinetic_before = 0.5 * std::inner_product(p.begin(), p.end(), v_before.begin(), 0.0);
  const MomentArms arms(stage().system(), state_.q);
  std::array<double, 6> before{};
  for (std::size_t i = 0; i < p.size(); ++i) add_with_moment(arms.at(i / 3), i % 3, p[i], before.data());
  GivenMotion given{state_.forces.stored.kinetic - kinetic_before, state_.forces.total_momentum};
  for (std::size_t c = 0; c < 3; ++c) {
    given.momentum.linear[c] -= before[c];
    given.momentum.angular[c] -= before[3 + c];
  }
  return given;
}

/// Makes the stage's scheme and lets it take the state over.
void March::begin_stage() {
  scheme_ = stage().make_scheme();
  if (steps_) log_ = log();
  steps_.emplace(stage());
  const bool was_static = stage_number_ > 0 && !has_inertia(s_.stages()[stage_number_ - 1]->settings().kind);
  const std::vector<double> v_before = state_.v;
  const bool gives_velocities = s_.begin_velocities(stage_number_, state_);
  try {
    scheme_->start(state_, stage().dt());
  } catch (const std::runtime_error& e) {
    throw RunError(static_cast<int>(step_), state_.t, e.what());
  }
  let_follow();
  step_scale_.emplace(s_.model(), stage(), rest_energy(s_.solid(), reach(s_.mesh())));
  steps_->begin_at(state_, step_);
  solver_ = scheme_->solver_name(state_);
  if (ledger_) {
    book_switch(was_static || gives_velocities ? given_motion(v_before) : GivenMotion{});
  } else {
    begin_books();
  }
}

void March::begin_books() {
  ledger_.emplace(state_.forces.stored, state_.forces.total_momentum, reach(s_.mesh()));
  const std::vector<double>& masses = stage().mass().node_diagonal();
  monitor_.emplace(*ledger_,
                   RunMonitor::Bodies{std::accumulate(masses.begin(), masses.end(), 0.0),
                                      rest_energy(s_.solid(), reach(s_.mesh())), momenta_of(s_.model())},
                   kind_of(stage(), state_));
}

/// Another scheme may have another mass, and starts from accelerations of its own: what the stored energies jump by is
/// the scheme's doing (ledger: algorithmic), what the momentum jumps by an impulse that the log names. What velocities
/// that begin with the stage add is initial energy.
void March::book_switch(const GivenMotion& given) {
  ledger_->give(given.kinetic, given.momentum);
  const EnergyTerms before = ledger_->now(), &after = state_.forces.stored;
  LedgerIncrement jump;
  jump.energy = change_of_state(before, after);
  jump.energy.algorithmic = -jump.energy.mechanical() - jump.energy.lost();
  const Momentum now = state_.forces.total_momentum;
  for (std::size_t c = 0; c < 3; ++c) {
    jump.impulse.linear[c] = now.linear[c] - ledger_->momentum().linear[c] - given.momentum.linear[c];
    jump.impulse.angular[c] = now.angular[c] - ledger_->momentum().angular[c] - given.momentum.angular[c];
  }
  ledger_->add(jump, now);
  monitor_->begin_stage(kind_of(stage(), state_), -jump.energy.contact_stored);
  log_.push_back(fmt::format("stage: at t = {:.6g} from step {} on: {}; stored energy jumps by {:.3g}", state_.t, step_,
                             stage().name(), jump.energy.mechanical()));
}

/// A tangent that is not positive definite makes the scheme change its solver, once in a stage.
void March::note_solver() {
  std::string now = scheme_->solver_name(state_);
  if (now == solver_) return;
  log_.push_back(fmt::format("solver: at t = {:.6g} from step {} on: {}", state_.t, step_, now));
  solver_ = std::move(now);
}

/// Magnitude of the impulse of the loads over a step, by their forces at its end; static stages have none.
double March::load_impulse() const {
  if (s_.model().loads.empty() || !has_inertia(stage().settings().kind)) return 0.0;
  const std::vector<double>& f = state_.forces.external.value;
  const std::vector<Index>& nodes = s_.solid().loaded_nodes();
  const auto sum = parallel_sums<3>(nodes.size(), [&](std::size_t k, std::array<double, 3>& s) {
    for (std::size_t c = 0; c < 3; ++c) s[c] += f[3 * static_cast<std::size_t>(nodes[k]) + c];
  });
  return norm(sum) * dt_;
}

std::vector<std::string> March::log() const {
  std::vector<std::string> lines = log_;
  if (erosions_)
    for (std::string& line : erosions_->log()) lines.push_back(std::move(line));
  if (!steps_) return lines;
  for (std::string& line : steps_->notes()) lines.push_back(std::move(line));
  return lines;
}

/// Why a step has failed: the cell that has turned inside out on the way, or that has folded.
std::string March::with_cell(const std::string& failure) const {
  if (std::string inverted = inside_out(s_, next_.q, state_.alive()); !inverted.empty()) return inverted;
  if (next_.q.size() != s_.solid().dof_count()) return failure;
  const FlattestCorner corner = flattest_corner(s_, next_.q, state_.alive());
  return corner.is_folded() ? failure + "; on the way " + describe_fold(s_, corner, next_.q) : failure;
}

/// A step to next_ that holds; nothing when there is none, and message_ says why.
std::optional<StepReport> March::make_step() {
  step_scale_->follow(state_);
  steps_->limit_motion(state_, *state_.forces.rows.rows, step_ + 1);
  for (;;) {
    const double dt = steps_->control().dt();
    // A hundredth of the ledger's bound (1e-10 of the energy), shared out over the time of the run; what a step leaves
    // unbooked is at most its residual's work.
    const double tolerance = 1e-12 * ledger_->scale() * dt / s_.end();
    StepReport report = scheme_->step(state_, {steps_->control().t_end_of_step(), dt, tolerance}, next_);
    if (report.converged && !std::isfinite(next_.forces.stored.mechanical())) {
      report.converged = false;
      report.failure = "the energy is not finite";
    }
    if (report.converged) {
      const EnergyGuard::Books books{report.books.energy.quadrature, step_scale_->algorithmic(report.books),
                                     step_scale_->of_step_to(next_, ledger_->now().friction)};
      if (!steps_->is_to_be_repeated(state_, next_, books, step_ + 1)) {
        dt_ = dt;
        steps_->accept(state_, books, step_ + 1);
        return report;
      }
      continue;
    }
    if (steps_->shorten(state_, step_ + 1, report.failure)) continue;
    report.failure = with_cell(report.failure);
    message_ = fmt::format("step {} from t = {:.6g} failed: {}{}", step_ + 1, state_.t, report.failure,
                           stage().time().fixed ? "; the case fixes the step, so it was not halved" : "");
    return std::nullopt;
  }
}

/// Lets cells go at the end of a step. What follows from the state is made anew without them, contact with the faces
/// that they have laid bare included, as at the beginning of a stage.
void March::erode() {
  const std::vector<std::uint8_t> next = erosions_->next(state_);
  if (next.empty()) return;
  erosions_->note(state_, next);
  const std::span<const std::uint8_t> before = state_.alive();
  std::vector<Index> going;
  for (std::size_t k = 0; k < next.size(); ++k)
    if (next[k] == 0 && (before.empty() || before[k] != 0)) going.push_back(static_cast<Index>(k));
  SolidEnergies gone;
  std::vector<double> force(state_.q.size(), 0.0);
  s_.solid().add_internal_force_of(going, state_.q, force, view().points(), &gone);
  const EnergyTerms stored = state_.forces.stored;
  const std::shared_ptr<const Topology> topology = erosions_->topologies().of(next);
  state_.contact =
      s_.contact().carried_history({state_.contact, state_.topology}, *state_.forces.rows.rows, state_.q, topology);
  state_.topology = topology;
  s_.solid().forget_gone(next, state_.points);
  scheme_ = stage().make_scheme();
  try {
    scheme_->start(state_, steps_->control().dt());
  } catch (const std::runtime_error& e) {
    throw RunError(static_cast<int>(step_), state_.t, e.what());
  }
  book_eroded(stored, gone);
}

/// Cells take what they have stored and spent with them, rows that are no more the energy of their springs: evaluated
/// by themselves, so that the balance of powers sees what the bodies have lost otherwise.
void March::book_eroded(const EnergyTerms& before, const SolidEnergies& gone) {
  LedgerIncrement jump;
  jump.energy = change_of_state(before, state_.forces.stored);
  jump.energy.eroded = gone.strain + gone.plastic + gone.hourglass + gone.hourglass_loss + gone.viscous +
                       gone.distortion - jump.energy.contact_stored;
  const Momentum now = state_.forces.total_momentum;
  for (std::size_t c = 0; c < 3; ++c) {
    jump.impulse.linear[c] = now.linear[c] - ledger_->momentum().linear[c];
    jump.impulse.angular[c] = now.angular[c] - ledger_->momentum().angular[c];
  }
  ledger_->add(jump, now);
}

/// The books of the step that has become the present one.
void March::book(const StepReport& report) {
  iterations_ = std::max(report.iterations, report.linear_iterations);
  note_solver();
  dt_smallest_ = step_ == 1 ? dt_ : std::min(dt_smallest_, dt_);
  dt_largest_ = std::max(dt_largest_, dt_);
  ledger_->add(report.books, state_.forces.total_momentum);
  monitor_->update(load_impulse(), report.rounding);
  body_strain_ = std::max(body_strain_, s_.solid().body_strain(state_.q));
  alarm_ = monitor_->alarm(s_.given().guards.energy_growth);
}

void March::step() {
  if (steps_->control().at_end()) {
    ++stage_number_;
    begin_stage();
  }
  const std::optional<StepReport> report = make_step();
  if (!report) {
    leave();
    return;
  }
  std::swap(state_, next_);
  let_follow();
  ++step_;
  book(*report);
  if (erosions_ && alarm_.empty()) erode();
  show();
  if (alarm_.empty()) {
    if (!steps_->control().at_end()) steps_->follow_stable_step(state_, step_);
    return;
  }
  message_ = fmt::format("stopped after step {}, t = {:.6g}: {}; ", step_, state_.t, alarm_);
  if (const FlattestCorner corner = flattest_corner(s_, state_.q, state_.alive()); corner.is_folded()) {
    message_ += describe_fold(s_, corner, state_.q);
    return;
  }
  message_ += worst_place(stage().system(), state_);
  const std::string remedy = s_.given().contacts.empty() ? "" : touch_remedy(stage());
  message_ += ". " + (remedy.empty() ? energy_remedy(stage()) : remedy);
}

}  // namespace carom
