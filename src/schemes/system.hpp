// The semi-discrete system M a = f - F(u) + contact + reactions, its forces at one instant, and the books of one step.
#pragma once

#include <span>
#include <vector>

#include "contact/penalty.hpp"
#include "energy/ledger.hpp"
#include "schemes/supports.hpp"
#include "solid/solid.hpp"
#include "state/state.hpp"

namespace carom {

/// What every scheme steps. References only: the owner outlives the scheme.
struct System {
  const Mesh& mesh;
  const Solid& solid;
  const Mass& mass;
  const Penalty& contact;
  const Supports& supports;
};

/// All forces at one instant (dof vectors). Where a dof is free, inertia = external - internal + contact up to the
/// residual of the solver; where it is prescribed, reaction closes the equation.
struct Forces {
  std::vector<double> internal, external, contact, reaction;
  std::vector<double> inertia;   ///< M a
  std::vector<double> momentum;  ///< M v
  PenaltyResponse rows;
  EnergyTerms stored;          ///< kinetic, strain, contact_stored of the state
  Momentum total_momentum;     ///< of the state
  double inertia_power = 0.0;  ///< a . M a
};

/// Fills internal, external and contact forces at time t, displacement u, velocity v; the contact history stands at
/// u_begin.
void evaluate_forces(const System& system, double t, std::span<const double> u_begin,
                     std::span<const RowHistory> history, std::span<const double> u, std::span<const double> v,
                     Forces& forces);

/// Fills what the accelerations and velocities of the state add: inertia, momentum, reactions, stored energies and
/// total momentum (angular momentum about the origin on the reference positions). evaluate_forces has been called.
void complete_forces(const System& system, const State& state, Forces& forces);

/// Books of one step of the Newmark family (central differences: beta = 0, gamma = 1/2). With x_bar the mean and dx the
/// difference of both ends of the step, h the step, kappa = beta - gamma/2, the kinematics give
///   d(1/2 v.Mv) = du . (M a)_bar + (gamma - 1/2) du . M da - h^2 kappa [ d(1/2 a.Ma) + (gamma - 1/2) da . M da ],
/// so that algorithmic = h^2 kappa d(1/2 a.Ma) - (gamma - 1/2) (du . M da - h^2 kappa da . M da)
/// (Krenk, Computer Methods in Applied Mechanics and Engineering 195, 2006, eq. 11, with forces instead of K u).
LedgerIncrement newmark_books(const System& system, const State& begin, const Forces& forces_begin, const State& end,
                              const Forces& forces_end, double beta, double gamma, double h);

}  // namespace carom
