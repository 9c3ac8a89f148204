// A run as it was at an instant, in memory.
#pragma once

#include "base/memory_archive.hpp"
#include "output/checkpoint_file.hpp"

namespace carom {

/// What Run::save gives and Run::restore takes: what a checkpoint holds, and the curves so far.
struct Snapshot {
  CheckpointInfo origin;
  ArchivedValues values;
};

}  // namespace carom
