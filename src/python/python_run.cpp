#include "python/python_run.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "build/build_mesh.hpp"
#include "build/initial_state.hpp"
#include "output/units.hpp"
#include "python/arrays.hpp"
#include "python/callables.hpp"
#include "python/compute.hpp"
#include "record/contact_at_nodes.hpp"
#include "record/field_values.hpp"

namespace carom::python {

namespace {

constexpr std::array<std::vector<double> State::*, 3> viewed{&State::q, &State::v, &State::a};

/// Runs of this process; threads that wait for loops go with the last.
std::atomic<int> live_runs{0};

}  // namespace

/// While the run steps, nobody else may: neither another thread nor a function that it calls.
class PythonRun::Busy {
 public:
  explicit Busy(bool& flag) : flag_(flag) {
    if (flag) throw std::runtime_error("this run is in the middle of a step");
    flag = true;
  }
  ~Busy() { flag_ = false; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  bool& flag_;
};

PythonRun::PythonRun(const PreparedCase& prepared, const std::string& folder, int threads) : threads_(threads) {
  if (threads < 0) throw py::value_error("threads: a number of cores, or 0 for all");
  const Run::Begin begun;
  if (!folder.empty()) refuse_own_folder(prepared.given, folder);
  simulation_ = build(prepared, threads);
  {
    const py::gil_scoped_release release;
    const Computing computing(threads);
    run_ = with_errors_of_callables([&] { return std::make_unique<Run>(*simulation_, folder, begun); });
    run_->keep_rows();
    run_->note(prepared.notes);
    run_->begin();
  }
  begin();
}

PythonRun::PythonRun(const std::string& folder, std::optional<double> end, int threads) : threads_(threads) {
  const Run::Begin begun;
  {
    const py::gil_scoped_release release;
    const Computing computing(threads);
    FoundRun found = find_run(folder);
    simulation_ = std::make_shared<const Simulation>(found.given);
    run_ = std::make_unique<Run>(*simulation_, folder, begun);
    run_->keep_rows();
    run_->go_on(std::move(found), end);
  }
  note_place();
  ++live_runs;
}

/// The initial state. A run that cannot start is closed: its folder says why.
void PythonRun::begin() {
  ++live_runs;
  try {
    long long count = 1;
    advance_quietly(0.0, count);
    if (run_->outcome() == Outcome::good) return;
    const std::string message = run_->message();
    close("");
    throw FailedRun(0, 0.0, message);
  } catch (...) {
    --live_runs;
    throw;
  }
}

PythonRun::~PythonRun() {
  if (run_) settle_leases();
  const py::gil_scoped_release release;
  const Computing computing(threads_);
  run_.reset();  // waits for files that are being written
  simulation_.reset();
  if (--live_runs == 0) release_threads();
}

void PythonRun::refuse_closed() const {
  if (is_closed_) throw std::runtime_error("this run has been finished");
}

const Run& PythonRun::quiet() const {
  if (is_busy_) throw std::runtime_error("this run is in the middle of a step");
  return *run_;
}

/// For those who ask from other threads.
void PythonRun::note_place() {
  time_.store(run_->march().state().t);
  steps_.store(run_->march().steps());
}

/// Arrays that are still looked at keep what they show.
void PythonRun::settle_leases() {
  for (std::size_t i = 0; i < leases_.size(); ++i) {
    if (const std::shared_ptr<Lease> lease = leases_[i].lock()) lease->kept = run_->march().hand_over(viewed[i]);
    leases_[i].reset();
  }
}

bool PythonRun::has_arrived(double time, long long count) const {
  return count == 0 || run_->is_over() || this->time() >= time * (1.0 - 1e-12);
}

/// Do observers want to see this step?
bool PythonRun::is_watched() const {
  return std::any_of(watched_every_.begin(), watched_every_.end(),
                     [&](long long every) { return steps() % every == 0 || run_->is_over(); });
}

/// Without the lock of the interpreter, for a moment at most: signals wait for it.
void PythonRun::advance_quietly(double time, long long& count) {
  constexpr std::chrono::milliseconds moment(50);
  const py::gil_scoped_release release;
  const Computing computing(threads_);
  const Run::Clock::time_point begun = Run::Clock::now();
  with_errors_of_callables([&] {
    do {
      settle_leases();
      run_->step();
      note_place();
      if (count > 0) --count;
    } while (!has_arrived(time, count) && !is_watched() && !take_interrupt() && Run::Clock::now() - begun < moment);
  });
}

void PythonRun::throw_failure() const {
  if (run_->outcome() == Outcome::good) return;
  throw FailedRun(static_cast<int>(steps()), time(), run_->message());
}

void PythonRun::advance(double time, long long count) {
  quiet();
  refuse_closed();
  throw_failure();
  while (!has_arrived(time, count)) {
    {
      const Busy busy(is_busy_);
      advance_quietly(time, count);
    }
    throw_failure();
    if (!watched_every_.empty() && is_watched()) py::cast(this).attr("_show")();
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

void PythonRun::observe(long long every) {
  refuse_closed();
  if (every < 1) throw py::value_error("every: a number of steps, at least 1");
  watched_every_.push_back(every);
}

void PythonRun::forget(long long every) {
  const auto found = std::find(watched_every_.begin(), watched_every_.end(), every);
  if (found != watched_every_.end()) watched_every_.erase(found);
}

std::shared_ptr<const Snapshot> PythonRun::save() {
  const Busy busy(is_busy_);
  const py::gil_scoped_release release;
  const Computing computing(threads_);
  return run_->save();
}

void PythonRun::restore(const Snapshot& snapshot) {
  if (is_closed_ && !folder().empty())
    throw std::runtime_error("this run has been finished, and its folder is closed; start another");
  const Busy busy(is_busy_);
  settle_leases();
  const py::gil_scoped_release release;
  const Computing computing(threads_);
  run_->restore(snapshot);
  note_place();
  is_closed_ = false;
}

std::string PythonRun::close(const std::string& folder) {
  refuse_closed();
  if (!folder.empty() && !this->folder().empty())
    throw py::value_error("folder: this run writes into " + this->folder() + " since its start");
  const Busy busy(is_busy_);
  const py::gil_scoped_release release;
  const Computing computing(threads_);
  if (!run_->is_over()) run_->interrupt();
  if (!folder.empty()) run_->begin_folder(folder);
  is_closed_ = true;
  return summary_text(run_->finish());
}

py::array PythonRun::values(std::size_t which) {
  const Busy busy(is_busy_);
  std::shared_ptr<Lease> lease = leases_[which].lock();
  if (!lease) leases_[which] = lease = std::make_shared<Lease>();
  const std::vector<double>& x = run_->march().state().*viewed[which];
  const std::size_t nodes = given_nodes(simulation_->given(), simulation_->mesh());
  return view(x.data(), {static_cast<py::ssize_t>(nodes), 3}, std::move(lease));
}

std::shared_ptr<const Mesh> PythonRun::mesh() const {
  return {simulation_, &simulation_->mesh()};
}

py::tuple PythonRun::table(std::size_t which) const {
  const std::vector<Recorder::KeptTable> tables = quiet().watched().recorder.kept();
  if (which >= tables.size()) return py::make_tuple(py::list(), py::none());
  const auto& [table, values] = tables[which];
  const auto columns = static_cast<py::ssize_t>(table.columns.size());
  const auto rows = static_cast<py::ssize_t>(values.size()) / columns;
  return py::make_tuple(py::cast(table.columns), py::array_t<double>({rows, columns}, values.data()));
}

py::tuple PythonRun::contact() const {
  const CurveTable& table = quiet().watched().recorder.contact();
  return py::make_tuple(py::cast(table.columns),
                        py::array_t<double>(static_cast<py::ssize_t>(table.row.size()), table.row.data()));
}

std::vector<std::string> PythonRun::fields() const {
  std::vector<std::string> names = fields_of(*simulation_);
  if (quiet().watched().recorder.slip().empty()) std::erase(names, "contact_slip");
  return names;
}

py::array PythonRun::field(const std::string& name) {
  const Busy busy(is_busy_);
  const FieldKind kind = field_kind(*simulation_, name).value();
  std::vector<double> values;
  {
    const py::gil_scoped_release release;
    const Computing computing(threads_);
    const StepView view = run_->march().view();
    FieldsNow now(*simulation_, view, run_->watched().recorder.slip());
    const FieldValues found = now.evaluate(name);
    values.assign(found.values.begin(), found.values.end());
  }
  const std::size_t width = components(kind.form);
  if (kind.is_at_nodes()) values.resize(width * given_nodes(simulation_->given(), simulation_->mesh()));
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(values.size() / width)};
  if (width > 1) shape.push_back(static_cast<py::ssize_t>(width));
  return py::array_t<double>(shape, values.data());
}

py::tuple PythonRun::cells() const {
  const BodyCells& cells = simulation_->solid().cells();
  std::vector<Index> blocks, rows, parts;
  for (const CellRef& cell : cells) {
    blocks.push_back(cell.block);
    rows.push_back(cell.cell);
  }
  const std::vector<Index> numbers = simulation_->model().part_numbers();
  for (std::size_t p = 0; p < numbers.size(); ++p)
    parts.insert(parts.end(), simulation_->model().parts[p].cells.size(), numbers[p]);
  const auto array = [](const std::vector<Index>& x) {
    return py::array_t<Index>(static_cast<py::ssize_t>(x.size()), x.data());
  };
  return py::make_tuple(array(blocks), array(rows), array(parts));
}

std::string PythonRun::units() const {
  return units_comment(units_of(name(simulation_->given().units)));
}

std::vector<std::string> PythonRun::contact_names() const {
  std::vector<std::string> names;
  for (const ContactDefinition& contact : simulation_->model().contacts) names.push_back(name_of(contact));
  return names;
}

py::tuple PythonRun::contact_at_nodes(const std::string& name) {
  const Busy busy(is_busy_);
  const std::vector<std::string> names = contact_names();
  const auto contact = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  NodalForces found = carom::contact_at_nodes(*simulation_, run_->march().view(), contact);
  const auto given = static_cast<Index>(given_nodes(simulation_->given(), simulation_->mesh()));
  const auto count = std::ranges::lower_bound(found.nodes, given) - found.nodes.begin();
  return py::make_tuple(py::array_t<Index>(count, found.nodes.data()),
                        py::array_t<double>({count, py::ssize_t{3}}, found.force.data()->data()));
}

}  // namespace carom::python
