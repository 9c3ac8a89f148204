#include "schemes/bathe.hpp"

#include <algorithm>
#include <utility>

#include "schemes/books.hpp"
#include "schemes/scheme_table.hpp"

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
  start_in_equilibrium(system_, second_, dt, state, 1);
  first_.start_memory(state, 0);
}

bool Bathe::solve(ImplicitStage& stage, const SubStep& sub_step, const StepRequest& request, const State& begin,
                  State& end, StepReport& report) {
  const double share = sub_step.share;
  evaluate_loads(system_, end.t, end.forces);
  for (std::size_t i = 0; i < known_.size(); ++i) known_[i] = share * end.forces.external[i];
  const StageEquation equation{.m = share,
                               .k = share,
                               .s = sub_step.s,
                               .r = sub_step.r,
                               .dt = sub_step.dt,
                               .place = sub_step.place,
                               .x_hat = x_hat_,
                               .v_hat = v_hat_,
                               .known = known_,
                               .imposed = imposed_};
  impose_on_stage(equation, end.a);
  StageReport solved = stage.solve(equation, begin, 0.5 * share * request.tolerance, end);
  report.iterations += solved.iterations;
  report.linear_iterations += solved.linear_iterations;
  report.failure = std::move(solved.failure);
  return solved.converged;
}

void Bathe::book(const ContactWork& contact, const State& begin, const Balance& balance, const State& end,
                 StepReport& report) const {
  const StepWeights weights{.inertia = 1.0, .force = 1.0, .contact = 1.0};
  const LedgerIncrement books = step_books(system_, begin, balance, end, weights, contact).increment;
  report.books.energy += books.energy;
  report.books.aster += books.aster;
}

bool Bathe::to_middle(const State& begin, const StepRequest& request, StepReport& report) {
  const double k = 0.5 * request.dt;
  go_on_from(begin, middle_);
  middle_.t = request.t_end - k;
  imposed_steps(system_.supports, begin.t, middle_.t, begin.q, imposed_);
  if (!start_.set(begin, k, imposed_, [](const ImposedStep& s) { return s.a_begin; }) ||
      (impulses_ && !impulses_->accelerations(begin.forces.rows, pushed_begin_))) {
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
  if (!solve(first_, {0, share, 0.25 * k * k, 0.5 * k, k}, request, begin, middle_, report)) return false;
  if (impulses_ && !stop_at_rows(k, report)) return false;
  complete_forces(system_, middle_);
  book(first_.port().work(begin, middle_, impulses_ ? 1.0 : 0.5), begin, start_.balance(), middle_, report);
  return true;
}

/// From the unknown of the first sub-step to the acceleration, and from its velocity to that of VelocityImpulses.
bool Bathe::stop_at_rows(double k, StepReport& report) {
  if (!impulses_->accelerations(middle_.forces.rows, pushed_half_)) {
    report.failure = MassSolver::failure;
    return false;
  }
  for (std::size_t i = 0; i < middle_.a.size(); ++i) {
    middle_.a[i] -= pushed_half_[i];
    middle_.v[i] -= k * pushed_half_[i];
  }
  report.failure = impulses_->respond(k, middle_.forces.rows, middle_.stages.front().mass_nodes, middle_.v);
  if (report.failure.empty()) report.failure = impulses_->settle_bonds(middle_);
  return report.failure.empty();
}

bool Bathe::to_end(const State& begin, const StepRequest& request, State& end, StepReport& report) {
  const double h = request.dt;
  go_on_from(middle_, end);
  end.t = request.t_end;
  for (std::size_t i = 0; i < begin.q.size(); ++i) {
    v_hat_[i] = (4.0 * middle_.v[i] - begin.v[i]) / 3.0;
    x_hat_[i] = (h * v_hat_[i] + 4.0 * middle_.q[i] - begin.q[i]) / 3.0;
  }
  imposed_steps(system_.supports, middle_.t, end.t, middle_.q, imposed_);
  if (!solve(second_, {1, 1.0, h * h / 9.0, h / 3.0, 0.5 * h}, request, middle_, end, report)) return false;
  complete_forces(system_, end);
  // lambda_half being the mean of the first sub-step, this is the mean of the second.
  book(second_.port().work(middle_, end, impulses_ ? 2.0 / 3.0 : 0.5), middle_, Balance(middle_.forces), end, report);
  return true;
}

/// h/3 (P0 + P_half + P1), the forces of the velocity taking the place of the multipliers in the first two.
Momentum Bathe::impulse(double h, const State& begin, const State& end) {
  const Momentum at_begin = resultant(system_, begin, start_.balance());
  const Momentum ends = combine(1.0, at_begin, 1.0, resultant(system_, end));
  Momentum sum = combine(1.0, ends, 1.0, resultant(system_, middle_));
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
  end.within = {impulses_ ? 2.0 / 3.0 : 1.0 / 3.0, impulses_ ? impulses_->response() : middle_.forces.rows, middle_.q};
  return report;
}

SchemeRow bathe_row() {
  return {.make = [](const SchemeRequest& r) -> std::unique_ptr<Scheme> {
            return std::make_unique<Bathe>(r.system, r.settings.implicit(), r.dt, r.omega_max_squared);
          },
          // The trapezoidal rule reflects a mass that reaches the row at the middle, the backward formula makes 5/3 of
          // that, and the multiplier, which has opened, pushes on through a0: 2 in all.
          .touch_rebound = [](const SchemeParameters& /*parameters*/) { return 2.0; },
          .parts_of_step = 2};
}

}  // namespace carom
