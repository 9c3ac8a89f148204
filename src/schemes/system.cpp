#include "schemes/system.hpp"

#include <array>

#include "parallel/threads.hpp"

namespace carom {

void evaluate_forces(const System& system, double t, std::span<const double> u_begin,
                     std::span<const RowHistory> history, std::span<const double> u, std::span<const double> v,
                     Forces& forces) {
  const std::size_t n = system.solid.dof_count();
  forces.internal.resize(n);
  forces.external.resize(n);
  forces.contact.assign(n, 0.0);
  system.solid.internal_force(u, forces.internal);
  system.solid.external_force(t, system.mass, forces.external);
  system.contact.evaluate(u_begin, u, v, history, forces.rows);
  system.contact.add_force(forces.rows, forces.contact);
}

namespace {

/// Adds component c of a nodal force or momentum at dof 3 n + c, and its moment about the origin, to six sums.
void add_with_moment(const Vec3& x, std::size_t c, double p, double* sums) {
  const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
  sums[c] += p;
  sums[3 + d] += x[e] * p;  // (x cross p)_d = x_e p_c - x_c p_e
  sums[3 + e] -= x[d] * p;
}

Momentum momentum_from(const double* sums) {
  return {{sums[0], sums[1], sums[2]}, {sums[3], sums[4], sums[5]}};
}

double damping_work(const Penalty& contact, const State& begin, const Forces& forces_begin, const State& end,
                    const Forces& forces_end) {
  double work = 0.0;
  for (std::size_t r = 0; r < contact.rows().size(); ++r) {
    const double f = 0.5 * (forces_begin.rows.damper[r] + forces_end.rows.damper[r]);
    if (f == 0.0) continue;
    work -= f * (contact.rows().relative(r, end.q)[0] - contact.rows().relative(r, begin.q)[0]);
  }
  return work;
}

}  // namespace

void complete_forces(const System& system, const State& state, Forces& forces) {
  const std::size_t n = system.solid.dof_count();
  forces.inertia.resize(n);
  forces.momentum.resize(n);
  forces.reaction.assign(n, 0.0);
  system.mass.apply(state.a, forces.inertia);
  system.mass.apply(state.v, forces.momentum);
  for (const PrescribedDof& p : system.supports.prescribed()) {
    const auto i = static_cast<std::size_t>(p.dof);
    forces.reaction[i] = forces.inertia[i] + forces.internal[i] - forces.external[i] - forces.contact[i];
  }
  // v.Mv, u.F, a.Ma, momentum and its moment
  const auto sums = parallel_sums<9>(n, [&](std::size_t i, std::array<double, 9>& s) {
    s[0] += state.v[i] * forces.momentum[i];
    s[1] += state.q[i] * forces.internal[i];
    s[2] += state.a[i] * forces.inertia[i];
    add_with_moment(system.mesh.coordinates[i / 3], i % 3, forces.momentum[i], s.data() + 3);
  });
  forces.stored.kinetic = 0.5 * sums[0];
  forces.stored.strain = system.solid.is_linear() ? 0.5 * sums[1] : system.solid.strain_energy(state.q);
  forces.stored.contact_stored = forces.rows.stored;
  forces.inertia_power = sums[2];
  forces.total_momentum = momentum_from(sums.data() + 3);
}

LedgerIncrement newmark_books(const System& system, const State& begin, const Forces& f0, const State& end,
                              const Forces& f1, double beta, double gamma, double h) {
  const double kappa = h * h * (beta - 0.5 * gamma);
  // Works of internal, contact, external and support forces, the defect of the inertia, impulses and their moments.
  const auto sums = parallel_sums<11>(end.q.size(), [&](std::size_t i, std::array<double, 11>& s) {
    const double du = end.q[i] - begin.q[i];
    s[0] += 0.5 * (f0.internal[i] + f1.internal[i]) * du;
    s[1] += 0.5 * (f0.contact[i] + f1.contact[i]) * du;
    s[2] += 0.5 * (f0.external[i] + f1.external[i]) * du;
    s[3] += 0.5 * (f0.reaction[i] + f1.reaction[i]) * du;
    s[4] += (du - kappa * (end.a[i] - begin.a[i])) * (f1.inertia[i] - f0.inertia[i]);
    const double impulse = h * ((1.0 - gamma) * (f0.external[i] + f0.contact[i] + f0.reaction[i]) +
                                gamma * (f1.external[i] + f1.contact[i] + f1.reaction[i]));
    add_with_moment(system.mesh.coordinates[i / 3], i % 3, impulse, s.data() + 5);
  });
  const double internal_work = sums[0], contact_work = sums[1];
  LedgerIncrement step;
  EnergyTerms& energy = step.energy;
  energy.kinetic = f1.stored.kinetic - f0.stored.kinetic;
  energy.strain = f1.stored.strain - f0.stored.strain;
  energy.contact_stored = f1.stored.contact_stored - f0.stored.contact_stored;
  energy.friction = f1.rows.slip_work;
  energy.damping = damping_work(system.contact, begin, f0, end, f1);
  energy.external_work = sums[2];
  energy.support_work = sums[3];
  energy.algorithmic = 0.5 * kappa * (f1.inertia_power - f0.inertia_power) - (gamma - 0.5) * sums[4];
  energy.quadrature =
      internal_work - energy.strain - contact_work - energy.contact_stored - energy.friction - energy.damping;
  step.aster.ENER_CIN = energy.kinetic;
  step.aster.ENER_TOT = internal_work;
  step.aster.TRAV_EXT = energy.external_work + energy.support_work;
  step.aster.TRAV_LIAI = -contact_work;
  step.impulse = momentum_from(sums.data() + 5);
  return step;
}

}  // namespace carom
