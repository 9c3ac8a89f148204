#include "schemes/noh_bathe.hpp"

#include <cassert>
#include <utility>

#include "parallel/threads.hpp"
#include "schemes/books.hpp"
#include "schemes/explicit_books.hpp"
#include "schemes/imposed_motion.hpp"
#include "schemes/initial_acceleration.hpp"

namespace carom {

NohBathe::NohBathe(const System& system, double p)
    : system_(system),
      p_(p),
      q1_((1.0 - 2.0 * p) / (2.0 * p * (1.0 - p))),
      mass_solver_(system),
      rhs_(system.solid.dof_count()),
      predicted_(system.solid.dof_count()),
      A_(system.solid.dof_count()),
      B_(system.solid.dof_count()) {
  assert(p > 0.0 && p < 1.0);
  q2_ = 0.5 - p * q1_;
  q0_ = 0.5 - q1_ - q2_;
}

void NohBathe::start(State& state, double dt) {
  start_with_supports(system_, state);
  evaluate_forces(system_, state.t, state.q, state.contact, state.q, state.v, now_);
  const double k = p_ * dt;
  impose_motions(
      system_, state.t, {k, 0.5 * k * k, k, 0.5 * k}, [&](std::size_t i) { return state.q[i] + k * state.v[i]; },
      [&](std::size_t i) { return state.v[i]; }, state.a);
  start_accelerations(system_, mass_solver_, state, now_);
}

/// To t_p. The acceleration there enters v_p with the weight k/2, and the displacement and velocity at t1 beside.
int NohBathe::first_part(const State& begin, const StepRequest& request) {
  const double k = p_ * request.dt, rest = request.dt - k;
  middle_ = begin;
  middle_.t = request.t_end - rest;
  parallel_each(begin.q.size(), [&](std::size_t i) {
    predicted_[i] = begin.v[i] + 0.5 * k * begin.a[i];
    middle_.q[i] = begin.q[i] + k * predicted_[i];
  });
  evaluate_forces(system_, middle_.t, begin.q, begin.contact, middle_.q, predicted_, middle_forces_);
  impose_motions(
      system_, middle_.t, {rest, 0.5 * rest * (k + rest), 0.0, 0.5 * k},
      [&](std::size_t i) { return middle_.q[i] + rest * predicted_[i]; }, [&](std::size_t i) { return predicted_[i]; },
      middle_.a);
  force_sum(middle_forces_, rhs_);
  const int iterations = mass_solver_.solve(rhs_, middle_.a);
  parallel_each(begin.q.size(), [&](std::size_t i) { middle_.v[i] = predicted_[i] + 0.5 * k * middle_.a[i]; });
  take_history(middle_forces_.rows, middle_);
  complete_forces(system_, middle_, middle_forces_);
  return iterations;
}

/// From t_p to t1. The acceleration at t1 enters v1 with the weight rest q2, and the next t_p by half its square
/// beside.
int NohBathe::second_part(const State& begin, const StepRequest& request, State& end) {
  const double k = p_ * request.dt, rest = request.dt - k;
  end = middle_;
  end.t = request.t_end;
  parallel_each(begin.q.size(), [&](std::size_t i) {
    end.q[i] = middle_.q[i] + rest * middle_.v[i] + 0.5 * rest * rest * middle_.a[i];
    predicted_[i] = middle_.v[i] + rest * (q0_ * begin.a[i] + (0.5 + q1_) * middle_.a[i]);
    end.v[i] = middle_.v[i] + rest * middle_.a[i];
  });
  evaluate_forces(system_, request.t_end, middle_.q, middle_.contact, end.q, end.v, next_);
  impose_motions(
      system_, request.t_end, {k, k * (rest * q2_ + 0.5 * k), 0.0, rest * q2_},
      [&](std::size_t i) { return end.q[i] + k * predicted_[i]; }, [&](std::size_t i) { return predicted_[i]; }, end.a);
  force_sum(next_, rhs_);
  const int iterations = mass_solver_.solve(rhs_, end.a);
  parallel_each(begin.q.size(), [&](std::size_t i) { end.v[i] = predicted_[i] + rest * q2_ * end.a[i]; });
  take_history(next_.rows, end);
  complete_forces(system_, end, next_);
  return iterations;
}

LedgerIncrement NohBathe::books(const State& begin, const StepRequest& request, const State& end) {
  const double k = p_ * request.dt, rest = request.dt - k;
  LedgerIncrement sum = central_difference_books(system_, begin, now_, middle_, middle_forces_, k);
  parallel_each(begin.q.size(), [&](std::size_t i) {
    B_[i] = 0.5 * middle_.a[i];
    A_[i] = q0_ * begin.a[i] + (0.5 + q1_) * middle_.a[i] + q2_ * end.a[i];
  });
  LedgerIncrement second = explicit_books(system_, middle_, middle_forces_, end, next_, A_, B_, rest);
  const Momentum middle = resultant(system_, middle_.q, middle_forces_);
  second.impulse = combine(rest * q0_, resultant(system_, begin.q, now_), rest * q2_, resultant(system_, end.q, next_));
  second.impulse = combine(1.0, second.impulse, rest * (0.5 + q1_), middle);
  sum.energy += second.energy;
  sum.aster += second.aster;
  sum.impulse = combine(1.0, sum.impulse, 1.0, second.impulse);
  return sum;
}

StepReport NohBathe::step(const State& begin, const StepRequest& request, State& end) {
  StepReport report;
  const int first = first_part(begin, request);
  const int second = first < 0 ? -1 : second_part(begin, request, end);
  if (second < 0) {
    report.failure = MassSolver::failure;
    return report;
  }
  report.linear_iterations = first + second;
  report.books = books(begin, request, end);
  report.converged = true;
  std::swap(now_, next_);
  return report;
}

}  // namespace carom
