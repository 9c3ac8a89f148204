// When a run writes checkpoints, where, and which of them it goes on from.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "casefile/case.hpp"
#include "mesh/mesh.hpp"
#include "model/model.hpp"
#include "output/checkpoint_file.hpp"

namespace carom {

/// Coordinates, cells, groups and numbers of a mesh.
std::uint64_t mesh_digest(const Mesh& mesh);

/// Where the first nodes are, and which of them the cells of the parts have: what a state hangs on. The nodes of a mesh
/// as it is given come before those that hang on springs and obstacles.
std::uint64_t bodies_digest(const Model& model, std::size_t nodes);

/// Writes checkpoints into a results folder, at the steps and after the minutes that [output] asks for, and keeps the
/// last two. `origin` says what they are of; its step and time are filled in.
class Checkpoints {
 public:
  Checkpoints(std::string folder, const CaseOutput& when, CheckpointInfo origin);

  bool is_due(long long step) const;
  /// Throws OutputError.
  void write(long long step, double time, const CheckpointContents& contents);

 private:
  using Clock = std::chrono::steady_clock;

  std::string folder_;
  long long every_steps_;
  std::chrono::duration<double> every_;
  CheckpointInfo origin_;
  Clock::time_point last_ = Clock::now();
};

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
