#include "schemes/tchamwa_wielgosz.hpp"

#include <cassert>
#include <cmath>
#include <utility>

#include "parallel/threads.hpp"
#include "schemes/books.hpp"
#include "schemes/explicit_books.hpp"
#include "schemes/imposed_motion.hpp"
#include "schemes/initial_acceleration.hpp"
#include "schemes/scheme_table.hpp"

namespace carom {

TchamwaWielgosz::TchamwaWielgosz(const System& system, const TchamwaWielgoszParameters& parameters)
    : system_(system),
      phi_(parameters.phi),
      contact_(penalty_contact(system)),
      mass_solver_(system),
      start_(system),
      rhs_(system.solid.dof_count()),
      B_(system.solid.dof_count()) {
  assert(phi_ >= 1.0);
}

void TchamwaWielgosz::start(State& state, double dt) {
  start_with_supports(system_, state);
  imposed_steps(system_.supports, state.t, state.t + dt, state.q, imposed_);
  for (const ImposedStep& s : imposed_) state.a[s.dof] = mean_acceleration(s, dt);
  contact_->start(system_, dt, dt, state);
  start_accelerations(system_, mass_solver_, state);
}

StepReport TchamwaWielgosz::step(const State& begin, const StepRequest& request, State& end) {
  const double h = request.dt;
  go_on_from(begin, end);
  end.t = request.t_end;
  StepReport report;
  imposed_steps(system_.supports, begin.t, end.t, begin.q, imposed_);
  const auto wanted = [h](const ImposedStep& s) { return mean_acceleration(s, h); };
  if (!start_.set(begin, h, imposed_, wanted)) {
    report.failure = MassSolver::failure;
    return report;
  }
  const std::span<const double> a_begin = start_.a();
  parallel_each(end.q.size(), [&](std::size_t i) {
    B_[i] = phi_ * a_begin[i];
    end.q[i] = begin.q[i] + h * begin.v[i] + h * h * B_[i];
    end.v[i] = begin.v[i] + h * a_begin[i];
  });
  for (const ImposedStep& s : imposed_) {
    end.q[s.dof] = s.u;
    end.v[s.dof] = s.v;
  }
  for (const ImposedStep& s : imposed_) end.a[s.dof] = mean_acceleration(s, h);
  report.failure = contact_->evaluate(system_, begin, h, end.v, end);
  if (!report.failure.empty()) return report;
  force_sum(end.forces, rhs_);
  report.linear_iterations = mass_solver_.solve(rhs_, end.a);
  if (report.linear_iterations < 0) {
    report.failure = MassSolver::failure;
    return report;
  }
  take_history(end.forces.rows, end.q, end.contact);
  complete_forces(system_, end);
  report.books = explicit_books(system_, begin, start_.balance(), contact_->work(begin, end), end, a_begin, B_, h);
  report.books.impulse = combine(h, resultant(system_, begin, start_.balance()), 0.0, {});
  report.converged = true;
  return report;
}

SchemeRow tchamwa_wielgosz_row() {
  return {.make = [](const SchemeRequest& r) -> std::unique_ptr<Scheme> {
            return std::make_unique<TchamwaWielgosz>(r.system, r.parameters<TchamwaWielgoszParameters>());
          },
          .stability_limit =
              [](const SchemeParameters& parameters) {
                return 2.0 / std::sqrt(2.0 * std::get<TchamwaWielgoszParameters>(parameters).phi - 1.0);
              }};
}

}  // namespace carom
