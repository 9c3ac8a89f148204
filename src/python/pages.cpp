// What notebooks show: the key figures of a run, and its view.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "output/summary.hpp"
#include "output/units.hpp"
#include "python/bindings.hpp"
#include "python/compute.hpp"
#include "report/figures.hpp"
#include "report/report.hpp"
#include "report/results.hpp"
#include "report/run_tables.hpp"

namespace carom::python {

namespace {

using Rows = std::pair<std::vector<std::string>, py::array_t<double>>;

std::optional<CsvTable> table_of_rows(const Rows& given) {
  if (given.first.empty()) return std::nullopt;
  CsvTable table;
  table.columns = given.first;
  const auto rows = given.second.unchecked<2>();
  for (py::ssize_t c = 0; c < rows.shape(1); ++c) {
    std::vector<double>& values = table.values.emplace_back();
    for (py::ssize_t r = 0; r < rows.shape(0); ++r) values.push_back(rows(r, c));
  }
  return table;
}

/// Title, value and remark of each.
std::vector<std::array<std::string, 3>> figures(const std::string& text, const Rows& energy, const Rows& contact,
                                                const Rows& probes) {
  const Summary summary = parse_summary(text);
  Tables tables;
  tables.energy = table_of_rows(energy);
  tables.contact = table_of_rows(contact);
  tables.probes = table_of_rows(probes);
  tables.ties = summary.ties;
  std::vector<std::array<std::string, 3>> out;
  for (const KeyFigure& f : key_figures(tables, summary, units_of(summary.case_info.units)))
    out.push_back({f.title, f.value, f.remark});
  return out;
}

/// The tables of `carom report --format`: of a folder, where there is one, else of what is in memory.
std::string tables(const std::string& folder, const std::string& text, const std::array<Rows, 4>& of_run,
                   const std::string& format) {
  if (!folder.empty()) return tables_of_runs({folder}, format);
  ReportData data;
  data.summary = parse_summary(text);
  data.units = units_of(data.summary->case_info.units);
  Tables read;
  read.energy = table_of_rows(of_run[0]);
  read.contact = table_of_rows(of_run[1]);
  read.probes = table_of_rows(of_run[2]);
  read.parts = table_of_rows(of_run[3]);
  read.ties = data.summary->ties;
  show_tables(data, read);
  return tables_text({{"value", std::move(data)}}, format);
}

std::string page_with_view(const std::string& folder, std::size_t most_bytes) {
  const py::gil_scoped_release release;
  const Computing computing(1);
  return view_page(folder, most_bytes);
}

}  // namespace

void bind_pages(py::module_& module) {
  module.def("key_figures", &figures, py::arg("summary"), py::arg("energy"), py::arg("contact"), py::arg("probes"),
             "Title, value and remark of the key figures of a report.");
  module.def("tables", &tables, py::arg("folder"), py::arg("summary"), py::arg("of_run"), py::arg("format"),
             "The tables of a run as text; of_run: energy, contact, probes and parts.");
  module.def("view_page", &page_with_view, py::arg("folder"), py::arg("most_bytes"),
             "A page with the view of a results folder alone.");
}

}  // namespace carom::python
