#include "run/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "base/errors.hpp"
#include "base/units.hpp"
#include "math/voigt.hpp"
#include "output/cfc_filter.hpp"
#include "output/file_writer.hpp"
#include "output/results_folder.hpp"
#include "output/units.hpp"
#include "output/vtu.hpp"
#include "parallel/threads.hpp"
#include "report/csv_table.hpp"
#include "run/cost_estimate.hpp"
#include "solid/cell_strain.hpp"

namespace carom {

namespace {

std::vector<std::string> comments(const Simulation& simulation, const std::string& what) {
  return {fmt::format("{} - {}", simulation.given().title, what),
          units_comment(units_of(name(simulation.given().units)))};
}

std::optional<ExactCurves> make_exact(const Simulation& simulation, const ProbeCurves& probes) {
  if (!simulation.given().exact) return std::nullopt;
  return std::optional<ExactCurves>(std::in_place, simulation, probes);
}

VtuCells vtu_cells(const Simulation& simulation) {
  VtuCells cells;
  const Solid& solid = simulation.solid();
  for (std::size_t k = 0; k < solid.cell_count(); ++k)
    cells.add(solid.nodes_of_cell(k), simulation.mesh().blocks[static_cast<std::size_t>(solid.cells()[k].block)].type);
  return cells;
}

/// The position of each cell's part in the case, from 0.
std::vector<Index> part_numbers(const Model& model) {
  std::vector<Index> numbers;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    numbers.insert(numbers.end(), model.parts[p].cells.size(), static_cast<Index>(p));
  return numbers;
}

/// The number of each cell in the mesh file.
std::vector<std::int64_t> cell_numbers(const Simulation& simulation) {
  std::vector<std::int64_t> numbers;
  for (const CellRef& cell : simulation.solid().cells())
    numbers.push_back(simulation.mesh()
                          .blocks[static_cast<std::size_t>(cell.block)]
                          .file_numbers[static_cast<std::size_t>(cell.cell)]);
  return numbers;
}

/// Numbers of nodes or cells, in 32 bits where they fit.
VtuField numbers_field(std::string name, const std::vector<std::int64_t>& numbers) {
  const auto fits = [](std::int64_t n) { return n >= 0 && n <= std::numeric_limits<Index>::max(); };
  if (!std::all_of(numbers.begin(), numbers.end(), fits)) return {std::move(name), 1, numbers};
  return {std::move(name), 1, std::vector<Index>(numbers.begin(), numbers.end())};
}

/// In single precision, enough for what is looked at.
std::vector<float> rounded(std::span<const double> values) {
  std::vector<float> out(values.size());
  parallel_each(out.size(), [&](std::size_t i) { out[i] = static_cast<float>(values[i]); });
  return out;
}

std::vector<float> rounded(const std::vector<Voigt>& tensors) {
  return rounded(std::span(tensors.data()->data(), 6 * tensors.size()));
}

/// The fields of one instant.
struct Frame {
  std::vector<VtuField> points, cells;
};

Frame frame_of(const Simulation& s, const StepView& view) {
  const State& state = view.state;
  Frame frame;
  std::vector<Voigt> stress;
  const auto need_stress = [&]() -> const std::vector<Voigt>& {
    if (stress.empty()) stress = s.solid().cell_stress(state.q, view.points());
    return stress;
  };
  const auto von_mises_of = [](const std::vector<Voigt>& tensors) {
    std::vector<float> out(tensors.size());
    parallel_each(out.size(), [&](std::size_t k) { out[k] = static_cast<float>(von_mises(tensors[k])); });
    return out;
  };
  std::optional<NodalContact> contact;
  if (!s.given().contacts.empty()) contact = nodal_contact(view.forces.rows, state.q);
  frame.points.push_back(numbers_field("node_number", s.mesh().node_numbers));
  frame.cells.push_back(numbers_field("cell_number", cell_numbers(s)));
  frame.cells.push_back({"part", 1, part_numbers(s.model())});
  for (const auto& field : s.given().output.fields) {
    const std::string& name = *field;
    if (name == "displacement") frame.points.push_back({name, 3, state.q});
    if (name == "velocity") frame.points.push_back({name, 3, state.v});
    if (name == "acceleration") frame.points.push_back({name, 3, state.a});
    if (contact && name == "contact_force") frame.points.push_back({name, 3, rounded(view.forces.contact.dense())});
    if (contact && name == "contact_pressure") frame.points.push_back({name, 1, rounded(contact->pressure)});
    if (contact && name == "contact_gap") frame.points.push_back({name, 1, rounded(contact->gap)});
    if (contact && name == "contact_status") frame.points.push_back({name, 1, contact->status});
    if (name == "contact_damage" && !s.solid().cohesive().empty())
      frame.points.push_back(
          {name, 1, rounded(s.solid().cohesive().nodal_damage(view.points().history, s.mesh().node_count()))});
    if (name == "stress") frame.cells.push_back({name, 6, rounded(need_stress())});
    if (name == "strain") frame.cells.push_back({name, 6, rounded(cell_strain(s.model(), state.q))});
    if (name == "von_mises") frame.cells.push_back({name, 1, von_mises_of(need_stress())});
    const std::vector<double> variable = s.solid().cell_history(name, view.points().history);
    if (!variable.empty()) frame.cells.push_back({name, 1, rounded(variable)});
  }
  return frame;
}

bool wants_filter(const Case& given) {
  return std::any_of(given.probes.begin(), given.probes.end(), [](const CaseProbe& p) { return p.cfc.has_value(); });
}

}  // namespace

RunTables::RunTables(const Simulation& simulation)
    : contact(simulation),
      probes(simulation),
      exact(make_exact(simulation, probes)),
      checks(simulation, {&energy.table(), &contact.table(), &probes.table()}, exact ? &*exact : nullptr) {}

Recorder::Recorder(const Simulation& simulation, std::string folder)
    : simulation_(simulation),
      folder_(std::move(folder)),
      tables_(simulation),
      figures_(simulation),
      cells_(simulation.given().output.fields.empty() ? VtuCells{} : vtu_cells(simulation)),
      obstacles_(simulation),
      frame_every_(frame_interval(simulation)) {}

std::vector<Recorder::TableFile> Recorder::table_files() const {
  std::vector<TableFile> list{{folder_ + "/energy.csv", "energies", tables_.energy.table()},
                              {folder_ + "/contact.csv", "contact forces on the body", tables_.contact.table()},
                              {folder_ + "/probes.csv", "probes", tables_.probes.table()}};
  if (tables_.exact) list.push_back({folder_ + "/exact.csv", "exact solution", tables_.exact->table()});
  return list;
}

void Recorder::keep_rows() {
  rows_.resize(table_files().size());
}

std::vector<Recorder::KeptTable> Recorder::kept() const {
  std::vector<KeptTable> out;
  const std::vector<TableFile> list = table_files();
  for (std::size_t i = 0; i < list.size(); ++i)
    out.push_back(
        {list[i].table, i < rows_.size() ? std::span<const double>(rows_[i].values) : std::span<const double>{}});
  return out;
}

void Recorder::begin() {
  prepare_results_folder(folder_);
  open_files({});
}

void Recorder::begin_in(std::string folder) {
  folder_ = std::move(folder);
  begin();
}

/// New files with the rows that have been kept.
void Recorder::open_files(const std::vector<PvdFrame>& frames) {
  std::vector<OpenTable> tables;
  for (const TableFile& file : table_files())
    tables.push_back({CsvFile(file.path, file.table.columns, comments(simulation_, file.what)), file.table});
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::span<const double> values = rows_[i].values;
    const std::size_t width = tables[i].table.columns.size();
    for (std::size_t k = 0; k < values.size(); k += width) tables[i].file.append(values.subspan(k, width));
  }
  files_.emplace(Files{std::move(tables), PvdCollection(folder_ + "/fields.pvd", frames)});
}

