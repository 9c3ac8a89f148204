// The commands that look at results folders: report and watch.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "run/run_case.hpp"

namespace carom {

/// `carom report`: of one folder its report again, of several a page that lays them over each other. `file`: "" for
/// report.html in the folder, or out/comparison.html. Throws CaseError for folders that hold no run and OutputError.
ExitCode report_runs(const std::vector<std::string>& folders, const std::string& file);

/// `carom report --format`: the tables of one run or several on stdout. Throws CaseError for folders that hold no run.
ExitCode show_tables(const std::vector<std::string>& folders, const std::string& format);

/// `carom watch`: writes watch.html into the folder every so many seconds, which reads itself again, until the run has
/// ended or `stop`. Good when it has ended, run_failed when no process is running there. Throws CaseError for folders
/// that hold no run and OutputError.
ExitCode watch_run(const std::string& folder, int every, const std::atomic<bool>& stop);

}  // namespace carom
