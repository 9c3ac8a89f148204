#include "schemes/central_differences.hpp"

#include <utility>

#include "parallel/threads.hpp"
#include "schemes/explicit_books.hpp"
#include "schemes/imposed_motion.hpp"
#include "schemes/initial_acceleration.hpp"
#include "schemes/scheme_table.hpp"

namespace carom {

CentralDifferences::CentralDifferences(const System& system) : CentralDifferences(system, penalty_contact(system)) {}

CentralDifferences::CentralDifferences(const System& system, std::unique_ptr<ExplicitContact> contact)
    : system_(system), contact_(std::move(contact)), mass_solver_(system), start_(system), pushed_(system) {}

void CentralDifferences::start(State& state, double dt) {
  start_with_supports(system_, state);
  imposed_steps(system_.supports, state.t, state.t + dt, state.q, imposed_next_);
  for (const ImposedStep& s : imposed_next_) state.a[s.dof] = acceleration_to_middle(s, dt);
  contact_->start(system_, dt, 0.5 * dt, state, shared_nodes());
  if (!is_lumped()) return start_accelerations(system_, mass_solver_, state);
  state.forces.inertia = std::vector<double>();  // its memory as well
  start_lumped_accelerations(system_, nodes(), state);
}

StepReport CentralDifferences::step(const State& begin, const StepRequest& request, State& end) {
  const double h = request.dt;
  end.t = request.t_end;
  for (std::vector<double>* values : {&end.q, &end.v, &end.a}) nodes().resize(*values);
  if (!is_lumped()) end.a = begin.a;  // the first guess of the solve
  carry_memory(begin, end);
  StepReport report;
  imposed_steps(system_.supports, begin.t, end.t, begin.q, imposed_);
  if (!start_.set(begin, h, imposed_, [h](const ImposedStep& s) { return acceleration_to_middle(s, h); })) {
    report.failure = MassSolver::failure;
    return report;
  }
  const std::span<const double> a_begin = start_.a();
  std::vector<double>& v_half = end.v;
  nodes().each_range([&](std::size_t first, std::size_t last) {
    for (std::size_t i = 3 * first; i < 3 * last; ++i) {
      v_half[i] = begin.v[i] + 0.5 * h * a_begin[i];
      end.q[i] = begin.q[i] + h * v_half[i];
    }
  });
  for (std::vector<double>* values : {&end.q, &end.v, &end.a}) nodes().spoil(*values);
  for (const ImposedStep& s : imposed_) {
    v_half[s.dof] = s.mean_velocity;
    end.q[s.dof] = s.u;
  }
  PointStep bodies = step_from(begin, h);
  bodies.nodes = shared_nodes();
  evaluate_bodies(system_, bodies, end);
  for (std::vector<double>* values : {&end.forces.internal, &end.forces.external.value})
    if (!values->empty()) nodes().spoil(*values);
  // Contact looks at the step that follows.
  imposed_steps(system_.supports, end.t, end.t + h, end.q, imposed_next_);
  for (const ImposedStep& s : imposed_next_) end.a[s.dof] = (s.mean_velocity - v_half[s.dof]) / h;
  report.failure = contact_->respond({h, h, begin.q, end.q, v_half, end.a, past_of(begin)}, end.forces);
  if (!report.failure.empty()) return report;
  for (const ImposedStep& s : imposed_) {
    end.a[s.dof] = acceleration_from_middle(s, h);
    end.v[s.dof] = s.v;
  }
  take_history(end.forces.rows, end.q, end.contact);
  if (is_lumped()) {
    pushed_.look(*begin.forces.rows.rows, *end.forces.rows.rows);
    report.books = end_lumped_step(system_, begin, start_.balance(), a_begin, contact_->work(begin, end), pushed_,
                                   nodes(), end, h);
  } else if (!end_consistent_step(begin, a_begin, h, end, report)) {
    return report;
  }
  report.converged = true;
  return report;
}

/// What end_lumped_step does, for a mass that has to be solved for.
bool CentralDifferences::end_consistent_step(const State& begin, std::span<const double> a_begin, double h, State& end,
                                             StepReport& report) {
  rhs_.resize(end.a.size());
  force_sum(end.forces, rhs_);
  report.linear_iterations = mass_solver_.solve(rhs_, end.a);
  if (report.linear_iterations < 0) {
    report.failure = MassSolver::failure;
    return false;
  }
  parallel_each(end.v.size(), [&](std::size_t i) { end.v[i] += 0.5 * h * end.a[i]; });
  for (const ImposedStep& s : imposed_) end.v[s.dof] = s.v;
  complete_forces(system_, end);
  report.books =
      central_difference_books(system_, begin, start_.balance(), a_begin, contact_->work(begin, end), end, h);
  return true;
}

namespace {

std::unique_ptr<ExplicitContact> contact_by(EnforcementKind enforcement, const System& system) {
  switch (enforcement) {
    case EnforcementKind::impulse:
      return impulse_contact(system);
    case EnforcementKind::lagrange:
      return forward_increment_contact(system);
    case EnforcementKind::penalty:
    case EnforcementKind::augmented_lagrangian:
    case EnforcementKind::plain:
      break;
  }
  return penalty_contact(system);
}

}  // namespace

SchemeRow central_differences_row() {
  return {.make = [](const SchemeRequest& r) -> std::unique_ptr<Scheme> {
            return std::make_unique<CentralDifferences>(r.system, contact_by(r.settings.enforcement, r.system));
          },
          .stability_limit = [](const SchemeParameters& /*parameters*/) { return 2.0; }};
}

}  // namespace carom
