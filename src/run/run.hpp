// One run: from a simulation to a verdict, in a results folder or without one.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "march/snapshot.hpp"
#include "output/found_checkpoint.hpp"
#include "output/results_lock.hpp"
#include "output/summary.hpp"
#include "record/checkpoints.hpp"
#include "run/watched_march.hpp"

namespace carom {

/// A results folder that is held, and what is found in it to go on from.
struct FoundRun {
  std::unique_ptr<ResultsLock> lock;
  FoundCheckpoint checkpoint;
  std::string resolved;  ///< the text of the case
  Case given;
};

/// Holds a folder and reads the case and the last checkpoint of it. Throws CheckpointError where there is nothing to go
/// on from, and OutputError where another run holds it.
FoundRun find_run(const std::string& folder);

/// What the command line and programs that use Carom as a library step: the march with those that watch it, the results
/// folder with its checkpoints, and how it all ends. Runs know nothing of each other. Not movable.
class Run {
 public:
  using Clock = std::chrono::steady_clock;
  /// Since when the cost of a run is counted: the clock, and the processor time of the process.
  struct Begin {
    Clock::time_point time = Clock::now();
    double cpu_seconds = cpu_seconds_of_process();
  };
  static double cpu_seconds_of_process();

  /// Touches no file yet. folder: of the results, "" for none; begin: since when the cost of the run is counted. The
  /// simulation outlives the run. Throws CaseError for what the run would not take. That a case does not begin from its
  /// own folder (refuse_own_folder) is asked before it is built.
  Run(const Simulation& simulation, std::string folder, Begin begin);
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// From the first step on it sees every step, after those that are there already; it outlives the run.
  void add(Observer& observer);
  /// What reading the case has to say, before the notes of the simulation. Precondition: not begun.
  void note(std::vector<std::string> notes) { reading_notes_ = std::move(notes); }
  /// Keeps the rows of all curves in memory, for those that ask for them and for a folder that is named at the end.
  void keep_rows();

  /// Makes the results folder ready and holds it; without a folder nothing but the warnings of the case is made. Throws
  /// OutputError.
  void begin();
  /// Takes over what has been found in the folder; end: another end than that of the case. Throws CheckpointError,
  /// before anything has been changed in the folder.
  void go_on(FoundRun found, std::optional<double> end);
  /// Names a results folder for a run that has had none: what has been kept is written there. Throws OutputError.
  void begin_folder(const std::string& folder);

  /// Shows the initial state where the run has not started, or makes a step; writes a checkpoint where one is due. What
  /// goes wrong ends the run: outcome and message say how. Throws OutputError. Precondition: not over.
  void step();
  /// Ends the run where it is, with a checkpoint. Precondition: started, not over.
  void interrupt();
  /// No step can follow: at the end, failed or interrupted.
  bool is_over() const { return outcome_ != Outcome::good || (march().is_started() && march().at_end()); }
  /// So far; `good` until something else is known. message: why it is not.
  Outcome outcome() const { return outcome_; }
  const std::string& message() const { return message_; }

  /// Closes the files, judges, and writes summary and report where there is a folder, which is let go of. To be called
  /// once. Throws OutputError.
  Summary finish();

  /// The march, the curves and the watches as they are now. Precondition: started.
  std::shared_ptr<const Snapshot> save();
  /// Everything as it was then; the files of the folder, too. Throws CheckpointError where the snapshot is of another
  /// case.
  void restore(const Snapshot& snapshot);

  const Simulation& simulation() const { return simulation_; }
  const WatchedMarch& watched() const { return *watched_; }
  const March& march() const { return watched_->march; }
  March& march() { return watched_->march; }
  const std::string& folder() const { return folder_; }

 private:
  std::unique_ptr<WatchedMarch> make_watched() const;
  const CheckpointInfo& origin();
  void open_folder();
  void keep_checkpoint();
  void write_checkpoint();
  void fail(std::string message);
  void fill_in(Summary& summary) const;

  const Simulation& simulation_;
  std::string folder_;
  Begin begin_;
  std::vector<Observer*> observers_;
  bool keeps_rows_ = false;
  std::vector<std::string> reading_notes_;
  std::unique_ptr<ResultsLock> lock_;
  std::unique_ptr<WatchedMarch> watched_;
  std::optional<Checkpoints> checkpoints_;
  std::optional<CheckpointInfo> origin_;
  Outcome outcome_ = Outcome::good;
  std::string message_;
  std::optional<double> setup_seconds_;
  double step_seconds_ = 0.0;
};

}  // namespace carom
