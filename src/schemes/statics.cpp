#include "schemes/statics.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "schemes/books.hpp"
#include "schemes/initial_acceleration.hpp"
#include "schemes/scheme_table.hpp"

namespace carom {

Statics::Statics(const System& system, const ImplicitSettings& settings, double omega_max_squared)
    : system_(system),
      free_(system),
      stage_(system, settings, std::numeric_limits<double>::infinity(), omega_max_squared) {
  zero_.resize(system.solid.dof_count());
  stage_.hold(free_.pins(settings.enforcement == EnforcementKind::lagrange ? 0.1 : 1.0));
}

void Statics::start(State& state, double dt) {
  start_with_supports(system_, state);
  std::fill(state.v.begin(), state.v.end(), 0.0);
  const std::vector<double> points = state.points;
  evaluate_bodies(system_, {.dt = dt, .history = points, .is_static = true}, state);
  stage_.start(state, 0);
  complete_forces(system_, state);
}

StepReport Statics::step(const State& begin, const StepRequest& request, State& end) {
  go_on_from(begin, end);
  end.t = request.t_end;
  // A load that jumps where this stage ends is that of the stage which follows.
  evaluate_loads(system_, end.t, end.forces, JumpSide::before);
  // The unknown is the displacement of the step; it stands in end.a while the stage is solved.
  imposed_steps(system_.supports, begin.t, end.t, begin.q, imposed_);
  for (ImposedStep& s : imposed_) {
    end.a[s.dof] = s.u - begin.q[s.dof];
    s.v = 0.0;  // a motion without velocities
  }
  const StageEquation equation{.m = 0.0,
                               .s = 1.0,
                               .dt = request.dt,
                               .share = 1e-12,
                               .free = &free_,
                               .x_hat = begin.q,
                               .v_hat = zero_,
                               .known = !system_.solid.loads().empty() ? end.forces.external.value : zero_,
                               .imposed = imposed_};
  StageReport solved = stage_.solve(equation, begin, {request.tolerance.work}, end);
  StepReport report{solved.converged, solved.iterations, solved.linear_iterations, std::move(solved.failure), {}};
  if (!report.converged) return report;
  report.rounding = solved.rounding;
  std::fill(end.a.begin(), end.a.end(), 0.0);
  complete_forces(system_, end);
  const StepWeights weights{.inertia = 1.0, .force = 1.0, .contact = 1.0};
  report.books = step_books(system_, begin, Balance(begin.forces), end, weights,
                            stage_.port().work(begin, end, weights.support_work))
                     .increment;
  return report;
}

SchemeRow statics_row() {
  return {.make = [](const SchemeRequest& r) -> std::unique_ptr<Scheme> {
    return std::make_unique<Statics>(r.system, r.settings.implicit(), r.omega_max_squared);
  }};
}

}  // namespace carom
