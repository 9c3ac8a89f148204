#include "march/stage_run.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/errors.hpp"
#include "parallel/threads.hpp"

namespace carom {

StageRun::StageRun(const Simulation& simulation, std::size_t number, double rest)
    : s_(simulation),
      number_(number),
      mass_(sum_of(stage().mass().node_diagonal())),
      scheme_(stage().make_scheme()),
      steps_(stage()),
      step_scale_(s_.model(), stage(), rest) {}

void StageRun::start_scheme(State& state, double dt, long long step) {
  try {
    scheme_->start(state, dt);
  } catch (const std::runtime_error& e) {
    throw RunError(static_cast<int>(step), state.t, e.what());
  }
}

/// Puts what follows rigid bodies where these are: schemes know nothing of it.
void StageRun::let_follow(State& state) const {
  for (std::vector<double>* values : {&state.q, &state.v, &state.a}) s_.model().embedding.spread(*values);
}

void StageRun::begin(State& state, long long step) {
  start_scheme(state, stage().dt(), step);
  let_follow(state);
  steps_.begin_at(state, step);
  solver_ = scheme_->solver_name(state);
}

void StageRun::begin_again(State& state, long long step) {
  scheme_ = stage().make_scheme();
  start_scheme(state, steps_.control().dt(), step);
}

MadeStep StageRun::make_step(const State& begin, State& end, const EnergyLedger& ledger, long long step) {
  step_scale_.follow(begin);
  steps_.limit_motion(begin, *begin.forces.rows.rows, step);
  for (;;) {
    const double dt = steps_.control().dt();
    // A hundredth of the verdict's bounds (1e-10 of the energy, 1e-9 of the momentum that all mass has with it), shared
    // out over the time of the run; what a step leaves unbooked is at most its residual's work.
    const double momentum = std::sqrt(2.0 * mass_ * ledger.scale());
    const ResidualTolerance tolerance{1e-12 * ledger.scale() * dt / s_.end(), 1e-11 * momentum / s_.end()};
    StepReport report = scheme_->step(begin, {steps_.control().t_end_of_step(), dt, tolerance}, end);
    if (report.converged && !std::isfinite(end.forces.stored.mechanical())) {
      report.converged = false;
      report.failure = "the energy is not finite";
    }
    if (!report.converged) {
      if (steps_.shorten(begin, step, report.failure)) continue;
      return {dt, std::move(report)};
    }
    const EnergyGuard::Books books{report.books.energy.quadrature, step_scale_.algorithmic(report.books),
                                   step_scale_.of_step_to(end, ledger.now().friction)};
    if (steps_.is_to_be_repeated(begin, end, books, step)) continue;
    steps_.accept(begin, books, step);
    let_follow(end);
    return {dt, std::move(report)};
  }
}

bool StageRun::changes_solver(const State& state) {
  std::string now = scheme_->solver_name(state);
  if (now == solver_) return false;
  solver_ = std::move(now);
  return true;
}

}  // namespace carom
