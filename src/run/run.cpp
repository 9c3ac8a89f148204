#include "run/run.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "advise/cost_estimate.hpp"
#include "advise/lint.hpp"
#include "advise/locking.hpp"
#include "base/checksum.hpp"
#include "base/errors.hpp"
#include "base/version.hpp"
#include "build/build_mesh.hpp"
#include "build/digests.hpp"
#include "build/initial_state.hpp"
#include "casefile/read_case.hpp"
#include "casefile/resolved_case.hpp"
#include "math/called_function.hpp"
#include "mesh/mesh_summary.hpp"
#include "output/file_writer.hpp"
#include "output/found_checkpoint.hpp"
#include "output/results_folder.hpp"
#include "parallel/ranks.hpp"
#include "record/frame_plan.hpp"
#include "report/report.hpp"
#include "run/summarize.hpp"

namespace carom {

namespace {

double seconds_since(Run::Clock::time_point begin) {
  return std::chrono::duration<double>(Run::Clock::now() - begin).count();
}

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

/// The case with its files as seen from the results folder, so that the resolved case can be run there: mesh and
/// libraries stay where they are, an initial state has been copied (keep_state).
Case beside(Case given, const std::string& folder) {
  namespace fs = std::filesystem;
  const auto see_from_there = [&](std::string& file) {
    if (!file.empty() && !fs::path(file).is_absolute())
      file = fs::proximate(fs::path(given.file).parent_path() / file, folder).generic_string();
  };
  if (given.mesh.text)
    given.mesh.file.value = given_mesh_file;
  else
    see_from_there(given.mesh.file.value);
  for (CaseMaterial& material : given.materials) see_from_there(material.library.value);
  if (given.initial_state) given.initial_state->from.value = kept_state_folder;
  return given;
}

/// What the checkpoints of a run are of.
CheckpointInfo origin_of(const Simulation& simulation, const std::string& resolved_case) {
  const std::size_t nodes = given_nodes(simulation.given(), simulation.mesh());
  return {version(),
          compiler(),
          std::string(name(chosen_isa())),
          checksum(resolved_case),
          mesh_digest(simulation.mesh()),
          bodies_digest(simulation.model(), nodes),
          static_cast<long long>(nodes)};
}

std::string read_text(const std::string& path) {
  const std::ifstream file(path, std::ios::binary);
  if (!file) throw CheckpointError(path, "it is missing, and a run cannot go on without it");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// After what may have gone wrong on this rank alone: the others wait for its messages, and only the end of the job
/// frees them.
void end_other_ranks(const std::string& message) {
  if (ranks().count() > 1) throw std::runtime_error(message);
}

}  // namespace

FoundRun find_run(const std::string& folder) {
  if (!std::filesystem::is_directory(folder)) throw CheckpointError(folder, "there is no such folder");
  FoundRun found;
  if (ranks().own() == 0) found.lock = std::make_unique<ResultsLock>(folder);  // for all of them
  found.checkpoint = find_checkpoint(folder);
  const std::string case_file = folder + "/" + resolved_case_file;
  found.resolved = read_text(case_file);
  const CheckpointInfo& its = found.checkpoint.info;
  refuse_others(found.checkpoint, {version(), compiler(), its.isa, checksum(found.resolved), its.mesh_digest});
  found.given = read_case(case_file);
  return found;
}

double Run::cpu_seconds_of_process() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Run::Run(const Simulation& simulation, std::string folder, Begin begin)
    : simulation_(simulation), folder_(std::move(folder)), begin_(begin) {
  watched_ = make_watched();
}

/// A march at its beginning, seen by all that are to see it.
std::unique_ptr<WatchedMarch> Run::make_watched() const {
  auto made = std::make_unique<WatchedMarch>(simulation_, folder_);
  if (keeps_rows_) made->recorder.keep_rows();
  for (Observer* observer : observers_) made->march.add(*observer);
  return made;
}

void Run::add(Observer& observer) {
  observers_.push_back(&observer);
  watched_->march.add(observer);
}

void Run::keep_rows() {
  keeps_rows_ = true;
  watched_->recorder.keep_rows();
}

void Run::begin() {
  watched_->case_file = simulation_.given().file;
  watched_->warnings = lint_warnings(simulation_);
  if (ranks().own() == 0)  // The first rank alone writes the warnings, and looking at columns of cells takes memory.
    for (Doubt& doubt : locking_doubts(simulation_)) {
      watched_->doubts.push_back(std::move(doubt.brief));
      watched_->warnings.push_back(std::move(doubt.warning));
    }
  for (std::string& warning : cost_warnings(simulation_, folder_)) watched_->warnings.push_back(std::move(warning));
  watched_->notes = reading_notes_;
  watched_->notes.insert(watched_->notes.end(), simulation_.notes().begin(), simulation_.notes().end());
  const std::vector<std::string>& places = watched_->recorder.notes();
  watched_->notes.insert(watched_->notes.end(), places.begin(), places.end());
  malloc_trim(0);  // what the set-up alone needed goes back to the system
  if (folder_.empty()) return;
  if (std::string note = frame_note(simulation_); !note.empty()) watched_->notes.push_back(std::move(note));
  lock_ = std::make_unique<ResultsLock>(folder_);
  watched_->recorder.begin();
  open_folder();
}

/// What stands in the folder beside the curves, and the checkpoints to come.
void Run::open_folder() {
  if (simulation_.taken()) keep_state(*simulation_.taken(), folder_);
  if (const auto& text = simulation_.given().mesh.text) write_file(folder_ + "/" + given_mesh_file, *text);
  const std::string resolved = resolved_toml(beside(simulation_.given(), folder_));
  write_file(folder_ + "/" + resolved_case_file, resolved);
  write_file(folder_ + "/mesh.txt", mesh_summary(simulation_.mesh()));
  checkpoints_.emplace(folder_, simulation_.given().output, origin_of(simulation_, resolved));
}

void Run::begin_folder(const std::string& folder) {
  refuse_own_folder(simulation_.given(), folder);
  lock_ = std::make_unique<ResultsLock>(folder);
  folder_ = folder;
  watched_->recorder.begin_in(folder);
  if (march().is_started()) watched_->recorder.write_fields(march().view());
  open_folder();
  if (march().is_started() && !march().has_failed()) write_checkpoint();
}

void Run::go_on(FoundRun found, std::optional<double> end) {
  lock_ = std::move(found.lock);
  const CheckpointInfo origin = origin_of(simulation_, found.resolved);
  refuse_others(found.checkpoint, origin);
  read_checkpoint(found.checkpoint.path, [&](Archive& archive) { fields(archive, *watched_); });
  if (end) {
    try {
      march().prolong(*end);
    } catch (const std::invalid_argument& e) {
      throw CheckpointError(folder_, fmt::format("--end asks for {}", e.what()));
    }
  } else if (march().at_end() && std::filesystem::exists(folder_ + "/report.html")) {
    throw CheckpointError(
        folder_,
        fmt::format("the run has come to its end, t = {:.9g}; a later one can be given with --end", march().state().t));
  }
  if (found.checkpoint.info.isa != origin.isa)
    watched_->notes.push_back(fmt::format(
        "from t = {:.6g} on the kernels take the instruction set {} after {}: the last digits of what follows "
        "are others than those of a run in one piece; CAROM_ISA={} has them, where the machine has it",
        march().state().t, origin.isa, found.checkpoint.info.isa, found.checkpoint.info.isa));
  on_any_rank(false);  // all have read what is now changed
  if (folder_.empty()) return;
  watched_->recorder.go_on();
  remove_later(folder_, found.checkpoint);
  checkpoints_.emplace(folder_, simulation_.given().output, origin);
  write_checkpoint();  // a later end holds from now on
}

/// Where one is due on the rank that writes them.
void Run::keep_checkpoint() {
  if (!on_any_rank(checkpoints_ && (march().at_end() || checkpoints_->is_due(march().steps())))) return;
  march().with_all_of_it([&] {
    if (checkpoints_) write_checkpoint();
  });
}

void Run::write_checkpoint() {
  watched_->recorder.wait();  // before this thread holds HDF5, which the frame needs
  checkpoints_->write(march().steps(), march().state().t, [&](Archive& archive) { fields(archive, *watched_); });
}

void Run::fail(std::string message) {
  outcome_ = Outcome::error;
  message_ = std::move(message);
}

void Run::step() {
  if (!setup_seconds_) setup_seconds_ = seconds_since(begin_.time);
  const Clock::time_point stepping = Clock::now();
  try {
    if (!march().is_started())
      march().start();
    else
      march().step();
    if (march().has_failed())
      fail(march().message());
    else if (march().steps() > 0)
      keep_checkpoint();
  } catch (const RunError& e) {
    fail(e.what());
    if (march().is_started()) march().leave();  // what there is to look at where it went wrong
  } catch (const OutputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    fail("the run could not go on: memory ran out; " + memory_statement(simulation_));
    end_other_ranks(message_);
  } catch (const std::exception& e) {  // a factorisation that fails
    fail(fmt::format("the run could not go on: {}", e.what()));
    end_other_ranks(message_);
    if (march().is_started()) march().leave();
  } catch (const CallFailure&) {
    fail("the run could not go on: a function of the case has failed");
    throw;
  }
  step_seconds_ += seconds_since(stepping);
}

void Run::interrupt() {
  march().with_all_of_it([&] {
    if (checkpoints_) write_checkpoint();
    march().leave();
  });
  outcome_ = Outcome::stopped;
  message_ =
      fmt::format("interrupted after step {}, t = {:.6g} of {:.6g}", march().steps(), march().state().t, march().end());
}

void Run::fill_in(Summary& summary) const {
  fill(summary, simulation_, march());
  watched_->recorder.fill(summary);
  if (!march().is_started()) return;
  summary.checks = watched_->recorder.checks();
  summary.verdict.push_back(watched_->watches.penetration.item());
  summary.verdict.push_back(watched_->watches.overlap.item());
  if (const std::optional<VerdictItem> item = watched_->watches.folds.item()) summary.verdict.push_back(*item);
  if (any_free(simulation_.model().turning_bodies)) summary.verdict.push_back(body_strain_item(march().body_strain()));
}

Summary Run::finish() {
  Summary summary = summary_of(simulation_);
  summary.case_info.file = watched_->case_file;
  summary.warnings = watched_->warnings;
  summary.doubts = watched_->doubts;
  if (!watched_->watches.folds.warnings().empty()) summary.doubts.emplace_back("a cell has folded");
  std::vector<Doubt> seen_doubts = watched_->law_depth.doubts(simulation_);
  if (std::optional<Doubt> doubt = watched_->stroke.doubt()) seen_doubts.push_back(std::move(*doubt));
  for (Doubt& doubt : seen_doubts) {
    summary.doubts.push_back(std::move(doubt.brief));
    summary.warnings.push_back(std::move(doubt.warning));
  }
  summary.notes = watched_->notes;
  summary.outcome = outcome_;
  summary.message = message_;
  for (std::string& line : march().log()) summary.notes.push_back(std::move(line));
  for (const auto* seen : {&watched_->watches.rotation.warnings(), &watched_->watches.folds.warnings()})
    summary.warnings.insert(summary.warnings.end(), seen->begin(), seen->end());
  for (std::string& warning : watched_->watches.artificial.warnings()) summary.warnings.push_back(std::move(warning));
  watched_->recorder.close();
  fill_in(summary);
  summary.cost = {seconds_since(begin_.time),
                  cpu_seconds_of_process() - begin_.cpu_seconds,
                  {{"setup", setup_seconds_.value_or(seconds_since(begin_.time))}, {"steps", step_seconds_}},
                  peak_memory(),
                  ranks().count(),
                  ranks().sent().messages,
                  ranks().sent().values * sizeof(double)};
  judge(summary);
  if (!folder_.empty()) {
    write_summary(folder_ + "/summary.json", summary);
    write_report(folder_);
  }
  lock_.reset();
  return summary;
}

/// What snapshots are of.
const CheckpointInfo& Run::origin() {
  if (!origin_) origin_ = origin_of(simulation_, resolved_toml(simulation_.given()));
  return *origin_;
}

std::shared_ptr<const Snapshot> Run::save() {
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->origin = origin();
  snapshot->origin.step = march().steps();
  snapshot->origin.time = march().state().t;
  MemoryWriter archive(snapshot->values);
  fields(archive, *watched_);
  rows(archive, watched_->recorder);
  return snapshot;
}

void Run::restore(const Snapshot& snapshot) {
  const CheckpointInfo& own = origin();
  if (snapshot.origin.case_digest != own.case_digest || snapshot.origin.mesh_digest != own.mesh_digest)
    throw CheckpointError("snapshot", "it is of another case or mesh");
  std::unique_ptr<WatchedMarch> fresh = make_watched();
  MemoryReader archive(snapshot.values);
  try {
    fields(archive, *fresh);
    rows(archive, fresh->recorder);
  } catch (const ArchiveError& e) {
    throw CheckpointError("snapshot", e.what());
  }
  watched_.reset();  // lets go of its files
  watched_ = std::move(fresh);
  outcome_ = Outcome::good;
  message_.clear();
  if (folder_.empty()) return;
  watched_->recorder.rewrite();
  remove_later(folder_, {});
  write_checkpoint();
}

}  // namespace carom
