// What a run says that cannot go on: where, and what helps.
#pragma once

#include <string>

#include "build/stage.hpp"

namespace carom {

/// The node that moves fastest (or the first whose motion is not finite) and a solid cell that holds it.
std::string worst_place(const System& system, const State& state);

/// The keys that help where a run makes energy.
std::string energy_remedy(const Stage& stage);

/// Why the scheme of a stage makes energy on plain multipliers (touch_rebound), and what to choose instead; "" where
/// it does not.
std::string touch_remedy(const Stage& stage);

}  // namespace carom
