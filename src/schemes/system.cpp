#include "schemes/system.hpp"

#include <array>

#include "math/vec3.hpp"
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
  system.solid.external_force(t, forces.external);
  system.contact.evaluate(u_begin, u, v, history, forces.rows);
  system.contact.add_force(forces.rows, forces.contact);
}

void complete_forces(const System& system, std::span<const double> a, std::span<const double> v, Forces& forces) {
  const std::size_t n = system.solid.dof_count();
  forces.inertia.resize(n);
  forces.momentum.resize(n);
  forces.reaction.assign(n, 0.0);
  system.mass.apply(a, forces.inertia);
  system.mass.apply(v, forces.momentum);
  for (const PrescribedDof& p : system.supports.prescribed()) {
    const auto i = static_cast<std::size_t>(p.dof);
    forces.reaction[i] = forces.inertia[i] + forces.internal[i] - forces.external[i] - forces.contact[i];
  }
}

EnergyTerms stored_energies(const System& system, const State& state, const Forces& forces) {
  EnergyTerms terms;
  terms.kinetic = 0.5 * dot(state.v, forces.momentum);
  terms.strain = system.solid.is_linear() ? 0.5 * dot(state.q, forces.internal) : system.solid.strain_energy(state.q);
  terms.contact_stored = forces.rows.stored;
  return terms;
}

namespace {

/// Sum over the nodes of a nodal vector and of its moment about the origin, by components in a fixed order.
template <class NodalVector>
Momentum sum_with_moment(const Mesh& mesh, const NodalVector& at) {
  Momentum sum;
  for (std::size_t c = 0; c < 3; ++c) {
    sum.linear[c] = parallel_sum(mesh.node_count(), [&](std::size_t n) { return at(n)[c]; });
    sum.angular[c] = parallel_sum(mesh.node_count(), [&](std::size_t n) {
      const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
      const Vec3 p = at(n);
      return mesh.coordinates[n][d] * p[e] - mesh.coordinates[n][e] * p[d];
    });
  }
  return sum;
}

/// Work of the mean of a force at both ends over the displacement of the step.
double mean_work(std::span<const double> f_begin, std::span<const double> f_end, const State& begin, const State& end) {
  return parallel_sum(f_begin.size(),
                      [&](std::size_t i) { return 0.5 * (f_begin[i] + f_end[i]) * (end.q[i] - begin.q[i]); });
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

double algorithmic_energy(const State& begin, const Forces& forces_begin, const State& end, const Forces& forces_end,
                          double beta, double gamma, double h) {
  const double kappa = h * h * (beta - 0.5 * gamma);
  const double half_aMa_change = 0.5 * (dot(end.a, forces_end.inertia) - dot(begin.a, forces_begin.inertia));
  if (gamma == 0.5) return kappa * half_aMa_change;
  const double defect = parallel_sum(end.q.size(), [&](std::size_t i) {
    const double dMa = forces_end.inertia[i] - forces_begin.inertia[i];
    return (end.q[i] - begin.q[i] - kappa * (end.a[i] - begin.a[i])) * dMa;
  });
  return kappa * half_aMa_change - (gamma - 0.5) * defect;
}

Momentum impulse_of(const Mesh& mesh, const Forces& f0, const Forces& f1, double gamma, double h) {
  return sum_with_moment(mesh, [&](std::size_t n) {
    Vec3 p;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * n + c;
      p[c] = h * ((1.0 - gamma) * (f0.external[i] + f0.contact[i] + f0.reaction[i]) +
                  gamma * (f1.external[i] + f1.contact[i] + f1.reaction[i]));
    }
    return p;
  });
}

}  // namespace

Momentum momentum_of(const System& system, const Forces& forces) {
  return sum_with_moment(system.mesh, [&](std::size_t n) {
    return Vec3{forces.momentum[3 * n], forces.momentum[3 * n + 1], forces.momentum[3 * n + 2]};
  });
}

LedgerIncrement newmark_books(const System& system, const State& begin, const Forces& forces_begin, const State& end,
                              const Forces& forces_end, double beta, double gamma, double h) {
  const EnergyTerms e0 = stored_energies(system, begin, forces_begin), e1 = stored_energies(system, end, forces_end);
  const double internal_work = mean_work(forces_begin.internal, forces_end.internal, begin, end);
  const double contact_work = mean_work(forces_begin.contact, forces_end.contact, begin, end);
  LedgerIncrement step;
  EnergyTerms& energy = step.energy;
  energy.kinetic = e1.kinetic - e0.kinetic;
  energy.strain = e1.strain - e0.strain;
  energy.contact_stored = e1.contact_stored - e0.contact_stored;
  energy.friction = forces_end.rows.slip_work;
  energy.damping = damping_work(system.contact, begin, forces_begin, end, forces_end);
  energy.external_work = mean_work(forces_begin.external, forces_end.external, begin, end);
  energy.support_work = mean_work(forces_begin.reaction, forces_end.reaction, begin, end);
  energy.algorithmic = algorithmic_energy(begin, forces_begin, end, forces_end, beta, gamma, h);
  energy.quadrature =
      internal_work - energy.strain - contact_work - energy.contact_stored - energy.friction - energy.damping;
  step.aster.ENER_CIN = energy.kinetic;
  step.aster.ENER_TOT = internal_work;
  step.aster.TRAV_EXT = energy.external_work + energy.support_work;
  step.aster.TRAV_LIAI = -contact_work;
  step.impulse = impulse_of(system.mesh, forces_begin, forces_end, gamma, h);
  return step;
}

}  // namespace carom
