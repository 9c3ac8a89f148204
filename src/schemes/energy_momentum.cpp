#include "schemes/energy_momentum.hpp"

#include <cassert>
#include <utility>

#include "enforcement/potential_port.hpp"
#include "schemes/books.hpp"
#include "schemes/scheme_table.hpp"

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
  return {[this](const PointStep& /*step*/, State& end) {
            system_.solid.discrete_gradient_force(begin_->q, end.q, end.forces.internal);
          },
          [this](std::span<const double> x) -> std::span<const double> {
            for (std::size_t i = 0; i < x.size(); ++i) middle_[i] = 0.5 * (begin_->q[i] + x[i]);
            return middle_;
          },
          0.5};
}

void EnergyMomentum::start(State& state, double dt) {
  start_in_equilibrium(system_, stage_, dt, state);
}

StepReport EnergyMomentum::step(const State& begin, const StepRequest& request, State& end) {
  const double h = request.dt;
  const std::size_t n = begin.q.size();
  begin_ = &begin;
  go_on_from(begin, end);
  end.t = request.t_end;
  const Forces& now = begin.forces;
  Forces& next = end.forces;
  evaluate_loads(system_, end.t, next);
  imposed_steps(system_.supports, begin.t, end.t, begin.q, imposed_);
  for (std::size_t i = 0; i < n; ++i) {
    x_hat_[i] = begin.q[i] + h * begin.v[i];
    known_[i] = 0.5 * (now.external[i] + next.external[i]);
  }
  const StageEquation equation{
      .s = 0.5 * h * h, .r = h, .dt = h, .x_hat = x_hat_, .v_hat = begin.v, .known = known_, .imposed = imposed_};
  impose_on_stage(equation, end.a);
  StageReport solved = stage_.solve(equation, begin, request.tolerance, end);
  StepReport report{solved.converged, solved.iterations, solved.linear_iterations, std::move(solved.failure), {}};
  if (!report.converged) return report;
  mean_internal_ = next.internal;
  evaluate_solid(system_, step_from(begin, h), end);
  complete_forces(system_, end);
  const StepWeights weights{.inertia = 1.0, .force = 0.5, .contact = 1.0, .support_work = 1.0};
  set_mean_reactions(system_, begin, weights, end, mean_internal_);
  const StepBooks books = step_books(system_, begin, Balance(now), end, weights,
                                     stage_.port().work(begin, end, weights.support_work), mean_internal_);
  report.books = books.increment;
  report.books.impulse = combine(h, books.force, 0.0, {});
  return report;
}

SchemeRow energy_momentum_row() {
  return {.make = [](const SchemeRequest& r) -> std::unique_ptr<Scheme> {
    return std::make_unique<EnergyMomentum>(r.system, r.settings.implicit(), r.dt, r.omega_max_squared);
  }};
}

}  // namespace carom
