#include "schemes/explicit_books.hpp"

#include <array>
#include <vector>

#include "parallel/threads.hpp"
#include "schemes/books.hpp"

namespace carom {

LedgerIncrement central_difference_books(const System& system, const State& begin, const Balance& b0,
                                         std::span<const double> a_begin, const State& end, double h) {
  const Forces &f0 = begin.forces, &f1 = end.forces;
  // The forces of each end act where the nodes stand then: with a lumped mass that is the exact change of momentum.
  const MomentArms arms_0(system, begin.q), arms_1(system, end.q);
  // Works of internal, contact and external forces, impulses and their moments.
  const double half = 0.5 * h;
  const auto sums = parallel_sums<9>(end.q.size() / 3, [&](std::size_t node, std::array<double, 9>& s) {
    Vec3 impulse_0, impulse_1;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * node + c;
      const double du = end.q[i] - begin.q[i];
      s[0] += 0.5 * (f0.internal[i] + f1.internal[i]) * du;
      s[1] += 0.5 * (f0.contact[i] + f1.contact[i]) * du;
      s[2] += 0.5 * (f0.external[i] + f1.external[i]) * du;
      impulse_0[c] = half * (f0.external[i] + f0.contact[i] + b0.reaction[i]);
      impulse_1[c] = half * (f1.external[i] + f1.contact[i] + f1.reaction[i]);
    }
    add_with_moment(arms_0.at(node), impulse_0, s.data() + 3);
    add_with_moment(arms_1.at(node), impulse_1, s.data() + 3);
  });
  const double internal_work = sums[0], contact_work = sums[1];
  double support = 0.0, inertia_power = f1.inertia_power - b0.inertia_power;  // da . (M a0 + M a1), as M is symmetric
  for (const PrescribedDof& p : system.supports.prescribed()) {
    const auto i = static_cast<std::size_t>(p.dof);
    support += support_work(i, begin, b0, end, 0.5);
    inertia_power -= (end.a[i] - a_begin[i]) * (b0.inertia[i] + f1.inertia[i]);
  }
  LedgerIncrement step;
  EnergyTerms& energy = step.energy;
  energy = change_of_state(f0.stored, f1.stored);
  energy.friction = f1.rows.slip_work;
  energy.damping = damping_work(begin, end);
  energy.external_work = sums[2];
  energy.support_work = support;
  energy.algorithmic = -0.125 * h * h * inertia_power;
  energy.quadrature = internal_work - energy.strain - energy.hourglass - energy.sum(TermKind::spent) - contact_work -
                      energy.contact_stored - energy.friction - energy.damping;
  step.aster.ENER_CIN = energy.kinetic;
  step.aster.ENER_TOT = internal_work;
  step.aster.TRAV_EXT = energy.external_work + energy.support_work;
  step.aster.TRAV_LIAI = -contact_work;
  step.impulse = momentum_from(sums.data() + 3);
  return step;
}

LedgerIncrement explicit_books(const System& system, const State& begin, const Balance& b0, const State& end,
                               std::span<const double> A, std::span<const double> B, double h) {
  LedgerIncrement step = central_difference_books(system, begin, b0, begin.a, end, h);
  const std::span<const double> inertia = end.forces.inertia;
  std::vector<double> MA(A.size());
  system.mass.apply(A, MA);
  step.energy.algorithmic = parallel_sum(A.size(), [&](std::size_t i) {
    if (system.supports.is_prescribed(static_cast<Index>(i))) return 0.0;
    const double du = end.q[i] - begin.q[i];
    return du * (0.5 * (b0.inertia[i] + inertia[i]) - MA[i]) - h * h * (0.5 * A[i] - B[i]) * MA[i];
  });
  step.impulse = {};
  return step;
}

}  // namespace carom
