#include "record/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "base/errors.hpp"
#include "base/units.hpp"
#include "output/file_writer.hpp"
#include "output/results_folder.hpp"
#include "output/units.hpp"
#include "parallel/threads.hpp"
#include "record/field_values.hpp"
#include "record/filtered_curves.hpp"
#include "record/frame_plan.hpp"
#include "record/shock_numbers.hpp"
#include "report/csv_table.hpp"

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

FrameCells frame_cells(const Simulation& simulation) {
  FrameCells cells;
  const Solid& solid = simulation.solid();
  std::size_t corners = 0;
  for (std::size_t k = 0; k < solid.cells().size(); ++k) corners += solid.cells().nodes_of(k).size();
  cells.connectivity.reserve(corners);
  cells.ends.reserve(solid.cells().size());
  cells.types.reserve(solid.cells().size());
  for (std::size_t k = 0; k < solid.cells().size(); ++k)
    cells.add(solid.cells().nodes_of(k),
              simulation.mesh().blocks[static_cast<std::size_t>(solid.cells()[k].block)].type);
  return cells;
}

/// The position of each cell's part in the case, from 0.
std::vector<Index> part_numbers(const Model& model) {
  std::vector<Index> numbers;
  const std::vector<Index> of_part = model.part_numbers();
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    numbers.insert(numbers.end(), model.parts[p].cells.size(), of_part[p]);
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
FrameField numbers_field(std::string name, const std::vector<std::int64_t>& numbers) {
  const auto fits = [](std::int64_t n) { return n >= 0 && n <= std::numeric_limits<Index>::max(); };
  if (!std::all_of(numbers.begin(), numbers.end(), fits)) return {std::move(name), 1, numbers};
  return {std::move(name), 1, std::vector<Index>(numbers.begin(), numbers.end())};
}

/// Hides the cells that have gone. alive: empty where all are there.
FrameField hidden_cells(std::span<const std::uint8_t> alive, std::size_t count) {
  std::vector<std::uint8_t> hidden(count, 0);
  for (std::size_t k = 0; k < alive.size(); ++k)
    if (alive[k] == 0) hidden[k] = hidden_cell;
  return {ghost_type, 1, std::move(hidden)};
}

FrameMesh frame_mesh(const Simulation& s) {
  return {s.mesh().coordinates,
          frame_cells(s),
          {numbers_field("node_number", s.mesh().node_numbers)},
          {numbers_field("cell_number", cell_numbers(s)), {"part", 1, part_numbers(s.model())}}};
}

/// Entries of a field in the type that they have in frames: small whole numbers, or the precision of the case.
FrameField frame_field(std::string name, Form form, std::span<const double> values, CaseOutput::Precision precision) {
  const auto in_type = [&]<class T>(T) {
    std::vector<T> rounded(values.size());
    parallel_each(rounded.size(), [&](std::size_t i) { rounded[i] = static_cast<T>(values[i]); });
    return FrameField{std::move(name), static_cast<int>(components(form)), std::move(rounded)};
  };
  if (form == Form::category) return in_type(std::uint8_t{});
  return precision == CaseOutput::Precision::in_single ? in_type(float{}) : in_type(double{});
}

FieldFrame frame_of(const Simulation& s, const StepView& view, std::span<const double> slip) {
  const CaseOutput& output = s.given().output;
  FieldFrame frame;
  if (!s.model().erosion.empty()) frame.cells.push_back(hidden_cells(view.state.alive(), s.solid().cells().size()));
  FieldsNow now(s, view, slip);
  const auto add = [&](std::string_view name) {
    const std::optional<FieldKind> kind = field_kind(s, name);
    if (!kind) return;
    (kind->is_at_nodes() ? frame.points : frame.cells)
        .push_back(frame_field(std::string(name), kind->form, now.evaluate(name).values, output.precision));
  };
  // What takes most memory on its way comes first, while the frame is small: all that needs stresses, then strains.
  std::vector<std::string_view> names;
  for (const auto& field : output.fields) names.push_back(*field);
  const auto middle = std::stable_partition(names.begin(), names.end(), FieldsNow::needs_stress);
  std::stable_partition(middle, names.end(), [&](std::string_view name) {
    const std::optional<FieldKind> kind = field_kind(s, name);
    return kind && kind->form == Form::tensor;
  });
  std::for_each(names.begin(), middle, add);
  now.forget_stress();
  std::for_each(middle, names.end(), add);
  return frame;
}

}  // namespace

