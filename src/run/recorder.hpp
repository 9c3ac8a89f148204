// Writes the results folder while the run goes on.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/csv.hpp"
#include "output/pvd.hpp"
#include "output/results_lock.hpp"
#include "output/vtu.hpp"
#include "run/checks.hpp"
#include "run/contact_fields.hpp"
#include "run/curves.hpp"
#include "run/exact_curves.hpp"
#include "run/key_figures.hpp"
#include "run/obstacle_bodies.hpp"

namespace carom {

/// The curves of a case and what is checked on them; not movable, since the checks refer to the tables.
struct RunTables {
  /// Touches no file. Throws CaseError for probes, checks and exact solutions that do not fit.
  explicit RunTables(const Simulation& simulation);
  RunTables(const RunTables&) = delete;
  RunTables& operator=(const RunTables&) = delete;

  EnergyCurves energy;
  ContactCurves contact;
  ProbeCurves probes;
  std::optional<ExactCurves> exact;
  Checks checks;
};

/// Samples the curves, the checks and the fields at the steps where they are due.
class Recorder : public Observer {
 public:
  /// Prepares the folder and opens its files. Throws OutputError, and CaseError as RunTables does.
  Recorder(const Simulation& simulation, std::string folder);

  /// The last step forces everything out.
  void see(const StepView& view) override { record(view, view.is_last()); }
  void leave(const StepView& view) override { record(view, true); }
  /// Writes the filtered curves and closes all files.
  void close();

  /// Where probes stand.
  const std::vector<std::string>& notes() const { return tables_.probes.notes(); }
  std::vector<CheckSummary> checks() const { return tables_.checks.results(); }
  /// What the summary says of parts, stress and probes.
  void fill(Summary& summary) const;

 private:
  void record(const StepView& view, bool is_last);
  void record_frame(const StepView& view);
  std::string record_obstacles(const StepView& view);
  void write_filtered() const;

  const Simulation& simulation_;
  std::string folder_;
  RunTables tables_;
  KeyFigures figures_;
  ResultsLock lock_;
  CsvFile energy_file_, contact_file_, probes_file_;
  std::optional<CsvFile> exact_file_;
  PvdCollection frames_;
  VtuCells cells_;
  ObstacleBodies obstacles_;
  std::string obstacles_file_;  ///< the last that was written
  long long frame_every_;
  long long last_sample_ = -1, last_frame_ = -1, last_row_ = -1;  ///< steps sampled or written last
  std::vector<std::vector<double>> filtered_rows_;  ///< rows of probes.csv, kept when a probe asks for a filter
};

}  // namespace carom
