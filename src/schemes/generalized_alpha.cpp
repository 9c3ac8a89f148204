#include "schemes/generalized_alpha.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "schemes/books.hpp"
#include "schemes/scheme_table.hpp"

namespace carom {

namespace {

GeneralizedAlphaParameters newmark_of(const SchemeParameters& parameters) {
  const auto& [beta, gamma] = std::get<NewmarkParameters>(parameters);
  return newmark_parameters(beta, gamma);
}
GeneralizedAlphaParameters hht_of(const SchemeParameters& parameters) {
  return hht_parameters(std::get<AlphaParameters>(parameters).alpha);
}
GeneralizedAlphaParameters wbz_of(const SchemeParameters& parameters) {
  return wbz_parameters(std::get<AlphaParameters>(parameters).alpha);
}
GeneralizedAlphaParameters chung_hulbert_of(const SchemeParameters& parameters) {
  return chung_hulbert_parameters(std::get<SpectralRadius>(parameters).rho_inf);
}

/// Of one of the functions above.
template <auto parameters_of>
std::unique_ptr<Scheme> make_alpha(const SchemeRequest& r) {
  return std::make_unique<GeneralizedAlpha>(r.system, parameters_of(r.settings.parameters), r.settings.implicit(), r.dt,
                                            r.omega_max_squared);
}

/// The multiplier has to take back the step's displacement h v = beta h^2 a1, and lets go in the next step, where the
/// equation of motion (1 - alpha_m) a2 + alpha_m a1 = 0 still remembers a1; the sum of what the velocity gains is
///   h (a1 + a2 + ...) = (1 - alpha_m) h a1 = (1 - alpha_m) v / beta,
/// so that the mass leaves with (1 - alpha_m) / beta - 1 times its speed: 1 for Chung and Hulbert with rho_inf = 1, 3
/// for Newmark's parameters with beta = 1/4.
template <auto parameters_of>
double rebound(const SchemeParameters& parameters) {
  const GeneralizedAlphaParameters p = parameters_of(parameters);
  return (1.0 - p.alpha_m) / p.beta - 1.0;
}

/// Hughes, The Finite Element Method, section 9.1.
double newmark_limit(const SchemeParameters& parameters) {
  const auto& p = std::get<NewmarkParameters>(parameters);
  if (p.is_stable_for_any_step()) return std::numeric_limits<double>::infinity();
  return 1.0 / std::sqrt(0.5 * p.gamma - p.beta);
}

}  // namespace

SchemeRow newmark_row() {
  return {.make = make_alpha<newmark_of>, .stability_limit = newmark_limit, .touch_rebound = rebound<newmark_of>};
}
SchemeRow hht_row() {
  return {.make = make_alpha<hht_of>, .touch_rebound = rebound<hht_of>};
}
SchemeRow wbz_row() {
  return {.make = make_alpha<wbz_of>, .touch_rebound = rebound<wbz_of>};
}
SchemeRow generalized_alpha_row() {
  return {.make = make_alpha<chung_hulbert_of>, .touch_rebound = rebound<chung_hulbert_of>};
}

GeneralizedAlpha::GeneralizedAlpha(const System& system, const GeneralizedAlphaParameters& p,
                                   const ImplicitSettings& settings, double dt, double omega_max_squared)
    : system_(system),
      parameters_(p),
      start_(system),
      stage_(system, settings, (1.0 - p.alpha_f) / (1.0 - p.alpha_m) * p.beta * dt * dt, omega_max_squared),
      impulses_(velocity_impulses(system, settings.enforcement)) {
  assert(p.beta > 0.0 && p.alpha_m < 1.0 && p.alpha_f < 1.0);
  const std::size_t n = system.solid.dof_count();
  for (std::vector<double>* x : {&u_predicted_, &v_predicted_, &known_, &inertia_, &pushed_begin_, &pushed_end_})
    x->resize(n);
}

void GeneralizedAlpha::start(State& state, double dt) {
  start_in_equilibrium(system_, stage_, dt, state);
  state.memory = GeneralizedAlphaMemory{resultant(system_, state)};
}

/// What is known before the solve, and its start value. False when the mass matrix cannot be solved.
bool GeneralizedAlpha::predict(const State& begin, double h, State& end) {
  const auto [alpha_m, alpha_f, beta, gamma] = parameters_;
  imposed_steps(system_.supports, begin.t, end.t, begin.q, imposed_);
  if (!start_.set(begin, h, imposed_, [](const ImposedStep& s) { return s.a_begin; }) ||
      (impulses_ && !impulses_->accelerations(begin.forces.rows, pushed_begin_)))
    return false;
  const Forces& now = begin.forces;
  const std::span<const double> inertia = start_.balance().inertia;
  const std::span<const double> a_begin = start_.a();
  if (impulses_) system_.mass.apply(pushed_begin_, inertia_);
  for (std::size_t i = 0; i < begin.q.size(); ++i) {
    const double smooth = a_begin[i] - pushed_begin_[i];
    u_predicted_[i] = begin.q[i] + h * begin.v[i] + h * h * (0.5 - beta) * smooth;
    v_predicted_[i] = begin.v[i] + h * (1.0 - gamma) * smooth;
    known_[i] = (1.0 - alpha_f) * end.forces.external[i] + alpha_f * (now.external[i] - now.internal[i]) -
                alpha_m * (inertia[i] - inertia_[i]);
    end.a[i] += (0.5 / beta - 1.0) * pushed_begin_[i];
  }
  return true;
}

/// From the unknown s + M^-1 G^T lambda / (2 beta) to the acceleration, and to the velocity of VelocityImpulses.
bool GeneralizedAlpha::stop_at_rows(const State& begin, double h, State& end, StepReport& report) {
  if (!impulses_->accelerations(end.forces.rows, pushed_end_)) {
    report.failure = MassSolver::failure;
    return false;
  }
  const double share = 0.5 / parameters_.beta;
  for (std::size_t i = 0; i < end.a.size(); ++i) {
    end.a[i] += (1.0 - share) * pushed_end_[i];
    end.v[i] -= parameters_.gamma * h * share * pushed_end_[i];
  }
  report.failure = impulses_->respond(h, end.forces.rows, end.stages.front().mass_nodes, end.v);
  if (report.failure.empty()) report.failure = settle_bonds(begin, end);
  return report.failure.empty();
}

/// The bonds' forces c1 at the end, which the equation has as (1 - alpha_m) c1 + alpha_m c0.
std::string GeneralizedAlpha::settle_bonds(const State& begin, State& end) {
  const auto [alpha_m, alpha_f, beta, gamma] = parameters_;
  if (!impulses_->has_bonds() || (alpha_m == 0.0 && alpha_f == 0.0)) return impulses_->settle_bonds(end);
  const Forces &f0 = begin.forces, &f1 = end.forces;
  const std::span<const double> inertia = start_.balance().inertia;
  std::vector<double> besides(end.q.size());
  for (std::size_t i = 0; i < besides.size(); ++i) {
    const double last = f1.external[i] - f1.internal[i];
    const double mean = (1.0 - alpha_f) * last + alpha_f * (f0.external[i] - f0.internal[i]);
    besides[i] = last + (alpha_m * (inertia[i] - f0.contact[i]) - mean) / (1.0 - alpha_m);
  }
  return impulses_->settle_bonds(end, besides);
}

Momentum GeneralizedAlpha::resultant_of(std::span<const double> u, std::span<const double> acceleration) {
  system_.mass.apply(acceleration, inertia_);
  return resultant(system_, u, inertia_);
}

/// force: the resultant in the equation of motion.
Momentum GeneralizedAlpha::impulse(double h, const State& begin, State& end, const Momentum& force) {
  const auto [alpha_m, alpha_f, beta, gamma] = parameters_;
  Momentum before = combine(1.0, std::get<GeneralizedAlphaMemory>(begin.memory).force, 1.0, start_.change(begin.q));
  Momentum after = combine(1.0 / (1.0 - alpha_m), force, -alpha_m / (1.0 - alpha_m), before);
  end.memory = GeneralizedAlphaMemory{after};
  Momentum of_contact;
  if (impulses_) {
    before = combine(1.0, before, -1.0, resultant_of(begin.q, pushed_begin_));
    after = combine(1.0, after, -1.0, resultant_of(end.q, pushed_end_));
    of_contact = resultant_of(end.q, impulses_->push());
  }
  return combine(1.0, combine(h * (1.0 - gamma), before, h * gamma, after), h, of_contact);
}

StepReport GeneralizedAlpha::step(const State& begin, const StepRequest& request, State& end) {
  const auto [alpha_m, alpha_f, beta, gamma] = parameters_;
  const double h = request.dt;
  go_on_from(begin, end);
  end.t = request.t_end;
  evaluate_loads(system_, end.t, end.forces);
  if (!predict(begin, h, end)) return {false, 0, 0, MassSolver::failure, {}};
  // Times 2 beta / (1 - alpha_m) the equation has the multipliers as they are.
  const double share = impulses_ ? 2.0 * beta / (1.0 - alpha_m) : 1.0;
  if (impulses_) {
    for (double& f : known_) f *= share;
  }
  const StageEquation equation{.m = share * (1.0 - alpha_m),
                               .k = share * (1.0 - alpha_f),
                               .s = beta * h * h,
                               .r = gamma * h,
                               .dt = h,
                               .x_hat = u_predicted_,
                               .v_hat = v_predicted_,
                               .known = known_,
                               .imposed = imposed_};
  impose_on_stage(equation, end.a);
  StageReport solved = stage_.solve(equation, begin, share * request.tolerance, end);
  StepReport report{false, solved.iterations, solved.linear_iterations, std::move(solved.failure), {}};
  if (!solved.converged || (impulses_ && !stop_at_rows(begin, h, end, report))) return report;
  complete_forces(system_, end);
  const StepWeights weights{
      .inertia = 1.0 - alpha_m, .force = 1.0 - alpha_f, .contact = impulses_ ? 1.0 - alpha_m : 1.0};
  const StepBooks books = step_books(system_, begin, start_.balance(), end, weights,
                                     stage_.port().work(begin, end, impulses_ ? 1.0 : weights.support_work));
  report.books = books.increment;
  report.books.impulse = impulse(h, begin, end, books.force);
  report.converged = true;
  if (impulses_) end.within = {1.0, impulses_->response(), end.q};
  return report;
}

}  // namespace carom
