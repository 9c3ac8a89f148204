#include "run/run_case.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <new>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "base/checksum.hpp"
#include "base/errors.hpp"
#include "base/terminal_text.hpp"
#include "base/version.hpp"
#include "casefile/read_case.hpp"
#include "casefile/resolved_case.hpp"
#include "mesh/mesh_summary.hpp"
#include "output/file_writer.hpp"
#include "output/results_folder.hpp"
#include "output/results_lock.hpp"
#include "output/summary.hpp"
#include "parallel/threads.hpp"
#include "report/report.hpp"
#include "run/build_mesh.hpp"
#include "run/checkpoints.hpp"
#include "run/cost_estimate.hpp"
#include "run/initial_state.hpp"
#include "run/lint.hpp"
#include "run/march.hpp"
#include "run/overlap_watch.hpp"
#include "run/penetration_watch.hpp"
#include "run/recorder.hpp"
#include "run/rotation_watch.hpp"
#include "run/simulation.hpp"
#include "run/summarize.hpp"
#include "translate/translate_deck.hpp"

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
  ShownProgress(double t_end, ProgressMode mode) : progress_(stderr, t_end, mode), mode_(mode) {}
  /// Another end.
  void go_to(double t_end) { progress_ = Progress(stderr, t_end, mode_); }
  void see(const StepView& view) override {
    if (view.step > 0)
      progress_.update({view.state.t, view.step, view.dt, view.iterations, view.monitor.relative_imbalance()});
  }
  void finish() { progress_.finish(""); }

 private:
  Progress progress_;
  ProgressMode mode_;
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
  template <class A>
  friend void fields(A& archive, Run& x) {
    archive("march", x.march);
    archive("recorder", x.recorder);
    archive("penetration", x.penetration);
    archive("overlap", x.overlap);
    archive("rotation", x.rotation);
    archive("case_file", x.case_file);
    archive("warnings", x.warnings);
    archive("notes", x.notes);
  }

  March march;
  Recorder recorder;
  PenetrationWatch penetration;
  OverlapWatch overlap;
  ShownProgress progress;
  RotationWatch rotation;
  std::string case_file;                     ///< as the user named it
  std::vector<std::string> warnings, notes;  ///< of the case, before the first step
};

