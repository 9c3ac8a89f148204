#include "schemes/hulbert_chung.hpp"

#include <algorithm>
#include <array>
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

HulbertChung::HulbertChung(const System& system, const SpectralRadius& p)
    : system_(system),
      alpha_m_((2.0 * p.rho_inf - 1.0) / (1.0 + p.rho_inf)),
      beta_((5.0 - 3.0 * p.rho_inf) / ((1.0 + p.rho_inf) * (1.0 + p.rho_inf) * (2.0 - p.rho_inf))),
      gamma_(1.5 - alpha_m_),
      contact_(penalty_contact(system)),
      mass_solver_(system),
      start_(system),
      rhs_(system.solid.dof_count()),
      A_(system.solid.dof_count()),
      B_(system.solid.dof_count()) {
  assert(p.rho_inf >= 0.0 && p.rho_inf <= 1.0);
}

void HulbertChung::start(State& state, double dt) {
  start_with_supports(system_, state);
  // e0 = e1 = a0
  imposed_steps(system_.supports, state.t, state.t + dt, state.q, imposed_);
  for (const ImposedStep& s : imposed_) state.a[s.dof] = mean_acceleration(s, dt);
  contact_->start(system_, dt, dt, state);
  start_accelerations(system_, mass_solver_, state);
  state.memory = HulbertChungMemory{state.a, resultant(system_, state), dt};
}

StepReport HulbertChung::step(const State& begin, const StepRequest& request, State& end) {
  const double h = request.dt, share = 1.0 / (1.0 - alpha_m_);
  go_on_from(begin, end);
  end.t = request.t_end;
  const auto& memory = std::get<HulbertChungMemory>(begin.memory);
  auto& memory_end = std::get<HulbertChungMemory>(end.memory);
  StepReport report;
  imposed_steps(system_.supports, begin.t, end.t, begin.q, imposed_);
  const double change = h / memory.dt;
  // The a0 for which v1 = v0 + h (mean acceleration).
  const auto wanted = [&](const ImposedStep& s) {
    const double of_e0 = 1.0 - gamma_ - gamma_ * share * alpha_m_;
    return (mean_acceleration(s, h) - change * of_e0 * memory.e[s.dof]) / (gamma_ * share + (1.0 - change) * of_e0);
  };
  if (!start_.set(begin, h, imposed_, wanted)) {
    report.failure = MassSolver::failure;
    return report;
  }
  const std::span<const double> a_begin = start_.a();
  parallel_each(end.q.size(), [&](std::size_t i) {
    const double e0 = mix(change, a_begin[i], memory.e[i]), e1 = share * (a_begin[i] - alpha_m_ * e0);
    memory_end.e[i] = e1;
    B_[i] = (0.5 - beta_) * e0 + beta_ * e1;
    A_[i] = (1.0 - gamma_) * e0 + gamma_ * e1;
    end.q[i] = begin.q[i] + h * begin.v[i] + h * h * B_[i];
    end.v[i] = begin.v[i] + h * A_[i];
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
  report.books = explicit_books(system_, begin, start_.balance(), contact_->work(begin, end), end, A_, B_, h);
  const Momentum now = resultant(system_, begin, start_.balance());
  const Momentum before = combine(1.0 - change, now, change, memory.force);
  memory_end.force = combine(share, now, -share * alpha_m_, before);
  memory_end.dt = h;
  report.books.impulse = combine(h * (1.0 - gamma_), before, h * gamma_, memory_end.force);
  report.converged = true;
  return report;
}

namespace {

/// Where a root of the amplification reaches -1:
///   omega^2 h^2 = (1 - 2 alpha_m) / (beta - gamma/2) = 12 (1 + r) (2 - r) / (10 - 5 r + r^2)
/// (the fit of the 1996 paper, their eq. 38, is the same at r = 0 and 1 and up to 0.4 % larger between).
double hulbert_chung_limit(const SchemeParameters& parameters) {
  const double r = std::get<SpectralRadius>(parameters).rho_inf;
  return std::sqrt(12.0 * (1.0 + r) * (2.0 - r) / (10.0 + r * (r - 5.0)));
}

}  // namespace

SchemeRow hulbert_chung_row() {
  return {.make = [](const SchemeRequest& r) -> std::unique_ptr<Scheme> {
            return std::make_unique<HulbertChung>(r.system, r.parameters<SpectralRadius>());
          },
          .stability_limit = hulbert_chung_limit};
}

}  // namespace carom
