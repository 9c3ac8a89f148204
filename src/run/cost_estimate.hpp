// What a run will need, known before it starts.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace carom {

/// Orders of magnitude, from counts of cells, nodes, steps and frames.
struct CostEstimate {
  double seconds = 0.0;       ///< on one core
  double memory_bytes = 0.0;  ///< largest resident memory
  double disk_bytes = 0.0;    ///< of the results folder
  long long frames = 0;       ///< .vtu files
};
CostEstimate estimate_cost(const Simulation& simulation);

/// Steps between two .vtu files.
long long frame_interval(const Simulation& simulation);

/// "about 3 GB", "about 20 s", "about 2 h": one significant figure, in the unit that suits.
std::string about_bytes(double bytes);
std::string about_seconds(double seconds);

/// What is left of the memory of this machine (Linux' MemAvailable, and the limits of the process), and of the disk
/// that holds a folder, or its nearest parent; infinite where unknown.
double available_memory();
double available_disk(const std::string& folder);

/// "it needs about 3 GB in all, and about 2 GB are there".
std::string memory_statement(const Simulation& simulation);

/// Runs that need more than what is there, or more than a user expects of a run: 4 GB of files, half of the memory, or
/// a day; and contacts that may have more rows than a dense compliance (contact/delassus.hpp). folder: of the results,
/// "" where none are written.
std::vector<std::string> cost_warnings(const Simulation& simulation, const std::string& folder);

}  // namespace carom
