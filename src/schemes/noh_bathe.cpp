#include "schemes/noh_bathe.hpp"

#include <cassert>
#include <cmath>
#include <utility>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "schemes/books.hpp"
#include "schemes/explicit_books.hpp"
#include "schemes/imposed_motion.hpp"
#include "schemes/initial_acceleration.hpp"
#include "schemes/scheme_table.hpp"

namespace carom {

NohBathe::NohBathe(const System& system, const NohBatheParameters& parameters)
    : system_(system),
      p_(parameters.p),
      q1_((1.0 - 2.0 * p_) / (2.0 * p_ * (1.0 - p_))),
      contact_(penalty_contact(system)),
      mass_solver_(system),
      start_(system),
      rhs_(system.solid.dof_count()),
      predicted_(system.solid.dof_count()),
      A_(system.solid.dof_count()),
      B_(system.solid.dof_count()) {
  assert(p_ > 0.0 && p_ < 1.0);
  q2_ = 0.5 - p_ * q1_;
  q0_ = 0.5 - q1_ - q2_;
}

// The impulse of a step is h (p/2 (f0 + f_p) + (1 - p) (q0 f0 + (1/2 + q1) f_p + q2 f1)).
double NohBathe::end_weight() const {
  return (1.0 - p_) * q2_ / (1.0 - middle_weight());
}
double NohBathe::middle_weight() const {
  return 0.5 * p_ + (1.0 - p_) * (0.5 + q1_);
}

void NohBathe::start(State& state, double dt) {
  start_with_supports(system_, state);
  const double k = p_ * dt;
  imposed_steps(system_.supports, state.t, state.t + k, state.q, imposed_);
  for (const ImposedStep& s : imposed_) state.a[s.dof] = acceleration_to_middle(s, k);
  contact_->start(system_, dt, dt, state);
  start_accelerations(system_, mass_solver_, state);
}

/// Accelerations from the forces; the prescribed ones are there.
bool NohBathe::solve(State& state, StepReport& report) {
  force_sum(state.forces, rhs_);
  const int iterations = mass_solver_.solve(rhs_, state.a);
  report.linear_iterations += iterations;
  if (iterations < 0) report.failure = MassSolver::failure;
  return iterations >= 0;
}

/// To t_p, a step of central differences.
bool NohBathe::first_part(const State& begin, const StepRequest& request, StepReport& report) {
  const double k = p_ * request.dt, rest = request.dt - k;
  go_on_from(begin, middle_);
  middle_.t = request.t_end - rest;
  imposed_steps(system_.supports, begin.t, middle_.t, begin.q, imposed_);
  const auto wanted = [k](const ImposedStep& s) { return acceleration_to_middle(s, k); };
  if (!start_.set(begin, k, imposed_, wanted)) {
    report.failure = MassSolver::failure;
    return false;
  }
  const std::span<const double> a_begin = start_.a();
  parallel_each(begin.q.size(), [&](std::size_t i) {
    predicted_[i] = begin.v[i] + 0.5 * k * a_begin[i];
    middle_.q[i] = begin.q[i] + k * predicted_[i];
  });
  for (const ImposedStep& s : imposed_) {
    predicted_[s.dof] = s.mean_velocity;
    middle_.q[s.dof] = s.u;
  }
  for (const ImposedStep& s : imposed_) middle_.a[s.dof] = acceleration_from_middle(s, k);
  report.failure = contact_->evaluate(system_, begin, k, predicted_, middle_);
  if (!report.failure.empty()) return false;
  if (!solve(middle_, report)) return false;
  parallel_each(begin.q.size(), [&](std::size_t i) { middle_.v[i] = predicted_[i] + 0.5 * k * middle_.a[i]; });
  take_history(middle_.forces.rows, middle_.q, middle_.contact);
  for (const ImposedStep& s : imposed_) middle_.v[s.dof] = s.v;
  complete_forces(system_, middle_);
  return true;
}

/// From t_p to t1. Imposed accelerations at t1 give v1 by the scheme's rule.
bool NohBathe::second_part(const StepRequest& request, State& end, StepReport& report) {
  const double rest = (1.0 - p_) * request.dt;
  const std::span<const double> a_begin = start_.a();
  go_on_from(middle_, end);
  end.t = request.t_end;
  parallel_each(middle_.q.size(), [&](std::size_t i) {
    end.q[i] = middle_.q[i] + rest * middle_.v[i] + 0.5 * rest * rest * middle_.a[i];
    predicted_[i] = middle_.v[i] + rest * (q0_ * a_begin[i] + (0.5 + q1_) * middle_.a[i]);
    end.v[i] = middle_.v[i] + rest * middle_.a[i];
  });
  imposed_steps(system_.supports, middle_.t, end.t, middle_.q, imposed_);
  for (const ImposedStep& s : imposed_) {
    end.q[s.dof] = s.u;
    end.v[s.dof] = s.v;
    end.a[s.dof] = (s.v - predicted_[s.dof]) / (rest * q2_);
  }
  report.failure = contact_->evaluate(system_, middle_, rest, end.v, end);
  if (!report.failure.empty() || !solve(end, report)) return false;
  parallel_each(end.q.size(), [&](std::size_t i) { end.v[i] = predicted_[i] + rest * q2_ * end.a[i]; });
  take_history(end.forces.rows, end.q, end.contact);
  for (const ImposedStep& s : imposed_) end.v[s.dof] = s.v;
  complete_forces(system_, end);
  return true;
}

LedgerIncrement NohBathe::books(const State& begin, const StepRequest& request, const State& end) {
  const double k = p_ * request.dt, rest = request.dt - k;
  LedgerIncrement sum = central_difference_books(system_, begin, start_.balance(), start_.a(),
                                                 contact_->work(begin, middle_), middle_, k);
  const std::span<const double> a_begin = start_.a();
  parallel_each(begin.q.size(), [&](std::size_t i) {
    B_[i] = 0.5 * middle_.a[i];
    A_[i] = q0_ * a_begin[i] + (0.5 + q1_) * middle_.a[i] + q2_ * end.a[i];
  });
  LedgerIncrement second =
      explicit_books(system_, middle_, Balance(middle_.forces), contact_->work(middle_, end), end, A_, B_, rest);
  const Momentum middle = resultant(system_, middle_);
  second.impulse =
      combine(rest * q0_, resultant(system_, begin, start_.balance()), rest * q2_, resultant(system_, end));
  second.impulse = combine(1.0, second.impulse, rest * (0.5 + q1_), middle);
  sum.energy += second.energy;
  sum.aster += second.aster;
  sum.lag = add(sum.lag, second.lag);
  sum.impulse = combine(1.0, sum.impulse, 1.0, second.impulse);
  return sum;
}

StepReport NohBathe::step(const State& begin, const StepRequest& request, State& end) {
  StepReport report;
  if (!first_part(begin, request, report) || !second_part(request, end, report)) return report;
  report.books = books(begin, request, end);
  end.within.weight = middle_weight();
  std::swap(end.within.rows, middle_.forces.rows);
  end.within.u = middle_.q;
  report.converged = true;
  return report;
}

namespace {

/// Displacement and h times velocity after a step of Noh and Bathe's scheme with h = 1 and a = -w^2 u.
struct Oscillator {
  double u, v;
};
Oscillator noh_bathe_step(double p, double w, const Oscillator& start) {
  const double q1 = (1.0 - 2.0 * p) / (2.0 * p * (1.0 - p)), q2 = 0.5 - p * q1, q0 = 0.5 - q1 - q2, k = 1.0 - p;
  const double a0 = -w * w * start.u, up = start.u + p * start.v + 0.5 * p * p * a0;
  const double ap = -w * w * up, vp = start.v + 0.5 * p * (a0 + ap);
  const double u1 = up + k * vp + 0.5 * k * k * ap, a1 = -w * w * u1;
  return {u1, vp + k * (q0 * a0 + (0.5 + q1) * ap + q2 * a1)};
}

/// Both eigenvalues of a real 2 x 2 matrix lie in the unit circle when |det| <= 1 and |trace| <= 1 + det.
bool noh_bathe_is_stable(double p, double w) {
  const Oscillator first = noh_bathe_step(p, w, {1.0, 0.0}), second = noh_bathe_step(p, w, {0.0, 1.0});
  const double trace = first.u + second.v, det = first.u * second.v - first.v * second.u;
  constexpr double round_off = 1e-12;
  return std::abs(det) <= 1.0 + round_off && std::abs(trace) <= 1.0 + det + round_off;
}

/// By bisection (3.745 for p = 0.54).
double noh_bathe_limit(const SchemeParameters& parameters) {
  const double p = std::get<NohBatheParameters>(parameters).p;
  double stable = 0.0, step = 1e-2;
  while (noh_bathe_is_stable(p, stable + step)) stable += step;
  for (; step > 1e-10; step *= 0.5) {
    if (noh_bathe_is_stable(p, stable + step)) stable += step;
  }
  return stable;
}

}  // namespace

SchemeRow noh_bathe_row() {
  return {.make = [](const SchemeRequest& r) -> std::unique_ptr<Scheme> {
            return std::make_unique<NohBathe>(r.system, r.parameters<NohBatheParameters>());
          },
          .stability_limit = noh_bathe_limit,
          .parts_of_step = 2};
}

}  // namespace carom
