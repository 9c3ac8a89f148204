// A run as Python sees it.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "python/prepared_case.hpp"
#include "run/run.hpp"

namespace carom::python {

/// A run that has failed, in its own words, which say where it was.
struct FailedRun : std::runtime_error {
  FailedRun(int at_step, double at_time, const std::string& message)
      : std::runtime_error(message), step(at_step), time(at_time) {}

  int step;
  double time;
};

/// Steps a Run with the lock of the interpreter let go of. Its files, locks and threads go with it.
class PythonRun {
 public:
  /// From the start of a case; the initial state is there then.
  PythonRun(const PreparedCase& prepared, const std::string& folder, int threads);
  /// From the last checkpoint of a folder.
  PythonRun(const std::string& folder, std::optional<double> end, int threads);
  ~PythonRun();
  PythonRun(const PythonRun&) = delete;
  PythonRun& operator=(const PythonRun&) = delete;

  /// At most `count` steps (-1: any number), to the first end of a step at or after `time`, or to the end.
  void advance(double time, long long count);
  /// Has the method _show called after every so-many-th step, and the last. Who looks on stands in the object of
  /// Python, where its collector sees circles.
  void observe(long long every);
  /// One of those that want to see every so many steps wants to no more.
  void forget(long long every);
  std::shared_ptr<const Snapshot> save();
  void restore(const Snapshot& snapshot);
  /// Closes the run where it is; folder: of the results, if it has had none. The text of the summary.
  std::string close(const std::string& folder);

  /// These may be asked while another thread steps; the others throw then.
  double time() const { return time_.load(); }
  long long steps() const { return steps_.load(); }
  bool is_closed() const { return is_closed_; }
  double end() const { return quiet().march().end(); }
  bool is_over() const { return quiet().is_over(); }
  double last_dt() const { return quiet().march().view().dt; }
  const std::vector<std::string>& warnings() const { return run_->watched().warnings; }
  const std::vector<std::string>& notes() const { return run_->watched().notes; }
  const std::string& folder() const { return run_->folder(); }

  /// q, v or a of the nodes of the mesh, without a copy; kept as they are now when the run steps.
  py::array values(std::size_t which);
  std::shared_ptr<const Mesh> mesh() const;
  /// Columns and rows of a table so far.
  py::tuple table(std::size_t which) const;
  /// What contact.csv says of this instant.
  py::tuple contact() const;
  /// Names of the fields that can be asked for, and of contact_slip where the case asks for it.
  std::vector<std::string> fields() const;
  /// A field of this instant, a row for each node of the mesh or each cell. Precondition: one of fields().
  py::array field(const std::string& name);
  /// Block, position in it and part of each cell, in the order of fields.
  py::tuple cells() const;
  /// The comment of tables that names the units.
  std::string units() const;
  std::vector<std::string> contact_names() const;
  /// What a contact exerts on nodes of the mesh: nodes, forces. Precondition: one of contact_names().
  py::tuple contact_at_nodes(const std::string& name);

 private:
  /// What arrays look at: the state's own vector, or, once the run has stepped, what it was.
  struct Lease {
    std::vector<double> kept;
  };
  class Busy;

  void begin();
  void refuse_closed() const;
  /// The run, which nobody steps now. Throws where somebody does.
  const Run& quiet() const;
  void note_place();
  void advance_quietly(double time, long long& count);
  bool has_arrived(double time, long long count) const;
  bool is_watched() const;
  void show();
  void settle_leases();
  void throw_failure() const;

  std::shared_ptr<const Simulation> simulation_;
  std::unique_ptr<Run> run_;
  int threads_;
  std::array<std::weak_ptr<Lease>, 3> leases_;
  std::vector<long long> watched_every_;
  std::atomic<double> time_{0.0};
  std::atomic<long long> steps_{0};
  bool is_busy_ = false, is_closed_ = false;
};

}  // namespace carom::python
