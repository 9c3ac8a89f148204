// What every scheme does before its first step.
#pragma once

#include "schemes/mass_solver.hpp"
#include "schemes/system.hpp"

namespace carom {

/// Sizes the state's vectors and sets the prescribed displacements and velocities at state.t (and their rates: the
/// velocity of an imposed displacement is the derivative of its function). Nodes without mass get no velocity.
void start_with_supports(const System& system, State& state);

/// Solves M a = f - F(u) + contact for the free accelerations, the prescribed ones standing in state.a, and completes
/// the forces. Throws std::runtime_error when the mass matrix cannot be solved.
void start_accelerations(const System& system, MassSolver& solver, State& state, Forces& forces);

/// rhs = f - F(u) + contact.
void force_sum(const Forces& forces, std::span<double> rhs);

}  // namespace carom
