#include "run/run_case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "advise/steps_left.hpp"
#include "base/checksum.hpp"
#include "base/terminal_text.hpp"
#include "base/version.hpp"
#include "build/initial_state.hpp"
#include "build/read_whole.hpp"
#include "build/simulation.hpp"
#include "casefile/read_case.hpp"
#include "kernels/isa.hpp"
#include "parallel/ranks.hpp"
#include "parallel/threads.hpp"
#include "run/run.hpp"

namespace carom {

namespace {

/// The first rank writes and speaks for all: what they compute is the same.
bool is_first() {
  return ranks().own() == 0;
}

/// What presses in all contacts together.
double normal_force(const ContactResponse& rows) {
  double sum = 0.0;
  for (std::size_t r = 0; r < rows.force.size(); ++r)
    if (!is_bond(rows.rows->law[r])) sum += std::abs(rows.force[r][0]);
  return sum;
}

/// The line of progress.
class ShownProgress : public Observer {
 public:
  ShownProgress(const Run& run, ProgressMode mode)
      : is_quiet_(mode == ProgressMode::quiet || !is_first()),
        left_(run.simulation(), run.march().end()),
        progress_(stderr, is_quiet_ ? ProgressMode::quiet : mode) {}
  void see(const StepView& view) override {
    if (view.step == 0 || is_quiet_) return;
    progress_.update({view.state.t, view.step, view.dt, view.iterations, view.monitor.relative_imbalance(),
                      left_.after(view), view.ledger.now().kinetic, normal_force(view.forces.rows)});
  }
  void finish() { progress_.finish(""); }

 private:
  bool is_quiet_;
  StepsLeft left_;
  Progress progress_;
};

/// To stderr; when that has gone, the results are still in the folder.
template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  if (!is_first()) return;
  print_to_terminal(stderr, fmt::format(format, std::forward<Values>(values)...));
}

void say_lines(std::string_view kind, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) say("{}: {}\n", kind, line);
}

/// Kernels of different instruction sets round differently, and ranks would drift apart.
void refuse_mixed_kernels() {
  if (!same_on_all_ranks(static_cast<double>(chosen_isa())))
    throw std::runtime_error(fmt::format(
        "the ranks' processors have different instruction sets, this one {}: give all of them the lowest of theirs by "
        "CAROM_ISA (v2, v3 or v4) in their environment",
        name(chosen_isa())));
}

/// Programs of different versions, or cases and meshes that are not the same, make another run on each rank.
void refuse_different_runs(std::initializer_list<std::string> known) {
  bool is_same = true;
  for (const std::string& text : known) {
    constexpr unsigned to_a_double = 11;
    is_same = same_on_all_ranks(static_cast<double>(checksum(text) >> to_a_double)) && is_same;
  }
  if (!is_same)
    throw std::runtime_error(
        "the ranks do not make the same run: give all of them the same program, and case, mesh and results on a disk "
        "that all of them see");
}

/// "" of what is not a file.
std::string bytes_of(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) return "";
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void say_ranks() {
  if (ranks().count() > 1)
    say("note: {} ranks of {} thread{} each\n", ranks().count(), thread_count(), thread_count() == 1 ? "" : "s");
}

void print_verdict(const Summary& summary, const std::string& folder) {
  for (const VerdictItem& item : summary.verdict) {
    if (!item.pass) say("FAILED  {}: {:.3g}, limit {:.3g} ({})\n", item.name, item.value, item.limit, item.explanation);
  }
  for (const CheckSummary& check : summary.checks) {
    const bool reached = check.time <= summary.scheme.time_reached;
    if (!check.pass && reached) {
      say("FAILED  check {} at t = {:.6g}: {:.10g}, reference {:.10g}, difference {:.3g} ({})\n", check.name,
          check.time, check.value, check.reference, check.difference, check.source);
    }
  }
  say("{}: {}\n", verdict_words(summary), summary.message);
  say("{} step{} in {:.3g} s; results in {}, open {}/report.html\n", summary.scheme.steps,
      summary.scheme.steps == 1 ? "" : "s", summary.cost.wall_seconds, folder, folder);
}

ExitCode exit_code(Outcome outcome) {
  switch (outcome) {
    case Outcome::good:
      return ExitCode::good;
    case Outcome::failed:
      return ExitCode::verdict_failed;
    case Outcome::stopped:
    case Outcome::error:
      break;
  }
  return ExitCode::run_failed;
}

/// From the first step, or the first after a checkpoint, to the verdict.
ExitCode conduct(Run& run, ShownProgress& progress, const RunOptions& options, const std::atomic<bool>& stop) {
  const bool quiet = options.progress == ProgressMode::quiet;
  while (!run.is_over()) {
    run.step();
    if (on_any_rank(stop.load()) && run.march().steps() > 0 && !run.is_over()) run.interrupt();
  }
  progress.finish();
  if (!quiet)
    for (const std::string& line : run.march().log()) say("{}\n", line);
  const std::size_t said = quiet ? 0 : run.watched().warnings.size();  // before the first step
  const Summary summary = run.finish();
  const bool is_good = summary.outcome == Outcome::good && summary.doubts.empty();
  if (!quiet || !is_good) {
    say_lines("warning",
              std::vector(summary.warnings.begin() + static_cast<std::ptrdiff_t>(said), summary.warnings.end()));
    print_verdict(summary, options.folder);
  }
  if (summary.outcome == Outcome::stopped) say("carom resume {} goes on from there\n", options.folder);
  return exit_code(summary.outcome);
}

}  // namespace

ExitCode run_case(const std::string& case_file, const RunOptions& options, const std::atomic<bool>& stop) {
  const Run::Begin begin;
  set_threads(options.threads);
  refuse_mixed_kernels();
  ReadCase read = read_whole(case_file, options.accepted);
  refuse_own_folder(read.given, options.folder);
  if (ranks().count() > 1) {
    const std::filesystem::path mesh = std::filesystem::path(case_file).parent_path() / *read.given.mesh.file;
    refuse_different_runs({version(), bytes_of(case_file), bytes_of(mesh)});
  }
  const Simulation simulation(std::move(read.given));
  Run run(simulation, is_first() ? options.folder : "", begin);
  run.note(std::move(read.notes));
  ShownProgress progress(run, options.progress);
  run.add(progress);
  run.begin();
  if (options.progress != ProgressMode::quiet) {
    say_ranks();
    say_lines("warning", run.watched().warnings);
    say_lines("note", run.watched().notes);
  }
  return conduct(run, progress, options, stop);
}

ExitCode resume_case(const RunOptions& options, std::optional<double> end, const std::atomic<bool>& stop) {
  const Run::Begin begin;
  set_threads(options.threads);
  refuse_mixed_kernels();
  FoundRun found = find_run(options.folder);
  const FoundCheckpoint checkpoint = found.checkpoint;
  refuse_different_runs({version(), fmt::format("{} {}", checkpoint.info.step, checkpoint.info.time)});
  const Simulation simulation(found.given);
  Run run(simulation, is_first() ? options.folder : "", begin);
  run.go_on(std::move(found), end);
  ShownProgress progress(run, options.progress);
  run.add(progress);
  if (!checkpoint.passed_over.empty()) say("warning: {}\n", checkpoint.passed_over);
  if (options.progress != ProgressMode::quiet) {
    say_ranks();
    say("from step {}, t = {:.6g}, on ({})\n", checkpoint.info.step, checkpoint.info.time, checkpoint.path);
  }
  return conduct(run, progress, options, stop);
}

}  // namespace carom
