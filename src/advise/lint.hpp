// What can be said about a case without running it.
#pragma once

#include <string>
#include <vector>

#include "build/simulation.hpp"

namespace carom {

/// Doubtful things: contacts (lint_contact.hpp), faces without one (loose_faces.hpp), a step that skips waves, schemes
/// outside their unconditional stability, multipliers that make energy, filters that will not be applied, plausibility
/// of units. Cells that lock are doubts of their own (locking.hpp).
std::vector<std::string> lint_warnings(const Simulation& simulation);

}  // namespace carom
