// How many steps a stage will take, and how long.
#pragma once

#include "build/simulation.hpp"

namespace carom {

/// How many times more steps contact makes of them: springs of surfaces that move over each other stiffen as they
/// close, in explicit steps by 1.2 times, with friction, whose springs are as stiff on a small overlap as on a whole
/// face, by 2.1 (medians of tests/verification/tower_trial.py, where nine of ten are within 1.3 times that).
double contact_cut(const Stage& stage, const Simulation& simulation);

/// Steps of Stage::steps() and those that contact will cut short.
long long expected_steps(const Stage& stage, const Simulation& simulation);

/// Seconds on one core. What the bodies cost is measured, by one evaluation of their forces; the rest is counted:
///   explicit steps    forces, 30 ns a node, and for each node of a contact surface 8 us by springs that find their
///                     rows anew, 20 us by impulses and multipliers;
///   implicit steps    iterations (1 where all is linear, else 4), each with a pass over the factors (or 100 actions of
///                     K without), factors and a tangent of 60 evaluations where the bodies are not linear, and 15 us
///                     for each node of a contact surface;
/// each as often as a step has parts (parts_of_step).
/// A factor of nested dissection over n nodes has 8 n^(4/3) blocks of 3 x 3 of a cube, and takes 25 n^2 operations;
/// 8 n log2 n and 30 n^(3/2) in a plane (A. George, SIAM J. Numer. Anal. 10, 1973).
double stage_seconds(const Stage& stage, const Simulation& simulation);

/// True where the implicit steps of a stage factor their matrix: what the scheme will choose, with the bound of the
/// frequency by elements and c / m of Newmark's average acceleration.
bool has_factor(const Stage& stage);

}  // namespace carom
