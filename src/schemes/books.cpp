#include "schemes/books.hpp"

#include <array>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

/// The sums, and the reactions of the supports.
Momentum with_reactions(const System& system, std::span<const double> u, const Balance& balance, double* sums) {
  const MomentArms arms(system, u);
  const std::vector<PrescribedDof>& prescribed = system.supports.prescribed();
  for (std::size_t k = 0; k < prescribed.size(); ++k) {
    const auto i = static_cast<std::size_t>(prescribed[k].dof);
    add_with_moment(arms.at(i / 3), i % 3, balance.supports[k].reaction, sums);
  }
  return momentum_from(sums);
}

}  // namespace

LedgerIncrement books_of_works(const State& begin, const State& end, const StepWorks& works) {
  const ContactWork& contact = works.contact;
  LedgerIncrement step;
  EnergyTerms& energy = step.energy;
  energy = change_of_state(begin.forces.stored, end.forces.stored);
  energy.friction = contact.friction;
  energy.damping = contact.damping;
  energy.impact = contact.impact;
  energy.external_work = works.external;
  energy.support_work = works.support;
  energy.quadrature = works.internal - energy.strain - energy.hourglass - energy.distortion -
                      energy.sum(TermKind::spent) - contact.total - energy.contact_stored - contact.friction -
                      contact.damping - contact.impact;
  step.aster.ENER_CIN = energy.kinetic;
  step.aster.ENER_TOT = works.internal;
  step.aster.TRAV_EXT = works.external + works.support;
  step.aster.TRAV_LIAI = -contact.total;
  return step;
}

StepBooks step_books(const System& system, const State& begin, const Balance& b0, const State& end,
                     const StepWeights& w, const ContactWork& contact, std::span<const double> mean_internal) {
  const Forces &f0 = begin.forces, &f1 = end.forces;
  const MomentArms arms(system, begin.q, end.q, 0.5);
  // Works of internal and external forces; du . M a~, du . (f~ + R~ - F~), du . C~; the resultant.
  const auto sums = parallel_sums<11>(end.q.size(), [&](std::size_t i, std::array<double, 11>& s) {
    const double du = end.q[i] - begin.q[i];
    const double inertia = mix(w.inertia, b0.inertia[i], f1.inertia[i]);
    const bool is_given = !mean_internal.empty();
    const double internal = is_given ? mean_internal[i] : mix(w.force, f0.internal[i], f1.internal[i]);
    const double external = mix(w.force, f0.external[i], f1.external[i]);
    const double in_contact = mix(w.contact, f0.contact[i], f1.contact[i]);
    const auto dof = static_cast<Index>(i);
    const double support = system.supports.is_prescribed(dof) ? inertia + internal - external - in_contact : 0.0;
    s[0] += (is_given ? internal : 0.5 * (f0.internal[i] + f1.internal[i])) * du;
    s[1] += 0.5 * (f0.external[i] + f1.external[i]) * du;
    s[2] += inertia * du;
    s[3] += (external + support - internal) * du;
    s[4] += in_contact * du;
    add_with_moment(arms.at(i / 3), i % 3, external + support + in_contact, s.data() + 5);
  });
  double support = 0.0;
  for (std::size_t k = 0; k < b0.supports.size(); ++k)
    support += support_work(system, k, begin, b0, end, w.support_work);
  StepBooks out;
  out.force = momentum_from(sums.data() + 5);
  out.increment = books_of_works(begin, end, {sums[0], sums[1], support, contact});
  EnergyTerms& energy = out.increment.energy;
  energy.algorithmic = sums[2] - energy.kinetic + (sums[1] + support - sums[0]) - sums[3] + (contact.total - sums[4]);
  return out;
}

void set_mean_reactions(const System& system, const State& begin, const StepWeights& w, State& end,
                        std::span<const double> mean_internal) {
  const Forces& f0 = begin.forces;
  Forces& f1 = end.forces;
  const std::vector<PrescribedDof>& prescribed = system.supports.prescribed();
  for (std::size_t k = 0; k < prescribed.size(); ++k) {
    const auto i = static_cast<std::size_t>(prescribed[k].dof);
    const double internal = mean_internal.empty() ? mix(w.force, f0.internal[i], f1.internal[i]) : mean_internal[i];
    f1.supports[k].inertia = f1.inertia[i];
    f1.supports[k].reaction = mix(w.inertia, f0.inertia[i], f1.inertia[i]) + internal -
                              mix(w.force, f0.external[i], f1.external[i]) -
                              mix(w.contact, f0.contact[i], f1.contact[i]);
  }
}

Momentum combine(double a, const Momentum& p, double b, const Momentum& q) {
  Momentum out;
  for (std::size_t c = 0; c < 3; ++c) {
    out.linear[c] = a * p.linear[c] + b * q.linear[c];
    out.angular[c] = a * p.angular[c] + b * q.angular[c];
  }
  return out;
}

Momentum resultant(const System& system, const State& state, const Balance& balance) {
  const MomentArms arms(system, state.q);
  const Forces& forces = state.forces;
  auto sums = parallel_sums<6>(forces.contact.size(), [&](std::size_t i, std::array<double, 6>& s) {
    add_with_moment(arms.at(i / 3), i % 3, forces.external[i] + forces.contact[i], s.data());
  });
  return with_reactions(system, state.q, balance, sums.data());
}

Momentum resultant(const System& system, const State& state) {
  return resultant(system, state, Balance(state.forces));
}

Momentum resultant(const System& system, std::span<const double> u, std::span<const double> force) {
  const MomentArms arms(system, u);
  const auto sums = parallel_sums<6>(force.size(), [&](std::size_t i, std::array<double, 6>& s) {
    add_with_moment(arms.at(i / 3), i % 3, force[i], s.data());
  });
  return momentum_from(sums.data());
}

}  // namespace carom