/// Steps to the end, or as far as it goes. What stops it leaves a checkpoint of the run that knows of no stop.
void go(Run& run, Checkpoints& checkpoints, const std::atomic<bool>& stop, Summary& summary) {
  March& march = run.march;
  const auto write_checkpoint = [&] {
    checkpoints.write(march.steps(), march.state().t, [&](Archive& archive) { fields(archive, run); });
  };
  if (!march.is_started())
    march.start();
  else
    write_checkpoint();  // a later end holds from now on
  while (!march.at_end()) {
    march.step();
    if (march.has_failed()) break;
    const bool is_stopped = stop.load() && !march.at_end();
    if (is_stopped || march.at_end() || checkpoints.is_due(march.steps())) write_checkpoint();
    if (!is_stopped) continue;
    march.leave();
    summary.outcome = Outcome::stopped;
    summary.message =
        fmt::format("interrupted after step {}, t = {:.6g} of {:.6g}", march.steps(), march.state().t, march.end());
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

/// The case with its files as seen from the results folder, so that the resolved case can be run there: the mesh stays
/// where it is, an initial state has been copied (keep_state).
Case beside(Case given, const std::string& folder) {
  namespace fs = std::filesystem;
  std::string& file = given.mesh.file.value;
  if (!file.empty() && !fs::path(file).is_absolute())
    file = fs::proximate(fs::path(given.file).parent_path() / file, folder).generic_string();
  if (given.initial_state) given.initial_state->from.value = kept_state_folder;
  return given;
}

/// What the checkpoints of a run are of.
CheckpointInfo origin_of(const Simulation& simulation, const std::string& resolved_case) {
  const std::size_t nodes = given_nodes(simulation.given(), simulation.mesh());
  return {version(),
          compiler(),
          std::string(name(simulation.solid().isa())),
          checksum(resolved_case),
          mesh_digest(simulation.mesh()),
          bodies_digest(simulation.model(), nodes),
          static_cast<long long>(nodes)};
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
ExitCode conduct(Run& run, const Simulation& simulation, const RunOptions& options, const CheckpointInfo& origin,
                 Clock::time_point begin, const std::atomic<bool>& stop) {
  const bool quiet = options.progress == ProgressMode::quiet;
  Summary summary = summary_of(simulation);
  summary.case_info.file = run.case_file;
  summary.warnings = run.warnings;
  summary.notes = run.notes;
  const double setup_seconds = seconds_since(begin);
  const Clock::time_point stepping = Clock::now();
  summary.outcome = Outcome::error;
  try {
    Checkpoints checkpoints(options.folder, simulation.given().output, origin);
    go(run, checkpoints, stop, summary);
  } catch (const RunError& e) {
    summary.message = e.what();
    if (run.march.is_started()) run.march.leave();  // what there is to look at where it went wrong
  } catch (const OutputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    summary.message = "the run could not go on: memory ran out; " + memory_statement(simulation);
  } catch (const std::exception& e) {  // a factorisation that fails
    summary.message = fmt::format("the run could not go on: {}", e.what());
    if (run.march.is_started()) run.march.leave();
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
  if (summary.outcome == Outcome::stopped) say("carom resume {} goes on from there\n", options.folder);
  return exit_code(summary.outcome);
}

std::string read_text(const std::string& path) {
  const std::ifstream file(path, std::ios::binary);
  if (!file) throw CheckpointError(path, "it is missing, and a run cannot go on without it");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

ExitCode run_case(const std::string& case_file, const RunOptions& options, const std::atomic<bool>& stop) {
  const Clock::time_point begin = Clock::now();
  set_threads(options.threads);
  const ReadCase read = read_case_or_deck(case_file, options.accepted);
  const Case& given = read.given;
  refuse_own_folder(given, options.folder);
  const Simulation simulation(given);
  Run run(simulation, options);
  run.case_file = simulation.given().file;
  run.warnings = lint_warnings(simulation);
  for (std::string& warning : cost_warnings(simulation, options.folder)) run.warnings.push_back(std::move(warning));
  run.notes = read.notes;
  run.notes.insert(run.notes.end(), simulation.notes().begin(), simulation.notes().end());
  run.notes.insert(run.notes.end(), run.recorder.notes().begin(), run.recorder.notes().end());
  const ResultsLock lock(options.folder);
  run.recorder.begin();
  if (options.progress != ProgressMode::quiet) {
    say_lines("warning", run.warnings);
    say_lines("note", run.notes);
  }
  if (simulation.taken()) keep_state(*simulation.taken(), options.folder);
  const std::string resolved = resolved_toml(beside(simulation.given(), options.folder));
  write_file(options.folder + "/" + resolved_case_file, resolved);
  write_file(options.folder + "/mesh.txt", mesh_summary(simulation.mesh()));
  return conduct(run, simulation, options, origin_of(simulation, resolved), begin, stop);
}

ExitCode resume_case(const RunOptions& options, std::optional<double> end, const std::atomic<bool>& stop) {
  const Clock::time_point begin = Clock::now();
  set_threads(options.threads);
  if (!std::filesystem::is_directory(options.folder)) throw CheckpointError(options.folder, "there is no such folder");
  const ResultsLock lock(options.folder);
  const FoundCheckpoint found = find_checkpoint(options.folder);
  const std::string case_file = options.folder + "/" + resolved_case_file, resolved = read_text(case_file);
  refuse_others(found, {version(), compiler(), found.info.isa, checksum(resolved), found.info.mesh_digest});
  const Simulation simulation(read_case(case_file));
  const CheckpointInfo origin = origin_of(simulation, resolved);
  refuse_others(found, origin);
  Run run(simulation, options);
  read_checkpoint(found.path, [&](Archive& archive) { fields(archive, run); });
  if (end) {
    try {
      run.march.prolong(*end);
    } catch (const std::invalid_argument& e) {
      throw CheckpointError(options.folder, fmt::format("--end asks for {}", e.what()));
    }
  } else if (run.march.at_end() && std::filesystem::exists(options.folder + "/report.html")) {
    throw CheckpointError(options.folder,
                          fmt::format("the run has come to its end, t = {:.9g}; a later one can be given with --end",
                                      run.march.state().t));
  }
  run.progress.go_to(run.march.end());
  run.recorder.go_on();
  remove_later(options.folder, found);
  if (!found.passed_over.empty()) say("warning: {}\n", found.passed_over);
  if (options.progress != ProgressMode::quiet)
    say("from step {}, t = {:.6g}, on ({})\n", found.info.step, found.info.time, found.path);
  return conduct(run, simulation, options, origin, begin, stop);
}

}  // namespace carom
