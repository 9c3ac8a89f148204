// A run that goes on long after the impact is over, as where milliseconds were meant and seconds were written.
#pragma once

#include <optional>
#include <string>

#include "build/simulation.hpp"

namespace carom {

/// A warning where the end lies far beyond what an impact can need. Both must hold:
///   - axial waves (E / rho)^(1/2), of the slowest part, cross the largest body more than 10,000 times. A clamped plate
///   of
///     length 100 h swings in its lowest bending mode with a period of 2 pi 12^(1/2) / 3.516 L^2 / (h c) = 6.2 L^2 / (h
///     c) (R. D. Blevins, Formulas for Natural Frequency and Mode Shape, 1979, table 8-1), 620 crossings: 16 such
///     periods;
///   - the fastest body, once it has touched, moves by more than 20 times the size of the largest, and under gravity g
///     the end is later than 2 v / g, the way up and down of a full rebound, twice.
/// Nothing is said where something makes the run last: functions of time, imposed motions, loads other than gravity,
/// rotations, statics, rigid bodies, springs and masses of nodes, another run's state, or no contact.
std::optional<std::string> long_run_warning(const Simulation& simulation);

}  // namespace carom
