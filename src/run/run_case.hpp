// From a case file to its results folder.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "output/progress.hpp"

namespace carom {

struct RunOptions {
  std::string folder;  ///< of the results
  int threads = 0;     ///< 0: all cores
  ProgressMode progress = ProgressMode::automatic;
  std::vector<std::string> accepted;  ///< keywords of a deck whose loss the user accepts
};

/// What the process tells the shell.
enum class ExitCode : std::uint8_t { good = 0, verdict_failed = 1, case_wrong = 2, run_failed = 3 };

/// Reads (a case file or a deck), builds, runs, writes the results and the report, and prints the verdict. Sets of
/// results stay readable when the run fails or `stop` becomes true (checked after every step). Throws CaseError before
/// anything is run and OutputError when results cannot be written.
ExitCode run_case(const std::string& case_file, const RunOptions& options, const std::atomic<bool>& stop);

/// Goes on in a results folder from its last checkpoint to the end of the case, or to `end`: the files of the folder
/// are then those of a run that has not been interrupted (docs/resume.md). Throws CheckpointError where it cannot,
/// before anything has been changed.
ExitCode resume_case(const RunOptions& options, std::optional<double> end, const std::atomic<bool>& stop);

}  // namespace carom
