// When a run writes checkpoints, and where.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "casefile/case.hpp"
#include "output/checkpoint_file.hpp"

namespace carom {

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

}  // namespace carom