RunTables::RunTables(const Simulation& simulation)
    : contact(simulation),
      parts(simulation),
      probes(simulation, parts.table()),
      exact(make_exact(simulation, probes)),
      checks(simulation, {&energy.table(), &contact.table(), &probes.table()}, exact ? &*exact : nullptr) {}

Recorder::Recorder(const Simulation& simulation, std::string folder)
    : simulation_(simulation),
      folder_(std::move(folder)),
      tables_(simulation),
      figures_(simulation),
      slip_(simulation),
      format_(frame_format(simulation)),
      obstacles_(simulation),
      clock_(simulation) {}

std::vector<Recorder::TableFile> Recorder::table_files() const {
  std::vector<TableFile> list{{folder_ + "/energy.csv", "energies", tables_.energy.table()},
                              {folder_ + "/contact.csv", "contact forces on the body", tables_.contact.table()},
                              {folder_ + "/probes.csv", "probes", tables_.probes.table()},
                              {folder_ + "/parts.csv", "parts", tables_.parts.table()}};
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
void Recorder::open_files(const std::vector<FrameEntry>& frames) {
  std::vector<OpenTable> tables;
  for (const TableFile& file : table_files())
    tables.push_back({CsvFile(file.path, file.table.columns, comments(simulation_, file.what)), file.table});
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::span<const double> values = rows_[i].values;
    const std::size_t width = tables[i].table.columns.size();
    for (std::size_t k = 0; k < values.size(); k += width) tables[i].file.append(values.subspan(k, width));
  }
  files_.emplace(Files{std::move(tables), FrameIndex(folder_, format_, frames)});
}

