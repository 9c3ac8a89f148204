#include "report/results.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

#include "base/errors.hpp"
#include "casefile/read_toml.hpp"
#include "output/summary.hpp"
#include "report/charts.hpp"
#include "report/csv_table.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

std::optional<CsvTable> read_table(const fs::path& folder, const std::string& name, std::vector<std::string>& notes,
                                   std::string_view first = "time") {
  std::optional<CsvTable> table = read_csv((folder / name).string(), first);
  if (table && !table->damage.empty()) notes.push_back(fmt::format("{}: {}.", name, table->damage));
  return table;
}

std::optional<Summary> read_summary_if_whole(const fs::path& folder, std::vector<std::string>& notes) {
  const fs::path path = folder / "summary.json";
  if (!fs::exists(path)) {
    notes.emplace_back("summary.json is missing.");
    return std::nullopt;
  }
  try {
    return read_summary(path.string());
  } catch (const std::runtime_error& error) {
    notes.push_back(fmt::format("summary.json is damaged: {}.", error.what()));
    return std::nullopt;
  }
}

std::string read_case(const fs::path& folder, std::vector<std::string>& notes) {
  std::ifstream stream(folder / "case.resolved.toml", std::ios::binary);
  if (!stream) notes.emplace_back("case.resolved.toml is missing.");
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The ties of a resolved case that do not tear, as far as it is one.
std::vector<std::string> ties_of_case(const std::string& text, const std::string& folder) {
  std::vector<std::string> ties;
  try {
    const Node root = read_toml(text, folder);
    const Node* contacts = find(root, "contact");
    const auto* list = contacts == nullptr ? nullptr : std::get_if<List>(&contacts->value);
    const auto text_of = [](const Node& entry, const char* key) {
      const Node* node = find(entry, key);
      const auto* found = node == nullptr ? nullptr : std::get_if<std::string>(&node->value);
      return found == nullptr ? std::string() : *found;
    };
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
      if (text_of((*list)[i], "kind") == "tie" && find((*list)[i], "normal_strength") == nullptr)
        ties.push_back(text_of((*list)[i], "name"));
  } catch (const CaseError&) {
    return {};  // cut short
  }
  return ties;
}

/// From the summary, else from the first table that names them.
Units find_units(const std::optional<Summary>& summary, std::initializer_list<const std::optional<CsvTable>*> tables) {
  if (summary) return units_of(summary->case_info.units);
  for (const auto* table : tables) {
    if (*table && (*table)->units) return *(*table)->units;
  }
  return {};
}

}  // namespace

ReportData read_results(const std::string& results_folder) {
  const fs::path folder(results_folder);
  ReportData data;
  data.folder = results_folder;
  data.summary = read_summary_if_whole(folder, data.notes);
  Tables tables;
  tables.energy = read_table(folder, "energy.csv", data.notes);
  tables.contact = read_table(folder, "contact.csv", data.notes);
  tables.probes = read_table(folder, "probes.csv", data.notes);
  tables.parts = read_table(folder, "parts.csv", data.notes);
  tables.probes_filtered = read_table(folder, "probes_filtered.csv", data.notes);
  tables.contact_filtered = read_table(folder, "contact_filtered.csv", data.notes);
  tables.exact = read_table(folder, "exact.csv", data.notes);
  tables.spectra = read_table(folder, "shock_spectra.csv", data.notes, "frequency");
  if (!tables.energy) data.notes.emplace_back("energy.csv is missing.");
  data.case_text = read_case(folder, data.notes);
  data.units = find_units(data.summary, {&tables.energy, &tables.contact, &tables.probes});
  tables.ties = data.summary ? data.summary->ties : ties_of_case(data.case_text, results_folder);
  show_tables(data, tables);
  return data;
}

void show_tables(ReportData& data, const Tables& tables) {
  data.figures = key_figures(tables, data.summary, data.units);
  data.largest_force_at = time_of_largest_force(tables.contact, tables.ties);
  data.largest = largest_values(tables, data.summary, data.units);
  data.parts = largest_of_parts(tables.parts, data.units);
  data.spectra = spectrum_plots(tables.spectra, data.summary, data.units);
  data.charts = make_charts(tables, data.units, data.summary);
  if (tables.energy && !tables.energy->comments.empty()) {
    const std::string& line = tables.energy->comments.front();  // "Title - energies"
    data.title = line.substr(0, line.rfind(" - "));
  }
  if (tables.energy && tables.energy->rows() > 0) data.time_reached = tables.energy->values.front().back();
}

std::size_t bytes_of_views(std::size_t rest) {
  constexpr std::size_t most = 6'000'000, least = 2'000'000;
  return std::max(least, most - std::min(rest, most));
}

void add_view(ReportData& data, std::size_t most_bytes, const std::string& title) {
  ViewLabels labels{
      data.units, {}, data.summary ? data.summary->contacts : std::vector<std::string>(), data.largest_force_at};
  if (data.summary)
    for (const PartSummary& part : data.summary->parts) labels.parts.push_back(part.name);
  try {
    std::optional<View> view = make_view(data.folder, labels, most_bytes);
    if (view) data.views.push_back({title, std::move(*view)});
  } catch (const std::runtime_error& error) {
    data.notes.push_back(fmt::format("No view of the bodies: {}.", error.what()));
  }
}

}  // namespace carom
