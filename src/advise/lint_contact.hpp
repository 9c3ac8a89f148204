// What is doubtful about the contacts of a case.
#pragma once

#include <string>
#include <vector>

#include "build/simulation.hpp"

namespace carom {

/// Surfaces that are not reached, that pass by or look away from each other, that nothing moves towards; a penalty so
/// soft that the wall gives way, or so stiff that the step has to pay for it; springs and dampers of stops that make
/// the explicit step tiny.
std::vector<std::string> contact_warnings(const Simulation& simulation);

}  // namespace carom
