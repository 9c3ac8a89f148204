#include "schemes/bathe.hpp"

#include <algorithm>
#include <utility>

#include "schemes/books.hpp"

namespace carom {

Bathe::Bathe(const System& system, const ImplicitSettings& settings, double dt, double omega_max_squared)
    : system_(system),
      start_(system),
      first_(system, settings, dt * dt / 16.0, omega_max_squared),
      second_(system, settings, dt * dt / 9.0, omega_max_squared),
      impulses_(velocity_impulses(system, settings.enforcement)) {
  const std::size_t n = system.solid.dof_count();
  for (std::vector<double>* x : {&x_hat_, &v_hat_, &known_, &pushed_begin_, &pushed_half_}) x->resize(n);
}

void Bathe::start(State& state, double dt) {
  start_in_equilibrium(system_, second_, dt, state, now_);
}

ContactWithin Bathe::contact_within() const {
  if (impulses_) return {2.0 / 3.0, &impulses_->response(), middle_.q};
  return {1.0 / 3.0, &half_.rows, middle_.q};
}

bool Bathe::solve(ImplicitStage& stage, double share, double s, double r, const StepRequest& request,
                  const State& begin, State& end, Forces& forces_end, StepReport& report) {
  forces_end.external.resize(end.q.size());
  system_.solid.external_force(end.t, system_.mass, forces_end.external);
  for (std::size_t i = 0; i < known_.size(); ++i) known_[i] = share * forces_end.external[i];
  const StageEquation equation{
      .m = share, .k = share, .s = s, .r = r, .x_hat = x_hat_, .v_hat = v_hat_, .known = known_, .imposed = imposed_};
  impose_on_stage(equation, end.a);
  StageReport solved = stage.solve(equation, begin, 0.5 * share * request.work_tolerance, end, forces_end);
  report.iterations += solved.iterations;
  report.linear_iterations += solved.linear_iterations;
  report.failure = std::move(solved.failure);
  return solved.converged;
}

void Bathe::book(const ContactWork& contact, const State& begin, const Forces& forces_begin, const State& end,
                 const Forces& forces_end, StepReport& report) const {
  const StepWeights weights{.inertia = 1.0, .force = 1.0, .contact = 1.0};
  const LedgerIncrement books = step_books(system_, begin, forces_begin, end, forces_end, weights, contact).increment;
  report.books.energy += books.energy;
  report.books.aster += books.aster;
}

bool Bathe::to_middle(const State& begin, const StepRequest& request, StepReport& report) {
  const double k = 0.5 * request.dt;
  middle_ = begin;
  middle_.t = request.t_end - k;
  imposed_steps(system_.supports, begin.t, middle_.t, begin.q, imposed_);
  if (!start_.set(
          begin.a, k, imposed_, [](const ImposedStep& s) { return s.a_begin; }, now_) ||
      (impulses_ && !impulses_->accelerations(now_.contact, pushed_begin_))) {
    report.failure = MassSolver::failure;
    return false;
  }
  const std::span<const double> a_begin = start_.a();
  for (std::size_t i = 0; i < begin.q.size(); ++i) {
    v_hat_[i] = begin.v[i] + 0.5 * k * (a_begin[i] - pushed_begin_[i]);
    x_hat_[i] = begin.q[i] + 0.5 * k * (begin.v[i] + v_hat_[i]);
    middle_.a[i] += pushed_begin_[i];
  }
  // With the unknown s + 2 M^-1 G^T lambda half of the equation of motion has the multipliers as they are.
  const double share = impulses_ ? 0.5 : 1.0;
  if (!solve(first_, share, 0.25 * k * k, 0.5 * k, request, begin, middle_, half_, report)) return false;
  if (impulses_ && !stop_at_rows(k, report)) return false;
  complete_forces(system_, middle_, half_);
  book(first_.port().work(begin, now_, middle_, half_, impulses_ ? 1.0 : 0.5), begin, now_, middle_, half_, report);
  return true;
}

/// From the unknown of the first sub-step to the acceleration, and from its velocity to that of VelocityImpulses.
bool Bathe::stop_at_rows(double k, StepReport& report) {
  if (!impulses_->accelerations(half_.contact, pushed_half_)) {
    report.failure = MassSolver::failure;
    return false;
  }
  for (std::size_t i = 0; i < middle_.a.size(); ++i) {
    middle_.a[i] -= pushed_half_[i];
    middle_.v[i] -= k * pushed_half_[i];
  }
  report.failure = impulses_->respond(k, half_.rows, middle_.v);
  return report.failure.empty();
}

bool Bathe::to_end(const State& begin, const StepRequest& request, State& end, StepReport& report) {
  const double h = request.dt;
  end = middle_;
  end.t = request.t_end;
  for (std::size_t i = 0; i < begin.q.size(); ++i) {
    v_hat_[i] = (4.0 * middle_.v[i] - begin.v[i]) / 3.0;
    x_hat_[i] = (h * v_hat_[i] + 4.0 * middle_.q[i] - begin.q[i]) / 3.0;
  }
  imposed_steps(system_.supports, middle_.t, end.t, middle_.q, imposed_);
  if (!solve(second_, 1.0, h * h / 9.0, h / 3.0, request, middle_, end, next_, report)) return false;
  complete_forces(system_, end, next_);
  // lambda_half being the mean of the first sub-step, this is the mean of the second.
  book(second_.port().work(middle_, half_, end, next_, impulses_ ? 2.0 / 3.0 : 0.5), middle_, half_, end, next_,
       report);
  return true;
}

/// h/3 (P0 + P_half + P1), the forces of the velocity taking the place of the multipliers in the first two.
Momentum Bathe::impulse(double h, const State& begin, const State& end) {
  const Momentum ends = combine(1.0, resultant(system_, begin.q, now_), 1.0, resultant(system_, end.q, next_));
  Momentum sum = combine(1.0, ends, 1.0, resultant(system_, middle_.q, half_));
  if (impulses_) {
    const std::span<const double> push = impulses_->push();
    for (std::size_t i = 0; i < known_.size(); ++i) v_hat_[i] = 2.0 * push[i] - pushed_half_[i];
    system_.mass.apply(v_hat_, known_);
    sum = combine(1.0, sum, 1.0, resultant(system_, middle_.q, known_));
    system_.mass.apply(pushed_begin_, known_);
    sum = combine(1.0, sum, -1.0, resultant(system_, begin.q, known_));
  }
  return combine(h / 3.0, sum, 0.0, {});
}

StepReport Bathe::step(const State& begin, const StepRequest& request, State& end) {
  StepReport report;
  if (!to_middle(begin, request, report) || !to_end(begin, request, end, report)) return report;
  report.books.impulse = impulse(request.dt, begin, end);
  report.converged = true;
  std::swap(now_, next_);
  return report;
}

}  // namespace carom