void Recorder::rewrite() {
  const auto is_there = [&](const std::string& file) { return std::filesystem::exists(folder_ + "/" + file); };
  std::erase_if(frames_, [&](const PvdFrame& frame) { return !is_there(frame.file); });
  if (!obstacles_file_.empty() && !is_there(obstacles_file_)) obstacles_file_.clear();
  std::vector<std::string> names;
  for (PvdFrame& frame : frames_) {
    if (!frame.obstacles.empty() && !is_there(frame.obstacles)) frame.obstacles.clear();
    names.insert(names.end(), {frame.file, frame.obstacles});
  }
  continue_results_folder(folder_, names);
  open_files(frames_);
}

void Recorder::go_on() {
  const std::vector<TableFile> list = table_files();
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(list[i].path, error);
    if (error) throw OutputError(list[i].path, error.message());
    if (size < places_.at(i))
      throw OutputError(list[i].path,
                        fmt::format("{} bytes, and {} at the checkpoint: it has been cut", size, places_[i]));
  }
  std::vector<std::string> frames;
  for (const PvdFrame& frame : frames_) frames.insert(frames.end(), {frame.file, frame.obstacles});
  for (const std::string& frame : frames)
    if (!frame.empty() && !std::filesystem::exists(folder_ + "/" + frame))
      throw OutputError(folder_ + "/" + frame, "it is missing, and the checkpoint names it");
  continue_results_folder(folder_, frames);
  std::vector<OpenTable> tables;
  for (std::size_t i = 0; i < list.size(); ++i)
    tables.push_back({CsvFile(list[i].path, list[i].table.columns.size(), places_[i]), list[i].table});
  files_.emplace(Files{std::move(tables), PvdCollection(folder_ + "/fields.pvd", frames_)});
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::optional<CsvTable> read = read_csv(list[i].path);
    for (std::size_t k = 0; read && k < read->rows(); ++k)
      for (const std::vector<double>& column : read->values) rows_[i].values.push_back(column[k]);
  }
}

