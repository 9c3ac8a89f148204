// What a run will need, known before it starts.
#pragma once

#include <string>
#include <vector>

#include "advise/rehearsal.hpp"
#include "build/simulation.hpp"

namespace carom {

/// Orders of magnitude, from counts of cells, nodes, steps and frames; seconds and steps as far as they were seen.
struct CostEstimate {
  std::vector<Pace> stages{};  ///< what each takes
  double seconds = 0.0;        ///< on one core
  double memory_bytes = 0.0;   ///< largest resident memory
  double disk_bytes = 0.0;     ///< of the results folder
  long long frames = 0;        ///< of fields
};
CostEstimate estimate_cost(const Simulation& simulation, const Rehearsal& seen = {});

/// What is left of the memory of this machine (Linux' MemAvailable, and the limits of the process), and of the disk
/// that holds a folder, or its nearest parent; infinite where unknown.
double available_memory();
double available_disk(const std::string& folder);

/// "it needs about 3 GB in all, and about 2 GB are there".
std::string memory_statement(const Simulation& simulation);

/// Runs that need more than what is there, or more than a user expects of a run: 4 GB of files, half of the memory, or
/// a day; and contacts that may have more rows than a dense compliance (rows/delassus.hpp). folder: of the results,
/// "" where none are written.
std::vector<std::string> cost_warnings(const Simulation& simulation, const std::string& folder,
                                       const Rehearsal& seen = {});

}  // namespace carom
