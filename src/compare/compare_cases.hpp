// From a case and a matrix of choices to a table and a page.
#pragma once

#include <atomic>
#include <string>

#include "compare/matrix.hpp"
#include "run/run_case.hpp"

namespace carom::compare {

struct Settings {
  std::string program;   ///< path of carom, which runs the variants
  std::string folder;    ///< of the results
  int jobs = 0;          ///< runs at a time; 0: as many as cores
  bool quiet = false;    ///< no progress and no table
  std::string format{};  ///< of the printed table (output/data_table.hpp); "" for the terminal's
};

/// Runs every allowed combination as `carom run --threads 1` in <folder>/variants/<name>, and writes compare.csv,
/// compare.json and compare.html; prints the table. Good when a variant is recommended, run_failed when `stop` became
/// true. Throws CaseError when the case itself is wrong or no combination is allowed, OutputError when results cannot
/// be written.
ExitCode compare_cases(const std::string& case_file, const Options& options, const Settings& settings,
                       const std::atomic<bool>& stop);

}  // namespace carom::compare
