#include "schemes/generalized_alpha.hpp"

#include <cassert>
#include <utility>

#include "parallel/threads.hpp"
#include "schemes/books.hpp"

namespace carom {

namespace {

std::vector<double> packed(const Momentum& p) {
  return {p.linear[0], p.linear[1], p.linear[2], p.angular[0], p.angular[1], p.angular[2]};
}

}  // namespace

GeneralizedAlpha::GeneralizedAlpha(const System& system, const GeneralizedAlphaParameters& p,
                                   const ImplicitSettings& settings, double dt, double omega_max_squared)
    : system_(system),
      parameters_(p),
      start_(system),
      stage_(system, settings, (1.0 - p.alpha_f) / (1.0 - p.alpha_m) * p.beta * dt * dt, omega_max_squared) {
  assert(p.beta > 0.0 && p.alpha_m < 1.0 && p.alpha_f < 1.0);
  const std::size_t n = system.solid.dof_count();
  u_predicted_.resize(n);
  v_predicted_.resize(n);
  known_.resize(n);
}

void GeneralizedAlpha::start(State& state, double dt) {
  start_in_equilibrium(system_, stage_, dt, state, now_);
  state.memory = packed(resultant(system_, state.q, now_));
}

StepReport GeneralizedAlpha::step(const State& begin, const StepRequest& request, State& end) {
  const auto [alpha_m, alpha_f, beta, gamma] = parameters_;
  const double h = request.dt;
  const std::size_t n = begin.q.size();
  end = begin;
  end.t = request.t_end;
  next_.external.resize(n);
  system_.solid.external_force(end.t, system_.mass, next_.external);
  imposed_steps(system_.supports, begin.t, end.t, begin.q, imposed_);
  if (!start_.set(
          begin.a, h, imposed_, [](const ImposedStep& s) { return s.a_begin; }, now_))
    return {false, 0, 0, MassSolver::failure, {}};
  const std::span<const double> a_begin = start_.a();
  for (std::size_t i = 0; i < n; ++i) {
    u_predicted_[i] = begin.q[i] + h * begin.v[i] + h * h * (0.5 - beta) * a_begin[i];
    v_predicted_[i] = begin.v[i] + h * (1.0 - gamma) * a_begin[i];
    known_[i] = (1.0 - alpha_f) * next_.external[i] + alpha_f * (now_.external[i] - now_.internal[i]) -
                alpha_m * now_.inertia[i];
  }
  const StageEquation equation{.m = 1.0 - alpha_m,
                               .k = 1.0 - alpha_f,
                               .s = beta * h * h,
                               .r = gamma * h,
                               .x_hat = u_predicted_,
                               .v_hat = v_predicted_,
                               .known = known_,
                               .imposed = imposed_};
  impose_on_stage(equation, end.a);
  StageReport solved = stage_.solve(equation, begin, request.work_tolerance, end, next_);
  StepReport report{solved.converged, solved.iterations, solved.linear_iterations, std::move(solved.failure), {}};
  if (!report.converged) return report;
  complete_forces(system_, end, next_);
  const StepWeights weights{.inertia = 1.0 - alpha_m, .force = 1.0 - alpha_f, .contact = 1.0};
  const StepBooks books = step_books(system_, begin, now_, end, next_, weights,
                                     stage_.port().work(begin, now_, end, next_, weights.support_work));
  report.books = books.increment;
  const std::vector<double>& m = begin.memory;
  const Momentum before = combine(1.0, {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}}, 1.0, start_.change(begin.q));
  const Momentum after = combine(1.0 / (1.0 - alpha_m), books.force, -alpha_m / (1.0 - alpha_m), before);
  report.books.impulse = combine(h * (1.0 - gamma), before, h * gamma, after);
  end.memory = packed(after);
  std::swap(now_, next_);
  return report;
}

}  // namespace carom
