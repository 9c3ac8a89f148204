// What can be said about a case without running it.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace carom {

/// Doubtful things: first touch after the end, a penalty so soft that the wall gives way or so stiff that the step has
/// to pay for it, a step that skips waves, schemes outside their unconditional stability, unit plausibility.
std::vector<std::string> lint_warnings(const Simulation& simulation);

/// Why the scheme of a stage makes energy on multipliers (schemes/touch_rebound.hpp), and what to choose instead; ""
/// where it does not.
std::string touch_remedy(const Stage& stage);

/// The text of `carom check`: parts with mass, kinetic energy and momentum; contacts with gap and first touch; stable
/// step and Courant number; estimated cost.
std::string check_summary(const Simulation& simulation);

}  // namespace carom
