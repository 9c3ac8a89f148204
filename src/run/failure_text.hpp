// What a run says that cannot go on: where, and what helps.
#pragma once

#include <string>

#include "run/stage.hpp"

namespace carom {

/// The node that moves fastest (or the first whose motion is not finite) and a solid cell that holds it.
std::string worst_place(const System& system, const State& state);

/// The keys that help where a run makes energy.
std::string energy_remedy(const Stage& stage);

}  // namespace carom