void Recorder::rewrite() {
  const auto is_there = [&](const std::string& file) { return std::filesystem::exists(folder_ + "/" + file); };
  std::erase_if(frames_, [&](const FrameEntry& frame) { return !is_there(frame.file); });
  if (!obstacles_file_.empty() && !is_there(obstacles_file_)) obstacles_file_.clear();
  std::vector<std::string> names;
  for (FrameEntry& frame : frames_) {
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
  for (const FrameEntry& frame : frames_) frames.insert(frames.end(), {frame.file, frame.obstacles});
  for (const std::string& frame : frames)
    if (!frame.empty() && !std::filesystem::exists(folder_ + "/" + frame))
      throw OutputError(folder_ + "/" + frame, "it is missing, and the checkpoint names it");
  continue_results_folder(folder_, frames);
  std::vector<OpenTable> tables;
  for (std::size_t i = 0; i < list.size(); ++i)
    tables.push_back({CsvFile(list[i].path, list[i].table.columns.size(), places_[i]), list[i].table});
  files_.emplace(Files{std::move(tables), FrameIndex(folder_, format_, frames_)});
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
  FieldsNow now(simulation_, view, slip_.path(), tables_.probes.stressed_cells());
  if (view.step != last_sample_) {  // every step, once: impulses and paths are sums
    tables_.contact.sample(view);
    slip_.sample(now);
  }
  const bool frame_is_due =
      last_sample_ < 0 || clock_.due(view.step, view.state.t) > clock_.due(last_sample_, last_time_);
  last_sample_ = view.step;
  last_time_ = view.state.t;
  figures_.sample(view, is_last);
  const bool due = is_last || view.step % simulation_.given().output.curves_every == 0;
  const bool is_checked = tables_.checks.is_due(view.state.t, simulation_.dt());
  if (due || is_checked) {
    tables_.probes.complete(view);
    tables_.energy.sample(view);
    tables_.parts.sample(view);
    tables_.probes.sample(now);
  }
  if (is_checked) tables_.checks.sample(view.state.t);
  if (due && view.step != last_row_) {
    last_row_ = view.step;
    if (tables_.exact) tables_.exact->sample(view.state.t);
    add_row();
  }
  if ((is_last || frame_is_due) && view.step != last_frame_) {
    if (!simulation_.given().output.fields.empty()) view.shared.collect();
    record_frame(view);
    view.shared.release();
  }
}

void Recorder::add_row() {
  if (files_)
    for (OpenTable& open : files_->tables) open.file.append(open.table.row);
  if (rows_.empty()) return;
  const std::vector<TableFile> list = table_files();
  for (std::size_t i = 0; i < list.size(); ++i)
    rows_[i].values.insert(rows_[i].values.end(), list[i].table.row.begin(), list[i].table.row.end());
}

void Recorder::record_frame(const StepView& view) {
  if (!files_ || simulation_.given().output.fields.empty()) return;
  last_frame_ = view.step;
  writer_.finish();  // one frame in memory at a time
  if (!files_->bodies) files_->bodies = format_.make_writer(folder_, bodies_mesh, frame_mesh(simulation_));
  FieldFrame frame = frame_of(simulation_, view, slip_.path());
  const std::string obstacles = record_obstacles(view), file = frame_file(format_, view.step);
  writer_.start([this, frame = std::move(frame), t = view.state.t, file, obstacles] {
    files_->bodies->write(file, frame);
    files_->frames.add({t, file, obstacles});
  });
}

/// The file of the obstacles of this frame: one for all of them while none moves.
std::string Recorder::record_obstacles(const StepView& view) {
  if (obstacles_.empty() || (!obstacles_file_.empty() && !obstacles_.moves())) return obstacles_file_;
  obstacles_file_ = obstacles_file(format_, view.step);
  if (!files_->obstacles) files_->obstacles = format_.make_writer(folder_, obstacles_mesh, obstacles_.mesh());
  files_->obstacles->write(obstacles_file_, obstacles_.frame(view.state));
  return obstacles_file_;
}

/// Probes and forces of contact with a channel frequency class: probes_filtered.csv and contact_filtered.csv.
void Recorder::write_filtered() const {
  const Case& given = simulation_.given();
  std::vector<FilterWish> probes, contacts;
  for (std::size_t p = 0; p < given.probes.size(); ++p)
    if (given.probes[p].cfc) probes.push_back({*given.probes[p].cfc, tables_.probes.columns(p)});
  for (std::size_t c = 0; c < given.contacts.size(); ++c)
    if (given.contacts[c].cfc) contacts.push_back({*given.contacts[c].cfc, tables_.contact.resultants(c)});
  carom::write_filtered({folder_ + "/probes.csv", folder_ + "/probes_filtered.csv",
                         comments(simulation_, "filtered probes"), given.units},
                        probes);
  carom::write_filtered({folder_ + "/contact.csv", folder_ + "/contact_filtered.csv",
                         comments(simulation_, "filtered contact forces"), given.units},
                        contacts);
}

/// Of accelerations of probes that ask for it: shock_spectra.csv, and what the summary says.
void Recorder::write_shock() {
  const Case& given = simulation_.given();
  std::vector<ShockWish> wishes;
  for (const CaseProbe& probe : given.probes)
    for (const auto& quantity : probe.quantities)
      if (probe.shock && (*quantity == "acceleration" || *quantity == "local_acceleration"))
        wishes.push_back({*probe.name, *quantity, probe.cfc.value_or(0.0), probe.quality_factor.value_or(10.0)});
  shock_ =
      carom::write_shock({folder_ + "/probes.csv", folder_ + "/probes_filtered.csv", folder_ + "/shock_spectra.csv",
                          comments(simulation_, "shock response spectra"), given.units},
                         wishes);
}

void Recorder::fill(Summary& summary) const {
  summary.shock = shock_;
  summary.parts = figures_.parts();
  summary.stress = figures_.stress();
  const Case& given = simulation_.given();
  for (std::size_t p = 0; p < given.probes.size(); ++p) {
    const CaseProbe& probe = given.probes[p];
    const std::vector<Index>& nodes = tables_.probes.nodes(p);
    summary.probes.push_back(
        {*probe.name,
         probe.part    ? fmt::format("part {}", **probe.part)
         : probe.group ? fmt::format("{} node{} of {}", nodes.size(), nodes.size() == 1 ? "" : "s", **probe.group)
                       : fmt::format("node {}", simulation_.mesh().node_label(nodes[0])),
         tables_.probes.positions()[p]});
  }
}

void Recorder::close() {
  writer_.finish();
  if (!files_) return;
  for (OpenTable& open : files_->tables) open.file.close();
  write_filtered();
  write_shock();
}

}  // namespace carom
