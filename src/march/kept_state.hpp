// A state on its way to a checkpoint or back.
#pragma once

#include "base/archive.hpp"
#include "solid/solid.hpp"
#include "state/state.hpp"

namespace carom {

/// Takes the state out, or puts it in, as "state". What points remember goes out cell by cell, so that another
/// instruction set can take it in. Throws ArchiveError where it is of other bodies.
void keep_state(Archive& archive, const Solid& solid, State& state);

}  // namespace carom
