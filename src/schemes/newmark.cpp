#include "schemes/newmark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "parallel/threads.hpp"
#include "schemes/initial_acceleration.hpp"

namespace carom {

/// Equilibrium error of a trial state. Forces are paired with the displacement of the whole body, norm with norm: node
/// by node, a body at rest would take any force for equilibrium.
struct Newmark::Residual {
  double norm = 0.0;          ///< 2-norm
  double displacement = 0.0;  ///< 2-norm of the step's displacement, and of what the residual would still add to it
  double work = 0.0;          ///< norm x displacement, at least the energy that the residual may leave unbooked
  double round_off = 0.0;     ///< the part of `work` that rounding alone leaves
};

Newmark::Newmark(const System& system, const NewmarkParameters& parameters, double dt, double omega_max_squared)
    : system_(system),
      parameters_(parameters),
      solver_(make_effective_solver(system, parameters.solver, parameters.beta * dt * dt, omega_max_squared)),
      mass_solver_(system) {
  assert(parameters.beta > 0.0);
  const std::size_t n = system.solid.dof_count();
  u_predicted_.resize(n);
  v_predicted_.resize(n);
  residual_.resize(n);
  correction_.resize(n);
  tangents_.resize(system.contact.rows().size());
  stiffness_diagonal_ = system.solid.tangent_diagonal(u_predicted_);
  closed_diagonal_ = stiffness_diagonal_;
  system.contact.add_closed_diagonal(closed_diagonal_);
}

void Newmark::start(State& state, double /*dt*/) {
  start_with_supports(system_, state);
  evaluate_forces(system_, state.t, state.q, state.contact, state.q, state.v, now_);
  for (const PrescribedDof& p : system_.supports.prescribed()) {
    const double t = state.t;
    state.a[static_cast<std::size_t>(p.dof)] = p.kind == MotionKind::acceleration ? p.function(t)
                                               : p.kind == MotionKind::velocity   ? p.function.derivative(t)
                                                                                  : 0.0;
  }
  start_accelerations(system_, mass_solver_, state, now_);
}

void Newmark::impose_motions(const StepRequest& request, State& end) const {
  const double h = request.dt;
  for (const PrescribedDof& p : system_.supports.prescribed()) {
    const auto i = static_cast<std::size_t>(p.dof);
    const double value = p.function(request.t_end);
    switch (p.kind) {
      case MotionKind::displacement:
        end.a[i] = (value - u_predicted_[i]) / (parameters_.beta * h * h);
        break;
      case MotionKind::velocity:
        end.a[i] = (value - v_predicted_[i]) / (parameters_.gamma * h);
        break;
      case MotionKind::acceleration:
        end.a[i] = value;
        break;
    }
  }
}

void Newmark::move(const StepRequest& request, State& end) const {
  const double h = request.dt;
  parallel_each(end.q.size(), [&](std::size_t i) {
    end.q[i] = u_predicted_[i] + parameters_.beta * h * h * end.a[i];
    end.v[i] = v_predicted_[i] + parameters_.gamma * h * end.a[i];
  });
}

Newmark::Residual Newmark::residual(const State& begin, const StepRequest& request, const State& end) {
  evaluate_forces(system_, request.t_end, begin.q, begin.contact, end.q, end.v, next_);
  next_.inertia.resize(end.a.size());
  system_.mass.apply(end.a, next_.inertia);
  const std::vector<bool>& fixed = system_.supports.fixed();
  Residual out;
  for (std::size_t i = 0; i < residual_.size(); ++i) {
    residual_[i] = fixed[i] ? 0.0 : next_.external[i] - next_.internal[i] + next_.contact[i] - next_.inertia[i];
  }
  const std::vector<double>& mass = system_.mass.node_diagonal();
  const double h = request.dt, s = parameters_.beta * h * h;
  // Squares of the displacement, of Jacobi's estimate of what is missing, and of the forces that cancel in the
  // residual.
  const auto sums = parallel_sums<3>(residual_.size(), [&](std::size_t i, std::array<double, 3>& sum) {
    const double du = end.q[i] - begin.q[i];
    sum[0] += du * du;
    if (fixed[i]) return;
    const double missing = s * residual_[i] / (mass[i / 3] + s * stiffness_diagonal_[i]);
    const double force = std::abs(next_.external[i]) + std::abs(next_.internal[i]) + std::abs(next_.contact[i]) +
                         mass[i / 3] * std::abs(end.a[i]) +
                         closed_diagonal_[i] * (std::abs(begin.q[i]) + std::abs(end.q[i]));
    sum[1] += missing * missing;
    sum[2] += force * force;
  });
  out.norm = std::sqrt(dot(residual_, residual_));
  out.displacement = std::sqrt(sums[0]) + std::sqrt(sums[1]);
  out.work = out.norm * out.displacement;
  // A displacement is known to a relative 1e-16 only, which the stiffness of a node turns into a force.
  constexpr double precision = 16.0 * std::numeric_limits<double>::epsilon();
  out.round_off = precision * out.displacement * std::sqrt(sums[2]);
  return out;
}

void Newmark::set_tangents(const State& begin, const State& end, double dt) {
  const double s = parameters_.beta * dt * dt, dv_dx = parameters_.gamma / (parameters_.beta * dt);
  for (std::size_t r = 0; r < tangents_.size(); ++r) {
    tangents_[r] = system_.contact.tangent(r, begin.q, end.q, end.v, begin.contact, dv_dx);
    for (double& d : tangents_[r]) d *= s;
  }
}

StepReport Newmark::step(const State& begin, const StepRequest& request, State& end) {
  const double h = request.dt;
  end = begin;
  end.t = request.t_end;
  for (std::size_t i = 0; i < end.q.size(); ++i) {
    u_predicted_[i] = begin.q[i] + h * begin.v[i] + h * h * (0.5 - parameters_.beta) * begin.a[i];
    v_predicted_[i] = begin.v[i] + h * (1.0 - parameters_.gamma) * begin.a[i];
  }
  impose_motions(request, end);
  StepReport report;
  std::vector<RowStatus> status_before;
  for (;; ++report.iterations) {
    move(request, end);
    status_before.swap(next_.rows.status);
    const Residual error = residual(begin, request, end);
    if (!std::isfinite(error.norm)) {
      report.failure = "the forces are not finite";
      return report;
    }
    const double tolerance = std::max(request.work_tolerance, error.round_off);
    if (error.work <= tolerance) break;
    if (report.iterations == parameters_.max_iterations) {
      report.failure = cycling_rows(status_before);
      return report;
    }
    solver_->prepare(parameters_.beta * h * h);
    set_tangents(begin, end, h);
    const double absolute = 0.3 * tolerance / error.displacement;
    const LinearSolveReport solved = solver_->solve(residual_, tangents_, absolute, correction_);
    report.linear_iterations += solved.iterations;
    if (!solved.converged) {
      report.failure =
          fmt::format("the linear solver stopped after {} iterations at a residual of {:.3g} (asked: {:.3g})",
                      solved.iterations, solved.residual, absolute);
      return report;
    }
    for (std::size_t i = 0; i < end.a.size(); ++i) end.a[i] += correction_[i];
  }
  end.contact = next_.rows.history;
  complete_forces(system_, end, next_);
  report.books = newmark_books(system_, begin, now_, end, next_, parameters_.beta, parameters_.gamma, h);
  report.converged = true;
  std::swap(now_, next_);
  return report;
}

std::string Newmark::cycling_rows(const std::vector<RowStatus>& before) const {
  static constexpr const char* names[] = {"open", "stick", "slip"};
  const ConstraintRows& rows = system_.contact.rows();
  std::string list;
  int count = 0;
  for (std::size_t r = 0; r < rows.size() && r < before.size(); ++r) {
    if (before[r] == next_.rows.status[r]) continue;
    if (++count > 5) continue;
    const Vec3& x = rows.position[r];
    list += fmt::format("{}row {} at ({:.4g}, {:.4g}, {:.4g}) {} -> {}", list.empty() ? "" : ", ", r, x[0], x[1], x[2],
                        names[static_cast<int>(before[r])], names[static_cast<int>(next_.rows.status[r])]);
  }
  if (count == 0)
    return fmt::format("no equilibrium after {} iterations, with a settled contact state", parameters_.max_iterations);
  if (count > 5) list += fmt::format(" and {} more", count - 5);
  return fmt::format("the contact state does not settle in {} iterations; these rows cycle: {}",
                     parameters_.max_iterations, list);
}

}  // namespace carom
