// The first state of every scheme: supports, multipliers, accelerations.
#pragma once

#include "system/mass_solver.hpp"
#include "system/system.hpp"

namespace carom {

/// Sizes the state's vectors and sets the prescribed displacements and velocities at state.t (and their rates: the
/// velocity of an imposed displacement is the derivative of its function). Nodes without mass get no velocity. Clears
/// the memory of the scheme that the state comes from.
void start_with_supports(const System& system, State& state);

/// Finds the multipliers that the rows of state.forces need at the start, and puts them into forces and history: where
/// a row is closed, 0 <= a_n + max(0, v_n) / dt perpendicular to lambda_n >= 0 and Coulomb's conditions on a_t + v_t /
/// dt, a = M^-1 (f - F(u) + G^T lambda). Without them a body that rests would start with the acceleration of one that
/// falls, which schemes without dissipation never forget. Leaves the rows open where no such forces are found.
/// start_accelerations is to follow.
void start_multipliers(const System& system, MassSolver& solver, double dt, State& state);

/// Finds the multipliers of the linear equations alone, where springs have given the forces of contact.
void start_equations(const System& system, MassSolver& solver, double dt, State& state);

/// Solves M a = f - F(u) + contact for the free accelerations, the prescribed ones standing in state.a, and completes
/// the forces. Throws std::runtime_error when the mass matrix cannot be solved.
void start_accelerations(const System& system, MassSolver& solver, State& state);
/// The same with a lumped mass, where ranks share the nodes out, but for the inertia, which stays empty.
void start_lumped_accelerations(const System& system, const Holding& nodes, State& state);

}  // namespace carom
