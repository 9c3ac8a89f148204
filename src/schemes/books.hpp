// The books of a step of any scheme, from the forces at both ends and the weights that the scheme gives them.
#pragma once

#include "enforcement/contact_work.hpp"
#include "system/system.hpp"

namespace carom {

/// (1 - w) x0 + w x1
inline double mix(double w, double x0, double x1) {
  return (1.0 - w) * x0 + w * x1;
}

/// Weights of the end of the step (1 minus those of its beginning) in the scheme's equation of motion
///   M a~ + F~ = f~ + C~ + R~,  x~ = (1 - w) x0 + w x1,
/// and in the work of the supports (support_work).
struct StepWeights {
  double inertia = 0.5;
  double force = 0.5;  ///< of internal and external forces
  double contact = 0.5;
  double support_work = 0.5;
};

/// Work of the support of entry k of Supports::prescribed: the part that its inertia takes, v_bar (M dv) with v_bar the
/// mean of both ends, and the part that balances the forces, ((1 - w) (R0 - M a0) + w (R1 - M a1)) du. The first is the
/// change of kinetic energy, whatever the velocity does within the step. balance: M a0 and R0, here and below
/// (StepStart::balance).
inline double support_work(const System& system, std::size_t k, const State& begin, const Balance& balance,
                           const State& end, double w) {
  const auto i = static_cast<std::size_t>(system.supports.prescribed()[k].dof);
  const SupportForce &before = balance.supports[k], &after = end.forces.supports[k];
  const double rest = mix(w, before.reaction - before.inertia, after.reaction - after.inertia);
  return 0.5 * (begin.v[i] + end.v[i]) * (after.momentum - begin.forces.supports[k].momentum) +
         rest * (end.q[i] - begin.q[i]);
}

/// Works over a step by the trapezoidal rule, of internal and external forces and of contact, and of the supports.
struct StepWorks {
  double internal = 0.0, external = 0.0, support = 0.0;
  ContactWork contact;
};

/// All books of a step but `algorithmic` and the impulse. `quadrature` is the difference between two sums: the works of
/// internal forces and of contact, and all that these forces account for, which is what bodies and springs store and
/// what points, friction, dampers and impacts take.
LedgerIncrement books_of_works(const State& begin, const State& end, const StepWorks& works);

/// The energies of a step, and the resultant of external, contact and support forces in the scheme's equation.
struct StepBooks {
  LedgerIncrement increment;
  Momentum force;
};

/// Books internal and external works by the trapezoidal rule, W_k, contact as its port has booked it, and what the
/// scheme takes out by its own kinematics and weights,
///   algorithmic = du . M a~ - d(1/2 v.Mv) + sum over k of (W_k - du . f~_k),
/// which is zero for the trapezoidal rule (a~ = dv/h, du = h (v0 + v1)/2). R~ closes the equation where motions are
/// imposed. A scheme whose F~ is not a weighted mean of both ends gives it as mean_internal; its work is then du . F~.
/// The imbalance of the ledger is then du . (M a~ + F~ - f~ - C~) on the free dofs: it checks the solve.
StepBooks step_books(const System& system, const State& begin, const Balance& balance, const State& end,
                     const StepWeights& weights, const ContactWork& contact,
                     std::span<const double> mean_internal = {});

/// Replaces the reactions, and the inertia of the supports, at the end, for schemes whose acceleration is the mean of
/// the step, by R~.
void set_mean_reactions(const System& system, const State& begin, const StepWeights& weights, State& end,
                        std::span<const double> mean_internal = {});

/// a p + b q
Momentum combine(double a, const Momentum& p, double b, const Momentum& q);

/// Resultant of external, contact and support forces at one instant.
Momentum resultant(const System& system, const State& state, const Balance& balance);
Momentum resultant(const System& system, const State& state);

/// Resultant of one force, a dof vector, with moments where the nodes stand at the displacement u.
Momentum resultant(const System& system, std::span<const double> u, std::span<const double> force);

}  // namespace carom
