#include "schemes/moreau_jean.hpp"

#include <cassert>
#include <utility>

#include "schemes/books.hpp"
#include "schemes/scheme_table.hpp"

namespace carom {

MoreauJean::MoreauJean(const System& system, const MoreauJeanParameters& parameters, const ImplicitSettings& settings,
                       double dt, double omega_max_squared)
    : system_(system),
      theta_(parameters.theta),
      stage_(system, settings, theta_ * theta_ * dt * dt, omega_max_squared) {
  assert(theta_ >= 0.5 && theta_ <= 1.0 && settings.enforcement == EnforcementKind::impulse);
  x_hat_.resize(system.solid.dof_count());
  x_predicted_.resize(system.solid.dof_count());
  known_.resize(system.solid.dof_count());
}

void MoreauJean::start(State& state, double dt) {
  start_in_equilibrium(system_, stage_, dt, state);
}

StepReport MoreauJean::step(const State& begin, const StepRequest& request, State& end) {
  const double h = request.dt;
  const std::size_t n = begin.q.size();
  go_on_from(begin, end);
  end.t = request.t_end;
  const Forces& now = begin.forces;
  Forces& next = end.forces;
  evaluate_loads(system_, end.t, next);
  for (std::size_t i = 0; i < n; ++i) {
    x_hat_[i] = begin.q[i] + h * begin.v[i];
    x_predicted_[i] = begin.q[i] + 0.5 * h * begin.v[i];
    known_[i] = theta_ * next.external[i] + (1.0 - theta_) * (now.external[i] - now.internal[i]);
  }
  imposed_steps(system_.supports, begin.t, end.t, begin.q, imposed_);
  for (const ImposedStep& s : imposed_) x_predicted_[s.dof] = 0.5 * (begin.q[s.dof] + s.u);
  const StageEquation equation{.k = theta_,
                               .s = theta_ * h * h,
                               .r = h,
                               .dt = h,
                               .x_hat = x_hat_,
                               .v_hat = begin.v,
                               .known = known_,
                               .x_predicted = x_predicted_,
                               .imposed = imposed_};
  impose_on_stage(equation, end.a);
  StageReport solved = stage_.solve(equation, begin, request.tolerance, end);
  StepReport report{solved.converged, solved.iterations, solved.linear_iterations, std::move(solved.failure), {}};
  if (!report.converged) return report;
  complete_forces(system_, end);
  const StepWeights weights{.inertia = 1.0, .force = theta_, .contact = 1.0, .support_work = 1.0};
  set_mean_reactions(system_, begin, weights, end);
  const StepBooks books =
      step_books(system_, begin, Balance(now), end, weights, stage_.port().work(begin, end, weights.support_work));
  report.books = books.increment;
  report.books.impulse = combine(h, books.force, 0.0, {});
  return report;
}

SchemeRow moreau_jean_row() {
  return {.make = [](const SchemeRequest& r) -> std::unique_ptr<Scheme> {
    return std::make_unique<MoreauJean>(r.system, r.parameters<MoreauJeanParameters>(), r.settings.implicit(), r.dt,
                                        r.omega_max_squared);
  }};
}

}  // namespace carom
