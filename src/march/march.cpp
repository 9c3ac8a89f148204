#include "march/march.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include "base/page_memory.hpp"
#include "march/body_scales.hpp"
#include "march/failure_text.hpp"
#include "march/kept_state.hpp"
#include "solid/point_history.hpp"

namespace carom {

March::March(const Simulation& simulation)
    : s_(simulation), state_(simulation.initial_state()), shared_(s_.solid(), nullptr, state_), end_(simulation.end()) {
  release_pages(state_.v);  // velocities begin with their stage
  if (!s_.model().erosion.empty()) erosions_.emplace(s_);
}

bool March::at_end() const {
  return stage_->at_end() && stage_->number() + 1 == s_.stages().size();
}

/// What has been started goes out as it is; what has not is made ready for what comes in.
void March::keep(Archive& archive) {
  std::size_t number = stage_ ? stage_->number() : 0;
  archive("stage", number);
  if (number >= s_.stages().size()) throw ArchiveError("it is of a stage that the case has not");
  if (!is_started()) {
    const double rest = rest_energy(s_.solid(), reach(s_.mesh()));
    stage_ = std::make_unique<StageRun>(s_, number, rest);
    shared_ = {s_.solid(), scheme().shared_nodes(), state_};
    books_.emplace(s_, stage(), state_, rest);
  }
  keep_state(archive, s_.solid(), state_);
  keep_topology(archive);
  fields(archive, *stage_);
  fields(archive, *books_);
  fields(archive, count_);
  archive("end", end_);
  archive("log", log_);
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
  if (stage_->number() + 1 < s_.stages().size())
    throw std::invalid_argument("the last stage has not begun, and its end alone can be moved");
  if (!stage_->prolong(end)) {
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
  begin_stage(0);
  show();
}

void March::leave() {
  for (Observer* observer : observers_) observer->leave(view());
}

void March::show() {
  for (Observer* observer : observers_) observer->see(view());
}

StepView March::view() const {
  return {count_.steps(),  count_.dt(), count_.iterations(),   state_,        state_.forces,    ledger(),
          monitor(),       stage(),     scheme().end_weight(), state_.within, stage_->at_end(), at_end(),
          books_->alarm(), shared_};
}

/// Lets the stage take the state over, and its books with it.
void March::begin_stage(std::size_t number) {
  shared_.complete();
  const double rest = rest_energy(s_.solid(), reach(s_.mesh()));
  const bool was_static = stage_ && !has_inertia(stage().settings().kind);
  auto next = std::make_unique<StageRun>(s_, number, rest);
  if (stage_)
    for (std::string& line : stage_->notes()) log_.push_back(std::move(line));
  stage_ = std::move(next);
  shared_ = {s_.solid(), scheme().shared_nodes(), state_};
  const std::vector<double> v_before = books_ ? state_.v : std::vector<double>();
  const bool gives_velocities = s_.begin_velocities(number, state_, books_ ? nullptr : scheme().shared_nodes());
  stage_->begin(state_, count_.steps());
  if (!books_) {
    books_.emplace(s_, stage(), state_, rest);
    return shared_.release();
  }
  const bool is_given = was_static || gives_velocities;
  const double jump =
      books_->begin_stage(stage(), state_, is_given ? given_motion(stage(), state_, v_before) : GivenMotion{});
  log_.push_back(fmt::format("stage: at t = {:.6g} from step {} on: {}; stored energy jumps by {:.3g}", state_.t,
                             count_.steps(), stage().name(), jump));
  shared_.release();
}

std::vector<std::string> March::log() const {
  std::vector<std::string> lines = log_;
  if (erosions_)
    for (std::string& line : erosions_->log()) lines.push_back(std::move(line));
  if (!stage_) return lines;
  for (std::string& line : stage_->notes()) lines.push_back(std::move(line));
  return lines;
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
  forget_gone(s_.solid(), next, state_.points);
  stage_->begin_again(state_, count_.steps());
  books_->add_eroded(state_, stored, gone);
}

/// The books of the step that has become the present one.
void March::book(const MadeStep& made) {
  count_.add(made.dt, std::max(made.report.iterations, made.report.linear_iterations));
  if (stage_->changes_solver(state_)) {
    log_.push_back(
        fmt::format("solver: at t = {:.6g} from step {} on: {}", state_.t, count_.steps(), stage_->solver()));
  }
  books_->add_step(stage(), state_, made.report, made.dt);
}

void March::step() {
  if (stage_->at_end()) begin_stage(stage_->number() + 1);
  const MadeStep made = stage_->make_step(state_, next_, ledger(), count_.steps() + 1);
  if (!made.report.converged) {
    carom::complete(s_.solid(), scheme().shared_nodes(), next_);
    message_ = fmt::format("step {} from t = {:.6g} failed: {}{}", count_.steps() + 1, state_.t,
                           with_cell(made.report.failure, s_, next_.q, state_.alive()),
                           stage().time().fixed ? "; the case fixes the step, so it was not halved" : "");
    leave();
    return;
  }
  std::swap(state_, next_);
  book(made);
  const std::string& alarm = books_->alarm();
  if (erosions_ && alarm.empty()) erode();
  show();
  if (!alarm.empty()) {
    shared_.complete();
    message_ = fmt::format("stopped after step {}, t = {:.6g}: {}; {}", count_.steps(), state_.t, alarm,
                           place_and_remedy(s_, stage(), state_));
  } else if (!stage_->at_end()) {
    stage_->follow_stable_step(state_, count_.steps());
  }
}

}  // namespace carom
