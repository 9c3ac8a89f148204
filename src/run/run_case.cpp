#include "run/run_case.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <initializer_list>
#include <new>
#include <utility>

#include "base/errors.hpp"
#include "base/terminal_text.hpp"
#include "casefile/read_case.hpp"
#include "casefile/resolved_case.hpp"
#include "mesh/mesh_summary.hpp"
#include "output/file_writer.hpp"
#include "output/summary.hpp"
#include "parallel/threads.hpp"
#include "report/report.hpp"
#include "run/cost_estimate.hpp"
#include "run/lint.hpp"
#include "run/march.hpp"
#include "run/overlap_watch.hpp"
#include "run/penetration_watch.hpp"
#include "run/recorder.hpp"
#include "run/rotation_watch.hpp"
#include "run/simulation.hpp"
#include "run/summarize.hpp"

namespace carom {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

/// The line of progress.
class ShownProgress : public Observer {
 public:
  ShownProgress(double t_end, ProgressMode mode) : progress_(stderr, t_end, mode) {}
  void see(const StepView& view) override {
    if (view.step > 0)
      progress_.update({view.state.t, view.step, view.dt, view.iterations, view.monitor.relative_imbalance()});
  }
  void finish() { progress_.finish(""); }

 private:
  Progress progress_;
};

/// One run: a march and those that watch it.
struct Run {
  Run(const Simulation& simulation, const RunOptions& options)
      : march(simulation),
        recorder(simulation, options.folder),
        penetration(simulation.model()),
        overlap(simulation, march.state()),
        progress(simulation.end(), options.progress),
        rotation(simulation) {
    for (Observer* observer : std::initializer_list<Observer*>{&recorder, &penetration, &overlap, &progress, &rotation})
      march.add(*observer);
  }

  March march;
  Recorder recorder;
  PenetrationWatch penetration;
  OverlapWatch overlap;
  ShownProgress progress;
  RotationWatch rotation;
};

/// Steps to the end, or as far as it goes.
void go(March& march, const Simulation& s, const std::atomic<bool>& stop, Summary& summary) {
  march.start();
  while (!march.at_end() && !march.has_failed()) {
    march.step();
    if (!stop.load() || march.at_end() || march.has_failed()) continue;
    march.leave();
    summary.outcome = Outcome::stopped;
    summary.message =
        fmt::format("interrupted after step {}, t = {:.6g} of {:.6g}", march.steps(), march.state().t, s.end());
    return;
  }
  summary.outcome = march.has_failed() ? Outcome::error : Outcome::good;
  summary.message = march.message();
}

void fill(Summary& summary, const Simulation& simulation, const Run& run) {
  fill(summary, simulation, run.march);
  run.recorder.fill(summary);
  if (!run.march.is_started()) return;
  summary.checks = run.recorder.checks();
  summary.verdict.push_back(run.penetration.item());
  summary.verdict.push_back(run.overlap.item());
  if (!simulation.model().turning_bodies.empty()) summary.verdict.push_back(body_strain_item(run.march.body_strain()));
}

/// To stderr; when that has gone, the results are still in the folder.
template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  std::fputs(terminal_text(fmt::format(format, std::forward<Values>(values)...)).c_str(), stderr);
}

void say_lines(std::string_view kind, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) say("{}: {}\n", kind, line);
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
  say("{}: {}\n", to_string(summary.outcome), summary.message);
  say("{} step{} in {:.3g} s; results in {}, open {}/report.html\n", summary.scheme.steps,
      summary.scheme.steps == 1 ? "" : "s", summary.cost.wall_seconds, folder, folder);
}

/// The case with its mesh file as seen from the results folder, so that the resolved case can be run there.
Case beside(Case given, const std::string& folder) {
  namespace fs = std::filesystem;
  std::string& file = given.mesh.file.value;
  if (!file.empty() && !fs::path(file).is_absolute())
    file = fs::proximate(fs::path(given.file).parent_path() / file, folder).generic_string();
  return given;
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

}  // namespace

ExitCode run_case(const std::string& case_file, const RunOptions& options, const std::atomic<bool>& stop) {
  const Clock::time_point begin = Clock::now();
  set_threads(options.threads);
  const Case given = read_case(case_file);
  const bool quiet = options.progress == ProgressMode::quiet;
  const Simulation simulation(given);
  std::vector<std::string> warnings = lint_warnings(simulation);
  for (std::string& warning : cost_warnings(simulation, options.folder)) warnings.push_back(std::move(warning));
  Run run(simulation, options);
  std::vector<std::string> notes = simulation.notes();
  notes.insert(notes.end(), run.recorder.notes().begin(), run.recorder.notes().end());
  if (!quiet) {
    say_lines("warning", warnings);
    say_lines("note", notes);
  }
  write_file(options.folder + "/case.resolved.toml", resolved_toml(beside(given, options.folder)));
  write_file(options.folder + "/mesh.txt", mesh_summary(simulation.mesh()));
  Summary summary = summary_of(simulation);
  summary.warnings = warnings;
  summary.notes = std::move(notes);
  const double setup_seconds = seconds_since(begin);
  const Clock::time_point stepping = Clock::now();
  summary.outcome = Outcome::error;
  try {
    go(run.march, simulation, stop, summary);
  } catch (const RunError& e) {
    summary.message = e.what();
  } catch (const OutputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    summary.message = "the run could not go on: memory ran out; " + memory_statement(simulation);
  } catch (const std::exception& e) {  // a factorisation that fails
    summary.message = fmt::format("the run could not go on: {}", e.what());
  }
  const double step_seconds = seconds_since(stepping);
  run.progress.finish();
  if (!quiet) {
    for (const std::string& line : run.march.log()) say("{}\n", line);
  }
  summary.notes.insert(summary.notes.end(), run.march.log().begin(), run.march.log().end());
  summary.warnings.insert(summary.warnings.end(), run.rotation.warnings().begin(), run.rotation.warnings().end());
  if (!quiet) say_lines("warning", run.rotation.warnings());
  run.recorder.close();
  fill(summary, simulation, run);
  summary.cost = {
      seconds_since(begin), cpu_seconds(), {{"setup", setup_seconds}, {"steps", step_seconds}}, peak_memory()};
  judge(summary);
  write_summary(options.folder + "/summary.json", summary);
  write_report(options.folder);
  const bool is_good = summary.outcome == Outcome::good;
  if (quiet && !is_good) say_lines("warning", summary.warnings);
  if (!quiet || !is_good) print_verdict(summary, options.folder);
  return exit_code(summary.outcome);
}

}  // namespace carom
