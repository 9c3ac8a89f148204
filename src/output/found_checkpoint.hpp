// Which checkpoint of a results folder a run goes on from.
#pragma once

#include <string>

#include "output/checkpoint_file.hpp"

namespace carom {

/// A checkpoint that can be gone on from.
struct FoundCheckpoint {
  std::string path;
  CheckpointInfo info;
  std::string passed_over;  ///< why later ones were not taken; "" where there is none
};

/// The latest of a folder that is whole. Throws CheckpointError where there is none.
FoundCheckpoint find_checkpoint(const std::string& folder);

/// Removes those after it, whose steps are made again. Throws OutputError.
void remove_later(const std::string& folder, const FoundCheckpoint& found);

/// Throws CheckpointError, which says what differs, where a checkpoint is not of this program, case and mesh.
void refuse_others(const FoundCheckpoint& found, const CheckpointInfo& own);

}  // namespace carom
