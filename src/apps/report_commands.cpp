#include "apps/report_commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "base/errors.hpp"
#include "base/terminal_text.hpp"
#include "casefile/read_case.hpp"
#include "output/progress.hpp"
#include "output/results_folder.hpp"
#include "output/results_lock.hpp"
#include "report/report.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

void refuse_other_folders(const std::string& folder) {
  const std::string expected = "the results folder of a run (carom run CASE.toml --out FOLDER)";
  if (!fs::exists(folder)) throw CaseError({folder, 0, 0}, "", "no such folder", expected);
  if (!fs::is_directory(folder)) throw CaseError({folder, 0, 0}, "", "something that is not a folder", expected);
  const auto is_there = [&folder](const char* name) { return fs::exists(fs::path(folder) / name); };
  if (!is_there("energy.csv") && !is_there("summary.json"))
    throw CaseError({folder, 0, 0}, "", "a folder without energy.csv and summary.json", expected);
}

/// When the case of the folder ends; 0 where it does not tell.
double end_of_case(const std::string& folder) {
  try {
    const Case given = read_case((fs::path(folder) / resolved_case_file).string());
    return given.stages.empty() ? *given.time.end : *given.stages.back().time.end;
  } catch (const CaseError&) {
    return 0.0;  // not written yet, or of another version
  }
}

/// The clock that is left until `end`, by the pace of the last looks.
class Pace {
 public:
  std::optional<double> seconds_left(double t, double end) {
    constexpr std::size_t looks = 20;
    const Clock::time_point now = Clock::now();
    seen_.emplace_back(t, now);
    if (seen_.size() > looks) seen_.pop_front();
    const auto& [first_t, first] = seen_.front();
    if (!(t > first_t) || !(end > t)) return std::nullopt;
    return (end - t) / (t - first_t) * std::chrono::duration<double>(now - first).count();
  }

 private:
  std::deque<std::pair<double, Clock::time_point>> seen_;
};

void wait(int seconds, const std::atomic<bool>& stop) {
  constexpr std::chrono::milliseconds look(50);
  for (const Clock::time_point end = Clock::now() + std::chrono::seconds(seconds); !stop.load() && Clock::now() < end;)
    std::this_thread::sleep_for(look);
}

}  // namespace

ExitCode report_runs(const std::vector<std::string>& folders, const std::string& file) {
  for (const std::string& folder : folders) refuse_other_folders(folder);
  std::string page = file;
  if (folders.size() == 1) {
    write_report(folders.front(), file);
    if (page.empty()) page = (fs::path(folders.front()) / "report.html").string();
  } else {
    if (page.empty()) page = "out/comparison.html";
    write_comparison(folders, page);
  }
  fmt::print("{}\n", terminal_text(page));
  return ExitCode::good;
}

ExitCode show_tables(const std::vector<std::string>& folders, const std::string& format) {
  for (const std::string& folder : folders) refuse_other_folders(folder);
  print_to_terminal(stdout, tables_of_runs(folders, format));
  return ExitCode::good;
}

ExitCode watch_run(const std::string& folder, int every, const std::atomic<bool>& stop) {
  refuse_other_folders(folder);
  const bool is_live = ::isatty(::fileno(stdout)) == 1;
  const auto has_ended = [&folder] { return !is_held(folder) && fs::exists(fs::path(folder) / "summary.json"); };
  if (!has_ended()) fmt::print("open {}\n", terminal_text((fs::path(folder) / "watch.html").string()));
  Pace pace;
  std::optional<double> left;
  while (!stop.load() && !has_ended()) {
    if (!is_held(folder) && !has_ended()) {
      write_report(folder);
      fmt::print("no run is going on in {}; what it has left is in its report.html\n", terminal_text(folder));
      return ExitCode::run_failed;
    }
    const double end = end_of_case(folder);
    const double t = write_watch_page(folder, {end, left, every});
    left = pace.seconds_left(t, end);
    if (is_live) {
      fmt::print("\r{}\x1b[K", progress_share(t, end, left));
      std::fflush(stdout);
    }
    wait(every, stop);
  }
  if (is_live) fmt::print("\r\x1b[K");
  if (!has_ended()) return ExitCode::good;
  end_watch_page(folder);
  fmt::print("the run has ended; its report is {}\n", terminal_text((fs::path(folder) / "report.html").string()));
  return ExitCode::good;
}

}  // namespace carom
