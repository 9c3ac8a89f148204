#include "schemes/nonsmooth_generalized_alpha.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>
#include <stdexcept>
#include <utility>

#include "enforcement/jump_port.hpp"
#include "parallel/threads.hpp"
#include "schemes/books.hpp"
#include "schemes/scheme_table.hpp"

namespace carom {

namespace {

double weight_of_new_force(const GeneralizedAlphaParameters& p) {
  return (1.0 - p.alpha_f) / (1.0 - p.alpha_m);
}

}  // namespace

NonsmoothGeneralizedAlpha::NonsmoothGeneralizedAlpha(const System& system, const GeneralizedAlphaParameters& p,
                                                     const ImplicitSettings& settings, double dt,
                                                     double omega_max_squared)
    : system_(system),
      parameters_(p),
      kappa_(weight_of_new_force(p)),
      mass_solver_(std::make_shared<MassSolver>(system)),
      bonds_(std::make_shared<BondedMass>(system, *mass_solver_)),
      stage_(system, settings, p.beta * kappa_ * dt * dt, omega_max_squared,
             std::make_unique<JumpPort>(system, (2.0 * p.beta - p.gamma) / (p.gamma * 2.0 * p.beta * kappa_),
                                        mass_solver_, bonds_),
             force_of_bodies(system)),
      start_(system) {
  assert(settings.enforcement == EnforcementKind::impulse && p.gamma > 0.0 && 2.0 * p.beta >= p.gamma);
  const std::size_t n = system.solid.dof_count();
  for (std::vector<double>* v : {&u_hat_, &v_hat_, &carried_, &known_, &u_predicted_, &jump_, &mean_, &mean_inertia_})
    v->resize(n);
}

/// jump_ from the contact forces.
bool NonsmoothGeneralizedAlpha::solve_jump(const Forces& forces) {
  std::fill(jump_.begin(), jump_.end(), 0.0);
  const std::vector<RowStatus>& status = forces.rows.status;
  if (std::all_of(status.begin(), status.end(), [](RowStatus s) { return s == RowStatus::open; })) return true;
  if (!bonds_->any()) return mass_solver_->solve(forces.contact.dense(), jump_) >= 0;
  jump_ = force_of_contact(forces.rows, jump_.size());
  if (!is_zero(jump_)) bonds_->contact_operator().inverse(jump_);
  return true;
}

/// Resultant of p / h and of what the supports and the bonds answer to it.
Momentum NonsmoothGeneralizedAlpha::jump_resultant(const State& end) {
  system_.mass.apply(jump_, mean_inertia_);
  const MomentArms arms(system_, end.q);
  const bool has_bonds = bonds_->any();  // whose forces at the end are not those of the jump alone
  const auto sums = parallel_sums<6>(jump_.size(), [&](std::size_t i, std::array<double, 6>& s) {
    const bool is_answered = has_bonds || system_.supports.is_prescribed(static_cast<Index>(i));
    add_with_moment(arms.at(i / 3), i % 3, is_answered ? mean_inertia_[i] : end.forces.contact[i], s.data());
  });
  return momentum_from(sums.data());
}

void NonsmoothGeneralizedAlpha::start(State& state, double dt) {
  start_in_equilibrium(system_, stage_, dt, state);
  if (!solve_jump(state.forces)) throw std::runtime_error(MassSolver::failure);
  const std::size_t n = state.q.size();
  NonsmoothMemory::Acceleration smooth{std::vector<double>(n),
                                       combine(1.0, resultant(system_, state), -1.0, jump_resultant(state))};
  for (std::size_t i = 0; i < n; ++i) smooth.value[i] = state.a[i] - jump_[i];
  state.memory = NonsmoothMemory{smooth, smooth};
}

/// old_: the memory of the beginning with the accelerations of the supports that the step begins with.
bool NonsmoothGeneralizedAlpha::start_from_the_right(const State& begin, double h) {
  const auto& memory = std::get<NonsmoothMemory>(begin.memory);
  const auto follow = [&](const NonsmoothMemory::Acceleration& from, NonsmoothMemory::Acceleration& to) {
    if (!start_.set(from.value, h, imposed_, [](const ImposedStep& s) { return s.a_begin; })) return false;
    to.value.assign(start_.a().begin(), start_.a().end());
    to.force = combine(1.0, from.force, 1.0, start_.change(begin.q));
    return true;
  };
  return follow(memory.a, old_.a) && follow(memory.z, old_.z);
}

StepReport NonsmoothGeneralizedAlpha::step(const State& begin, const StepRequest& request, State& end) {
  const auto [alpha_m, alpha_f, beta, gamma] = parameters_;
  const double h = request.dt, scale = 2.0 * beta * kappa_;
  const std::size_t n = begin.q.size();
  go_on_from(begin, end);
  end.t = request.t_end;
  evaluate_loads(system_, end.t, end.forces);
  imposed_steps(system_.supports, begin.t, end.t, begin.q, imposed_);
  if (!start_from_the_right(begin, h)) return {false, 0, 0, MassSolver::failure, {}};
  for (std::size_t i = 0; i < n; ++i) {
    carried_[i] = (alpha_f * old_.z.value[i] - alpha_m * old_.a.value[i]) / (1.0 - alpha_m);
    u_hat_[i] = begin.q[i] + h * begin.v[i] + h * h * ((0.5 - beta) * old_.a.value[i] + beta * carried_[i]);
    v_hat_[i] = begin.v[i] + h * ((1.0 - gamma) * old_.a.value[i] + gamma * carried_[i]);
    u_predicted_[i] = begin.q[i] + 0.5 * h * begin.v[i];
    known_[i] = scale * end.forces.external[i];
  }
  for (const ImposedStep& s : imposed_) u_predicted_[s.dof] = 0.5 * (begin.q[s.dof] + s.u);
  // The equation times `scale`, so that its contact force is p / h.
  const StageEquation equation{.m = scale,
                               .k = scale,
                               .s = beta * kappa_ * h * h,
                               .r = gamma * kappa_ * h,
                               .dt = h,
                               .x_hat = u_hat_,
                               .v_hat = v_hat_,
                               .known = known_,
                               .x_predicted = u_predicted_,
                               .imposed = imposed_};
  impose_on_stage(equation, end.a);
  StageReport solved = stage_.solve(equation, begin, request.tolerance, end);
  StepReport report{solved.converged, solved.iterations, solved.linear_iterations, std::move(solved.failure), {}};
  if (!report.converged) return report;
  if (!solve_jump(end.forces)) {
    report.converged = false;
    report.failure = MassSolver::failure;
    return report;
  }
  split(h, end);
  report.failure = bonds_->balance(end.a, end.forces);
  if (!report.failure.empty()) {
    report.converged = false;
    return report;
  }
  complete_forces(system_, end);
  report.books = books(begin, h, end);
  return report;
}

/// end.a = y becomes z1 and a1 in the memory, and z1 + W/h; end.v receives what is missing of the jump.
void NonsmoothGeneralizedAlpha::split(double h, State& end) {
  const double beta = parameters_.beta, gamma = parameters_.gamma;
  auto& memory = std::get<NonsmoothMemory>(end.memory);
  parallel_each(end.q.size(), [&](std::size_t i) {
    const double z = end.a[i] - jump_[i] / (2.0 * beta * kappa_);
    end.v[i] += h * (1.0 - gamma / (2.0 * beta)) * jump_[i];
    end.a[i] = z + jump_[i];
    memory.a.value[i] = kappa_ * z + carried_[i];
    memory.z.value[i] = z;
    mean_[i] = 0.5 * (old_.z.value[i] + z) + jump_[i];
  });
  for (const ImposedStep& s : imposed_) end.v[s.dof] = s.v;
}

/// The books, and the resultants in the memory of the end.
LedgerIncrement NonsmoothGeneralizedAlpha::books(const State& begin, double h, State& end) {
  const auto [alpha_m, alpha_f, beta, gamma] = parameters_;
  const Momentum jump = jump_resultant(end);
  const Momentum of_z = combine(1.0, resultant(system_, end), -1.0, jump);
  const Momentum carried = combine(alpha_f / (1.0 - alpha_m), old_.z.force, -alpha_m / (1.0 - alpha_m), old_.a.force);
  auto& memory = std::get<NonsmoothMemory>(end.memory);
  memory.a.force = combine(kappa_, of_z, 1.0, carried);
  memory.z.force = of_z;
  // The equation of the step is M (z_bar + W/h) + F_bar = f_bar + p/h + mean reactions: given as inertia and reactions
  // of the end, with the weight 1.
  system_.mass.apply(mean_, mean_inertia_);
  end.forces.inertia.swap(mean_inertia_);
  const std::vector<SupportForce> supports = end.forces.supports;
  const StepWeights weights{.inertia = 1.0, .force = 0.5, .contact = 1.0, .support_work = 1.0};
  set_mean_reactions(system_, begin, weights, end);
  LedgerIncrement out = step_books(system_, begin, Balance(begin.forces), end, weights,
                                   stage_.port().work(begin, end, weights.support_work))
                            .increment;
  end.forces.inertia.swap(mean_inertia_);
  end.forces.supports = supports;
  out.impulse = combine(1.0, combine(h * (1.0 - gamma), old_.a.force, h * gamma, memory.a.force), h, jump);
  return out;
}

SchemeRow nonsmooth_generalized_alpha_row() {
  return {.make = [](const SchemeRequest& r) -> std::unique_ptr<Scheme> {
    return std::make_unique<NonsmoothGeneralizedAlpha>(r.system,
                                                       chung_hulbert_parameters(r.parameters<SpectralRadius>().rho_inf),
                                                       r.settings.implicit(), r.dt, r.omega_max_squared);
  }};
}

}  // namespace carom
