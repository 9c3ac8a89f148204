#include "schemes/bathe.hpp"

#include <utility>

#include "schemes/books.hpp"

namespace carom {

Bathe::Bathe(const System& system, const ImplicitSettings& settings, double dt, double omega_max_squared)
    : system_(system),
      start_(system),
      first_(system, settings, dt * dt / 16.0, omega_max_squared),
      second_(system, settings, dt * dt / 9.0, omega_max_squared) {
  x_hat_.resize(system.solid.dof_count());
  v_hat_.resize(system.solid.dof_count());
}

void Bathe::start(State& state, double dt) {
  start_in_equilibrium(system_, second_, dt, state, now_);
}

bool Bathe::solve(ImplicitStage& stage, const StageEquation& equation, const StepRequest& request, const State& begin,
                  const Forces& forces_begin, State& end, Forces& forces_end, StepReport& report) {
  forces_end.external.resize(end.q.size());
  system_.solid.external_force(end.t, system_.mass, forces_end.external);
  StageEquation whole = equation;
  whole.x_hat = x_hat_;
  whole.v_hat = v_hat_;
  whole.known = forces_end.external;
  whole.imposed = imposed_;
  impose_on_stage(whole, end.a);
  StageReport solved = stage.solve(whole, begin, 0.5 * request.work_tolerance, end, forces_end);
  report.iterations += solved.iterations;
  report.linear_iterations += solved.linear_iterations;
  report.failure = std::move(solved.failure);
  if (!solved.converged) return false;
  complete_forces(system_, end, forces_end);
  const StepWeights weights{.inertia = 1.0, .force = 1.0, .contact = 1.0};
  const LedgerIncrement books =
      step_books(system_, begin, forces_begin, end, forces_end, weights,
                 stage.port().work(begin, forces_begin, end, forces_end, weights.support_work))
          .increment;
  report.books.energy += books.energy;
  report.books.aster += books.aster;
  return true;
}

StepReport Bathe::step(const State& begin, const StepRequest& request, State& end) {
  const double h = request.dt;
  StepReport report;
  middle_ = begin;
  middle_.t = request.t_end - 0.5 * h;
  imposed_steps(system_.supports, begin.t, middle_.t, begin.q, imposed_);
  if (!start_.set(
          begin.a, 0.5 * h, imposed_, [](const ImposedStep& s) { return s.a_begin; }, now_)) {
    report.failure = MassSolver::failure;
    return report;
  }
  const std::span<const double> a_begin = start_.a();
  for (std::size_t i = 0; i < begin.q.size(); ++i) {
    v_hat_[i] = begin.v[i] + 0.25 * h * a_begin[i];
    x_hat_[i] = begin.q[i] + 0.25 * h * (begin.v[i] + v_hat_[i]);
  }
  const StageEquation trapezoidal{.s = h * h / 16.0, .r = 0.25 * h};
  if (!solve(first_, trapezoidal, request, begin, now_, middle_, half_, report)) return report;
  end = middle_;
  end.t = request.t_end;
  for (std::size_t i = 0; i < begin.q.size(); ++i) {
    v_hat_[i] = (4.0 * middle_.v[i] - begin.v[i]) / 3.0;
    x_hat_[i] = (h * v_hat_[i] + 4.0 * middle_.q[i] - begin.q[i]) / 3.0;
  }
  imposed_steps(system_.supports, middle_.t, end.t, middle_.q, imposed_);
  const StageEquation backward{.s = h * h / 9.0, .r = h / 3.0};
  if (!solve(second_, backward, request, middle_, half_, end, next_, report)) return report;
  const Momentum sum =
      combine(1.0, combine(1.0, resultant(system_, begin.q, now_), 1.0, resultant(system_, middle_.q, half_)), 1.0,
              resultant(system_, end.q, next_));
  report.books.impulse = combine(h / 3.0, sum, 0.0, {});
  report.converged = true;
  std::swap(now_, next_);
  return report;
}

}  // namespace carom
