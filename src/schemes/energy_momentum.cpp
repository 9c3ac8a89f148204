#include "schemes/energy_momentum.hpp"

#include <cassert>
#include <utility>

#include "schemes/books.hpp"
#include "schemes/potential_port.hpp"

namespace carom {

EnergyMomentum::EnergyMomentum(const System& system, const ImplicitSettings& settings, double dt,
                               double omega_max_squared)
    : system_(system),
      stage_(system, settings, 0.25 * dt * dt, omega_max_squared, std::make_unique<PotentialPort>(system),
             discrete_gradient()) {
  assert(settings.enforcement == EnforcementKind::penalty);
  x_hat_.resize(system.solid.dof_count());
  known_.resize(system.solid.dof_count());
  middle_.resize(system.solid.dof_count());
}

StageForce EnergyMomentum::discrete_gradient() {
  return {[this](std::span<const double> x, std::span<double> f) {
            system_.solid.discrete_gradient_force(begin_->q, x, f);
          },
          [this](std::span<const double> x) -> std::span<const double> {
            for (std::size_t i = 0; i < x.size(); ++i) middle_[i] = 0.5 * (begin_->q[i] + x[i]);
            return middle_;
          },
          0.5};
}

void EnergyMomentum::start(State& state, double dt) {
  start_in_equilibrium(system_, stage_, dt, state, now_);
}

StepReport EnergyMomentum::step(const State& begin, const StepRequest& request, State& end) {
  const double h = request.dt;
  const std::size_t n = begin.q.size();
  begin_ = &begin;
  end = begin;
  end.t = request.t_end;
  next_.external.resize(n);
  system_.solid.external_force(end.t, system_.mass, next_.external);
  imposed_steps(system_.supports, begin.t, end.t, begin.q, imposed_);
  for (std::size_t i = 0; i < n; ++i) {
    x_hat_[i] = begin.q[i] + h * begin.v[i];
    known_[i] = 0.5 * (now_.external[i] + next_.external[i]);
  }
  const StageEquation equation{
      .s = 0.5 * h * h, .r = h, .x_hat = x_hat_, .v_hat = begin.v, .known = known_, .imposed = imposed_};
  impose_on_stage(equation, end.a);
  StageReport solved = stage_.solve(equation, begin, request.work_tolerance, end, next_);
  StepReport report{solved.converged, solved.iterations, solved.linear_iterations, std::move(solved.failure), {}};
  if (!report.converged) return report;
  mean_internal_ = next_.internal;
  system_.solid.internal_force(end.q, next_.internal);
  complete_forces(system_, end, next_);
  const StepWeights weights{.inertia = 1.0, .force = 0.5, .contact = 1.0, .support_work = 1.0};
  set_mean_reactions(system_, now_, weights, next_, mean_internal_);
  const StepBooks books = step_books(system_, begin, now_, end, next_, weights,
                                     stage_.port().work(begin, now_, end, next_, weights.support_work), mean_internal_);
  report.books = books.increment;
  report.books.impulse = combine(h, books.force, 0.0, {});
  std::swap(now_, next_);
  return report;
}

}  // namespace carom
