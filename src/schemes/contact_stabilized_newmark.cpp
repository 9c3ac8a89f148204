#include "schemes/contact_stabilized_newmark.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "enforcement/exact_port.hpp"
#include "schemes/books.hpp"
#include "schemes/scheme_table.hpp"

namespace carom {

namespace {

/// No force inside: the projection knows the mass alone.
StageForce no_force() {
  return {[](const PointStep& /*step*/, State& end) {
            std::fill(end.forces.internal.begin(), end.forces.internal.end(), 0.0);
          },
          [](std::span<const double> x) { return x; }, 0.0};
}

}  // namespace

ContactStabilizedNewmark::ContactStabilizedNewmark(const System& system, const ContactStabilizedParameters& parameters,
                                                   const ImplicitSettings& settings, double dt,
                                                   double omega_max_squared)
    : system_(system),
      gamma_(parameters.gamma),
      projection_(system, settings, 0.0, omega_max_squared, std::make_unique<ProjectionPort>(system), no_force()),
      stage_(system, settings, 0.5 * gamma_ * dt * dt, omega_max_squared) {
  assert(gamma_ >= 0.5 && gamma_ <= 1.0 && settings.enforcement == EnforcementKind::lagrange);
  x_predicted_.resize(system.solid.dof_count());
  zero_.resize(system.solid.dof_count());
  known_.resize(system.solid.dof_count());
}

void ContactStabilizedNewmark::start(State& state, double dt) {
  start_in_equilibrium(system_, stage_, dt, state, 1);
  projection_.start_memory(state, 0);
}

/// projected_.q = u_hat
StageReport ContactStabilizedNewmark::project(const State& begin, const StepRequest& request) {
  for (std::size_t i = 0; i < begin.q.size(); ++i) x_predicted_[i] = begin.q[i] + request.dt * begin.v[i];
  imposed_steps(system_.supports, begin.t, request.t_end, begin.q, imposed_);
  for (const ImposedStep& s : imposed_) x_predicted_[s.dof] = s.u;
  go_on_from(begin, projected_);
  std::fill(projected_.a.begin(), projected_.a.end(), 0.0);
  const StageEquation equation{.s = 1.0, .x_hat = x_predicted_, .v_hat = zero_, .known = zero_};
  // M u_hat is a force times h^2: what the tolerance leaves of work is that much less.
  return projection_.solve(equation, begin, {request.tolerance.work * request.dt * request.dt}, projected_);
}

StepReport ContactStabilizedNewmark::step(const State& begin, const StepRequest& request, State& end) {
  const double h = request.dt;
  const std::size_t n = begin.q.size();
  StageReport projected = project(begin, request);
  StepReport report{false, projected.iterations, projected.linear_iterations, std::move(projected.failure), {}};
  if (!projected.converged) return report;
  go_on_from(begin, end);
  end.stages.front() = projected_.stages.front();
  end.t = request.t_end;
  const Forces& now = begin.forces;
  Forces& next = end.forces;
  evaluate_loads(system_, end.t, next);
  for (std::size_t i = 0; i < n; ++i) {
    known_[i] = gamma_ * next.external[i] + (1.0 - gamma_) * (now.external[i] - now.internal[i]);
  }
  const StageEquation equation{.k = gamma_,
                               .s = 0.5 * h * h,
                               .r = h,
                               .dt = h,
                               .place = 1,
                               .x_hat = projected_.q,
                               .v_hat = begin.v,
                               .known = known_,
                               .imposed = imposed_};
  impose_on_stage(equation, end.a);
  StageReport solved = stage_.solve(equation, begin, request.tolerance, end);
  report.converged = solved.converged;
  report.iterations += solved.iterations;
  report.linear_iterations += solved.linear_iterations;
  report.failure = std::move(solved.failure);
  if (!report.converged) return report;
  complete_forces(system_, end);
  const StepWeights weights{.inertia = 1.0, .force = gamma_, .contact = 1.0, .support_work = 1.0};
  set_mean_reactions(system_, begin, weights, end);
  const StepBooks books =
      step_books(system_, begin, Balance(now), end, weights, stage_.port().work(begin, end, weights.support_work));
  report.books = books.increment;
  report.books.impulse = combine(h, books.force, 0.0, {});
  return report;
}

SchemeRow contact_stabilized_newmark_row() {
  return {.make = [](const SchemeRequest& r) -> std::unique_ptr<Scheme> {
    return std::make_unique<ContactStabilizedNewmark>(r.system, r.parameters<ContactStabilizedParameters>(),
                                                      r.settings.implicit(), r.dt, r.omega_max_squared);
  }};
}

}  // namespace carom
