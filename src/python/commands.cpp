// What the commands `material` and `compare` do, without what they print.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <future>
#include <map>

#include "base/errors.hpp"
#include "casefile/write_toml.hpp"
#include "compare/compare_cases.hpp"
#include "driver/material_page.hpp"
#include "output/data_table.hpp"
#include "output/units.hpp"
#include "python/compute.hpp"
#include "python/prepared_case.hpp"
#include "python/tree.hpp"
#include "report/csv_table.hpp"

namespace carom::python {

namespace {

/// Options of the command line are arguments here.
[[noreturn]] void throw_of_arguments(const CaseError& error) {
  const auto renamed = [](std::string text) {
    for (std::size_t k = text.find("--"); k != std::string::npos; k = text.find("--")) text.erase(k, 2);
    return text;
  };
  throw CaseError(error.where(), renamed(error.key()), error.found(), error.expected(), renamed(error.suggestion()));
}

py::array_t<double> rows_of(const std::vector<std::vector<double>>& rows, std::size_t width) {
  py::array_t<double> out({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(width)});
  for (std::size_t r = 0; r < rows.size(); ++r) std::copy(rows[r].begin(), rows[r].end(), out.mutable_data(r, 0));
  return out;
}

using Columns = std::vector<std::pair<std::string, std::vector<double>>>;

CsvTable table_of(const Columns& columns) {
  CsvTable table;
  for (const auto& [name, values] : columns) {
    table.columns.push_back(name);
    table.values.push_back(values);
  }
  return table;
}

/// Columns, rows, name of the part, comment of the units, and how far off the measured curve.
py::tuple material(const PreparedCase& prepared, PathRequest request, const std::optional<Columns>& table,
                   const std::optional<std::pair<std::vector<double>, std::vector<double>>>& measured,
                   const std::string& part, const std::string& folder) {
  if (table) request.table = std::make_shared<const CsvTable>(table_of(*table));
  if (measured) request.measured_curve = MeasuredCurve{measured->first, measured->second};
  try {
    const MaterialDrive drive = follow_material(prepared.given, part, request);
    if (!folder.empty()) write_material(drive, folder);
    py::object off = py::none();
    if (drive.measured) off = py::cast(drive.rms_off_measured());
    return py::make_tuple(drive.curve.columns, rows_of(drive.curve.rows, drive.curve.columns.size()), *drive.part.name,
                          units_comment(units_of(name(prepared.given.units))), off);
  } catch (const CaseError& error) {
    throw_of_arguments(error);
  }
}

/// Waits, and has `stop` set by Ctrl-C, which comes out when what is being made has ended.
template <class Value>
Value awaited(std::future<Value> made, std::atomic<bool>& stop) {
  std::optional<py::error_already_set> interrupt;
  const auto is_ready = [&made] {
    const py::gil_scoped_release release;
    return made.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
  };
  while (!is_ready()) {
    if (interrupt || PyErr_CheckSignals() == 0) continue;
    interrupt.emplace();
    stop.store(true);
  }
  if (interrupt) throw py::error_already_set(*interrupt);
  return made.get();
}

/// The text of compare.json, and the table in each of its formats.
std::pair<std::string, std::map<std::string, std::string>> compare(
    const py::dict& tree, const std::shared_ptr<Source>& source, const std::string& file,
    const compare::Options& options, const std::vector<std::string>& program, const std::string& folder, int jobs,
    const py::object& finished) {
  const Node root = from_python(tree, source ? &source->root : nullptr, file, "");
  compare::Settings settings{program, folder, jobs};
  if (!finished.is_none())
    settings.finished = [&finished](std::size_t done, std::size_t all, const std::string& label) {
      const py::gil_scoped_acquire acquire;
      try {
        finished(done, all, label);
      } catch (py::error_already_set& error) {
        error.discard_as_unraisable("carom.compare");
      }
    };
  std::atomic<bool> stop{false};
  try {
    return awaited(std::async(std::launch::async,
                              [&] {
                                std::optional<compare::Base> base;
                                std::vector<compare::Variant> variants;
                                {
                                  const Computing computing(1);
                                  base = compare::base_of(root, file);
                                  variants = compare::variants_in(folder, *base, options);
                                }
                                const compare::Comparison found = compare::compare_variants(
                                    *base, write_toml(root), variants, options, settings, stop);
                                std::map<std::string, std::string> tables;
                                for (const std::string& format : table_formats())
                                  tables[format] = format_table(variants_table(found), format);
                                return std::pair(json_table(found), std::move(tables));
                              }),
                   stop);
  } catch (const CaseError& error) {
    throw_of_arguments(error);
  }
}

/// Columns, rows and comment of the units of a table of a results folder; no columns where it is not there.
py::tuple read_table(const std::string& path) {
  const std::optional<CsvTable> table = read_csv(path);
  if (!table) return py::make_tuple(py::list(), py::none(), "");
  py::array_t<double> rows({static_cast<py::ssize_t>(table->rows()), static_cast<py::ssize_t>(table->columns.size())});
  for (std::size_t c = 0; c < table->columns.size(); ++c)
    for (std::size_t r = 0; r < table->rows(); ++r) rows.mutable_at(r, c) = table->values[c][r];
  return py::make_tuple(table->columns, rows, table->units ? units_comment(*table->units) : "");
}

}  // namespace

void bind_commands(py::module_& module) {
  module.def(
      "material",
      [](const PreparedCase& prepared, const std::string& path, const std::vector<double>& to, int steps, double rate,
         const std::optional<Columns>& table, const std::string& measured_file,
         const std::optional<std::pair<std::vector<double>, std::vector<double>>>& measured, const std::string& part,
         const std::string& folder) {
        return material(prepared, {.path = path, .to = to, .steps = steps, .measured = measured_file, .rate = rate},
                        table, measured, part, folder);
      },
      py::arg("case"), py::arg("path"), py::arg("to"), py::arg("steps"), py::arg("rate"), py::arg("table"),
      py::arg("measured_file"), py::arg("measured"), py::arg("part"), py::arg("folder"),
      "A law on a path of deformation.");
  module.def(
      "compare",
      [](const py::dict& tree, const std::shared_ptr<Source>& source, const std::string& file,
         const std::vector<std::string>& schemes, const std::vector<std::string>& enforcements,
         const std::vector<std::string>& stiffnesses, const std::vector<int>& cells,
         const std::vector<double>& courants, const std::vector<int>& refinements, const std::string& reference,
         const std::vector<std::string>& program, const std::string& folder, int jobs, const py::object& finished) {
        return compare(tree, source, file,
                       {schemes, enforcements, stiffnesses, cells, courants, refinements, reference}, program, folder,
                       jobs, finished);
      },
      py::arg("tree"), py::arg("source"), py::arg("file"), py::arg("schemes"), py::arg("enforcements"),
      py::arg("stiffnesses"), py::arg("cells"), py::arg("courants"), py::arg("refinements"), py::arg("reference"),
      py::arg("program"), py::arg("folder"), py::arg("jobs"), py::arg("finished"),
      "Runs variants of a case and compares them: the text of compare.json.");
  module.def("read_table", &read_table, py::arg("path"), "A table of a results folder.");
}

}  // namespace carom::python
