#include "schemes/central_differences.hpp"

#include <cmath>
#include <utility>

#include "parallel/threads.hpp"
#include "schemes/initial_acceleration.hpp"

namespace carom {

namespace {

/// Accelerations of the prescribed dofs that bring them, at the end of the step that follows, to where they must be;
/// v_before is the velocity at the middle of the step that has ended.
void impose_motions(const System& system, double t, double h, std::span<const double> u,
                    std::span<const double> v_before, std::span<double> a) {
  for (const PrescribedDof& p : system.supports.prescribed()) {
    const auto i = static_cast<std::size_t>(p.dof);
    switch (p.kind) {
      case MotionKind::displacement:
        a[i] = (p.function(t + h) - u[i] - h * v_before[i]) / (h * h);
        break;
      case MotionKind::velocity:
        a[i] = (p.function(t + 0.5 * h) - v_before[i]) / h;
        break;
      case MotionKind::acceleration:
        a[i] = p.function(t);
        break;
    }
  }
}

}  // namespace

CentralDifferences::CentralDifferences(const System& system) : system_(system), mass_solver_(system) {
  v_half_.resize(system.solid.dof_count());
  rhs_.resize(system.solid.dof_count());
}

std::string CentralDifferences::solver_name() const {
  return system_.mass.kind() == MassKind::lumped ? "lumped mass, no solve" : "conjugate gradients on the mass";
}

void CentralDifferences::start(State& state, double dt) {
  start_with_supports(system_, state);
  evaluate_forces(system_, state.t, state.q, state.contact, state.q, state.v, now_);
  // The first half step starts from v0 itself: a0 = 2 (u_p(h) - u0 - h v0) / h^2, and likewise for velocities.
  impose_motions(system_, state.t, dt, state.q, state.v, state.a);
  for (const PrescribedDof& p : system_.supports.prescribed()) {
    if (p.kind != MotionKind::acceleration) state.a[static_cast<std::size_t>(p.dof)] *= 2.0;
  }
  start_accelerations(system_, mass_solver_, state, now_);
}

StepReport CentralDifferences::step(const State& begin, const StepRequest& request, State& end) {
  const double h = request.dt;
  const std::size_t n = begin.q.size();
  end.t = request.t_end;
  end.q.resize(n);
  end.v.resize(n);
  end.a = begin.a;
  parallel_each(n, [&](std::size_t i) {
    v_half_[i] = begin.v[i] + 0.5 * h * begin.a[i];
    end.q[i] = begin.q[i] + h * v_half_[i];
  });
  evaluate_forces(system_, request.t_end, begin.q, begin.contact, end.q, v_half_, next_);
  impose_motions(system_, request.t_end, h, end.q, v_half_, end.a);
  force_sum(next_, rhs_);
  StepReport report;
  report.linear_iterations = mass_solver_.solve(rhs_, end.a);
  if (report.linear_iterations < 0) {
    report.failure = "the accelerations cannot be solved for: the forces are not finite or the mass is not positive";
    return report;
  }
  parallel_each(n, [&](std::size_t i) { end.v[i] = v_half_[i] + 0.5 * h * end.a[i]; });
  end.contact = next_.rows.history;
  complete_forces(system_, end, next_);
  report.books = newmark_books(system_, begin, now_, end, next_, 0.0, 0.5, h);
  report.converged = true;
  std::swap(now_, next_);
  return report;
}

}  // namespace carom
