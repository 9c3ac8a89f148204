// How long waves take through the cells that contacts press on.
#pragma once

#include <vector>

#include "build/simulation.hpp"
#include "output/summary.hpp"

namespace carom {

/// By contact, without ties: the mean over its nodes of h / c, with h the least length of the cells there
/// (model/node_lengths.hpp) and c the speed of the fastest wave in them, sqrt(wave_modulus / rho). What a force does
/// within that time is the answer of one cell to the contact's stiffness, or to the step. Contacts at rigid bodies
/// alone have none.
std::vector<NamedValue> crossing_times(const Simulation& simulation);

}  // namespace carom
