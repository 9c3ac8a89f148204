// Programs run side by side.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace carom::compare {

/// A program with its arguments; what it prints goes to `log`.
struct Job {
  std::vector<std::string> arguments;  ///< the first is the path of the program
  std::string log;
};

/// How a job ended: its exit code, 128 + number of the signal that ended it, or -1 when it was not started.
using ExitCodes = std::vector<int>;

/// Runs the jobs in their order, at most `at_once` at a time, and waits for all. One that fails does not concern the
/// others. `finished(job, code)` is called after each. When `stop` becomes true the running jobs get SIGTERM and no
/// more are started. Throws OutputError when a log cannot be written and std::system_error when a process cannot be
/// made.
ExitCodes run_jobs(const std::vector<Job>& jobs, int at_once, const std::atomic<bool>& stop,
                   const std::function<void(std::size_t, int)>& finished);

}  // namespace carom::compare
