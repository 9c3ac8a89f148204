// The text of `carom check`.
#pragma once

#include <string>

#include "run/simulation.hpp"

namespace carom {

/// Parts with mass, kinetic energy and momentum; contacts with gap and first touch; stages with steps and Courant
/// number; stable step; estimated cost.
std::string check_summary(const Simulation& simulation);

}  // namespace carom