/// Writes out what there is of the tables.
void Recorder::keep_places() {
  writer_.finish();
  places_.clear();
  for (OpenTable& open : files_->tables) places_.push_back(open.file.sync());
  frames_ = files_->frames.frames();
}

void Recorder::record(const StepView& view, bool is_last) {
  if (view.step != last_sample_) tables_.contact.sample(view);  // every step, once: the impulses are sums
  last_sample_ = view.step;
  figures_.sample(view, is_last);
  const bool due = is_last || view.step % simulation_.given().output.curves_every == 0;
  const bool is_checked = tables_.checks.is_due(view.state.t, simulation_.dt());
  if (due || is_checked) {
    tables_.energy.sample(view);
    tables_.probes.sample(view);
  }
  if (is_checked) tables_.checks.sample(view.state.t);
  if (due && view.step != last_row_) {
    last_row_ = view.step;
    if (tables_.exact) tables_.exact->sample(view.state.t);
    add_row();
  }
  if ((is_last || view.step % frame_every_ == 0) && view.step != last_frame_) record_frame(view);
}

void Recorder::add_row() {
  if (files_)
    for (OpenTable& open : files_->tables) open.file.append(open.table.row);
  if (rows_.empty()) return;
  const auto append = [](Rows& rows, const CurveTable& table) {
    rows.values.insert(rows.values.end(), table.row.begin(), table.row.end());
  };
  append(rows_[0], tables_.energy.table());
  append(rows_[1], tables_.contact.table());
  append(rows_[2], tables_.probes.table());
  if (tables_.exact) append(rows_[3], tables_.exact->table());
}

void Recorder::record_frame(const StepView& view) {
  if (!files_ || simulation_.given().output.fields.empty()) return;
  last_frame_ = view.step;
  writer_.finish();  // one frame in memory at a time
  Frame frame = frame_of(simulation_, view);
  const std::string obstacles = record_obstacles(view), file = frame_file(static_cast<int>(view.step));
  writer_.start([this, frame = std::move(frame), t = view.state.t, file, obstacles] {
    write_vtu(folder_ + "/" + file, simulation_.mesh().coordinates, cells_, frame.points, frame.cells);
    files_->frames.add(t, file, obstacles);
  });
}

/// The file of the obstacles of this frame: one for all of them while none moves.
std::string Recorder::record_obstacles(const StepView& view) {
  if (obstacles_.empty() || (!obstacles_file_.empty() && !obstacles_.moves())) return obstacles_file_;
  obstacles_file_ = fmt::format("fields/obstacles_{:06}.vtu", view.step);
  obstacles_.write(folder_ + "/" + obstacles_file_, view.state);
  return obstacles_file_;
}

