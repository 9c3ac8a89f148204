// Writes the results folder while the run goes on.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "output/background.hpp"
#include "output/csv.hpp"
#include "output/frame_format.hpp"
#include "record/checks.hpp"
#include "record/contact_fields.hpp"
#include "record/contact_slip.hpp"
#include "record/curves.hpp"
#include "record/exact_curves.hpp"
#include "record/frame_plan.hpp"
#include "record/key_figures.hpp"
#include "record/obstacle_bodies.hpp"
#include "record/part_curves.hpp"

namespace carom {

/// The curves of a case and what is checked on them; not movable, since the checks refer to the tables.
struct RunTables {
  /// Touches no file. Throws CaseError for probes, checks and exact solutions that do not fit.
  explicit RunTables(const Simulation& simulation);
  RunTables(const RunTables&) = delete;
  RunTables& operator=(const RunTables&) = delete;

  EnergyCurves energy;
  ContactCurves contact;
  PartCurves parts;
  ProbeCurves probes;
  std::optional<ExactCurves> exact;
  Checks checks;
};

/// Samples the curves, the checks and the fields at the steps where they are due. Files of fields are written beside
/// the computation, one at a time; what goes wrong there is thrown by the next call.
class Recorder : public Observer {
 public:
  /// Touches no file yet. Throws CaseError as RunTables does.
  Recorder(const Simulation& simulation, std::string folder);

  /// Keeps the rows of the tables in memory from here on, beside the files or without any.
  void keep_rows();
  /// Prepares the folder and opens its files; rows that have been kept are written first. Without it, nothing is
  /// written. Throws OutputError.
  void begin();
  /// The same in another folder, for a recorder that has had none.
  void begin_in(std::string folder);
  /// Returns when the frame that is being written is on disk.
  void wait() { writer_.finish(); }
  /// Writes the fields of this instant.
  void write_fields(const StepView& view) { record_frame(view); }
  /// Opens the files of a folder where its memory, which has been read, has left them; what was written later is cut
  /// off or removed. Throws OutputError, before anything is changed where files are missing or too short.
  void go_on();
  /// Makes the folder what the memory says, which has been read and holds the rows: tables are written anew, later
  /// frames removed. Throws OutputError.
  void rewrite();

  /// The last step forces everything out.
  void see(const StepView& view) override { record(view, view.is_last()); }
  void leave(const StepView& view) override { record(view, true); }
  /// Writes the filtered curves and closes all files.
  void close();

  /// One table: the columns, time first, and the rows that have been kept, one after the other.
  struct KeptTable {
    const CurveTable& table;
    std::span<const double> values;
  };
  /// energy, contact, probes, parts, and exact where there is one; no rows without keep_rows.
  std::vector<KeptTable> kept() const;
  /// What contact.csv says of this instant.
  const CurveTable& contact() const { return tables_.contact.table(); }
  /// Of contact_slip, by node; empty where the case does not ask for it.
  std::span<const double> slip() const { return slip_.path(); }
  /// The rows, for snapshots.
  template <class A>
  friend void rows(A& archive, Recorder& x) {
    archive.each("rows", x.rows_);
  }

  /// Where probes stand.
  const std::vector<std::string>& notes() const { return tables_.probes.notes(); }
  std::vector<CheckSummary> checks() const { return tables_.checks.results(); }
  /// What the summary says of parts, stress and probes.
  void fill(Summary& summary) const;

 private:
  template <class A>
  friend void fields(A& archive, Recorder& x) {
    if (x.files_) x.keep_places();
    archive("places", x.places_);
    archive("frames", x.frames_);
    archive("contact", x.tables_.contact);
    archive("checks", x.tables_.checks);
    archive("figures", x.figures_);
    if (x.slip_.is_wanted()) archive("slip", x.slip_);
    archive("obstacles_file", x.obstacles_file_);
    archive("last_sample", x.last_sample_);
    archive("last_time", x.last_time_);
    archive("last_frame", x.last_frame_);
    archive("last_row", x.last_row_);
  }

  struct Rows {
    std::vector<double> values;
    template <class A>
    friend void fields(A& archive, Rows& x) {
      archive("values", x.values);
    }
  };
  struct OpenTable {
    CsvFile file;
    const CurveTable& table;
  };
  /// While they are open; tables in the order of table_files().
  struct Files {
    std::vector<OpenTable> tables;
    FrameIndex frames;
    std::unique_ptr<FrameWriter> bodies{}, obstacles{};  ///< from the first frame on
  };
  struct TableFile {
    std::string path, what;
    const CurveTable& table;
  };
  std::vector<TableFile> table_files() const;
  void open_files(const std::vector<FrameEntry>& frames);
  void add_row();
  void keep_places();
  void record(const StepView& view, bool is_last);
  void record_frame(const StepView& view);
  std::string record_obstacles(const StepView& view);
  void write_filtered() const;
  void write_shock();

  const Simulation& simulation_;
  std::string folder_;
  RunTables tables_;
  KeyFigures figures_;
  ContactSlip slip_;
  std::optional<Files> files_;       ///< none without a folder
  std::vector<Rows> rows_;           ///< of each table, where they are kept
  std::vector<std::size_t> places_;  ///< how long the tables were at the last checkpoint
  std::vector<FrameEntry> frames_;   ///< which there were then
  const FrameFormat& format_;
  ObstacleBodies obstacles_;
  std::string obstacles_file_;  ///< the last that was written
  FrameClock clock_;
  long long last_sample_ = -1, last_frame_ = -1, last_row_ = -1;  ///< steps sampled or written last
  double last_time_ = 0.0;                                        ///< of last_sample_
  std::vector<ShockSummary> shock_;                               ///< once the tables are closed
  Background writer_;                                             ///< last: it waits before the others go
};

}  // namespace carom
