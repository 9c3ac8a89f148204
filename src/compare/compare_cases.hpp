// From a case and a matrix of choices to a table and a page.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "compare/matrix.hpp"
#include "compare/tables.hpp"
#include "compare/variant.hpp"
#include "run/run_case.hpp"

namespace carom::compare {

struct Settings {
  std::vector<std::string> program;  ///< what takes the arguments of carom: its path, or another program and its own
  std::string folder;                ///< of the results
  int jobs = 0;                      ///< runs at a time; 0: as many as cores
  /// Called after each run: how many have been made, of how many, and what the last one varied.
  std::function<void(std::size_t, std::size_t, const std::string&)> finished{};
};

/// The variants of a comparison that is to be written into a folder. Throws CaseError where none is allowed.
std::vector<Variant> variants_in(const std::string& folder, const Base& base, const Options& options);

/// Runs every variant that is allowed as `carom run --threads 1` in <folder>/variants/<name>, and writes compare.csv,
/// compare.json and compare.html. case_text: of the case, for the page. Runs that are going on are ended when `stop`
/// becomes true. Throws CaseError where no run has the name of the reference, and OutputError.
Comparison compare_variants(const Base& base, const std::string& case_text, const std::vector<Variant>& variants,
                            const Options& options, const Settings& settings, const std::atomic<bool>& stop);

/// What a comparison prints.
struct Shown {
  bool quiet = false;    ///< no progress and no table
  std::string format{};  ///< of the table (output/data_table.hpp); "" for the terminal's
};

/// Both of a case file, with progress and the table printed unless quiet. Good when a variant is recommended,
/// run_failed when `stop` became true. Throws CaseError when the case itself is wrong, too.
ExitCode compare_cases(const std::string& case_file, const Options& options, Settings settings, const Shown& shown,
                       const std::atomic<bool>& stop);

}  // namespace carom::compare