namespace {

/// What is to be known of a record beside its class; "" when nothing is.
std::string shortness(const CaseProbe& probe, double seconds) {
  constexpr double enough = 3.0;
  const double periods = seconds * cfc_limit(*probe.cfc);
  if (periods >= enough) return {};
  return fmt::format(
      "note: {}: the record of {:.3g} s is {:.2g} periods of the limit of CFC {:g} ({:.4g} Hz), less than {:g}: how "
      "the "
      "filter continues its ends shapes all of it",
      *probe.name, seconds, periods, *probe.cfc, cfc_limit(*probe.cfc), enough);
}

}  // namespace

/// Probes with a channel frequency class, filtered after the run on equal intervals of time: probes_filtered.csv, the
/// classes in its header.
void Recorder::write_filtered() const {
  const Case& given = simulation_.given();
  if (!wants_filter(given)) return;
  const std::optional<CsvTable> raw = read_csv(folder_ + "/probes.csv");
  if (!raw || raw->rows() < 3) return;
  const double second = si_factor(Dimension::time, given.units);
  std::vector<double> time;
  for (const double t : raw->values[0]) time.push_back(t * second);
  double highest = 0.0, longest = 0.0;
  for (const CaseProbe& probe : given.probes) highest = std::max(highest, probe.cfc.value_or(0.0));
  for (std::size_t i = 1; i < time.size(); ++i) longest = std::max(longest, time[i] - time[i - 1]);
  const std::vector<double> at = equal_times(time, highest);
  const double dt = (at.back() - at.front()) / static_cast<double>(at.size() - 1);
  std::vector<std::string> columns{"time"}, header = comments(simulation_, "filtered probes");
  std::vector<std::vector<double>> values;
  for (const CaseProbe& probe : given.probes) {
    if (!probe.cfc) continue;
    if (std::string note = shortness(probe, at.back() - at.front()); !note.empty()) header.push_back(std::move(note));
    for (std::size_t c = 1; c < tables_.probes.table().columns.size(); ++c) {
      const std::string& column = tables_.probes.table().columns[c];
      if (column.substr(0, column.rfind('.')) != *probe.name) continue;
      if (longest * *probe.cfc > cfc_longest_sampling * (1.0 + 1e-9)) {
        header.push_back(fmt::format(
            "{}: not filtered: CFC {:g} needs a sample at least every {:.3g} s (10 times the class); some are {:.3g} s "
            "apart",
            column, *probe.cfc, cfc_longest_sampling / *probe.cfc, longest));
        continue;
      }
      values.push_back(cfc_filter(resampled(time, raw->values[c], at), dt, *probe.cfc));
      columns.push_back(column);
      header.push_back(fmt::format("{}: SAE J211 CFC {:g}", column, *probe.cfc));
    }
  }
  CsvFile file(folder_ + "/probes_filtered.csv", columns, header);
  for (std::size_t i = 0; i < at.size(); ++i) {
    std::vector<double> row{at[i] / second};
    for (const auto& column : values) row.push_back(column[i]);
    file.append(row);
  }
  file.close();
}

void Recorder::fill(Summary& summary) const {
  summary.parts = figures_.parts();
  summary.stress = figures_.stress();
  const Case& given = simulation_.given();
  for (std::size_t p = 0; p < given.probes.size(); ++p) {
    const CaseProbe& probe = given.probes[p];
    const std::vector<Index>& nodes = tables_.probes.nodes(p);
    summary.probes.push_back(
        {*probe.name,
         probe.group ? fmt::format("{} node{} of {}", nodes.size(), nodes.size() == 1 ? "" : "s", **probe.group)
                     : fmt::format("node {}", simulation_.mesh().node_numbers[static_cast<std::size_t>(nodes[0])]),
         tables_.probes.positions()[p]});
  }
}

void Recorder::close() {
  writer_.finish();
  if (!files_) return;
  for (OpenTable& open : files_->tables) open.file.close();
  write_filtered();
}

}  // namespace carom
