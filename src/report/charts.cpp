#include "report/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "report/decimate.hpp"

namespace carom {

namespace {

constexpr std::size_t kIntervals = 1000;
constexpr double kNegligible = 1e-9;
constexpr std::array<std::string_view, 3> kKinds{"\"computed\"", "\"filtered\"", "\"exact\""};

/// A chart before its curves are cut down: columns of one table that belong together.
struct Group {
  std::string section, title, label;
  std::vector<std::string> columns;
};

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

/// Name of a curve in its chart: the component where there is one ("z"), else the quantity.
std::string curve_name(const std::string& column) {
  const ColumnName name = parse_column(column);
  std::string text(name.component.empty() ? name.quantity : name.component);
  std::replace(text.begin(), text.end(), '_', ' ');
  return column.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == 0 && name.place.empty() ? column : text;
}

/// A column of another table that is laid over the computed one of the same name.
struct Overlay {
  const std::optional<CsvTable>& table;
  CurveKind kind;
  std::string_view word;
};

void add_overlay(Chart& chart, const std::string& column, const Overlay& overlay) {
  const auto* values = overlay.table ? overlay.table->column(column) : nullptr;
  if (values == nullptr) return;
  chart.curves.push_back(
      make_curve(*overlay.table, *values, fmt::format("{}, {}", curve_name(column), overlay.word), overlay.kind));
}

/// The chart of a group, or nothing when none of its columns is there or all are zero.
std::optional<Chart> make_chart(const Group& group, const CsvTable& table, const Tables& tables, const Units& units) {
  double scale = 0.0;
  for (const std::string& column : group.columns) {
    if (const auto* values = table.column(column)) scale = std::max(scale, largest_magnitude(*values));
  }
  if (scale == 0.0) return std::nullopt;
  Chart chart{group.section, group.title, group.label, unit_of_column(units, group.columns.front()), {}, {}};
  std::vector<std::string> left_out;
  for (const std::string& column : group.columns) {
    const auto* values = table.column(column);
    if (values == nullptr) continue;
    if (largest_magnitude(*values) < kNegligible * scale) {
      left_out.push_back(curve_name(column));
      continue;
    }
    chart.curves.push_back(make_curve(table, *values, curve_name(column), CurveKind::computed));
    add_overlay(chart, column, {tables.probes_filtered, CurveKind::filtered, "filtered"});
    add_overlay(chart, column, {tables.exact, CurveKind::exact, "exact"});
  }
  if (!left_out.empty()) {
    chart.note = fmt::format("Not drawn, zero or below 1e-9 of the largest: {}.", fmt::join(left_out, ", "));
  }
  return chart;
}

std::string with_spaces(std::string_view text) {
  std::string spaced(text);
  std::replace(spaced.begin(), spaced.end(), '_', ' ');
  return spaced;
}

std::vector<Group> energy_groups(const CsvTable& table) {
  std::vector<Group> groups{
      {"Energies", "Energies and work", "energy", {}},
      {"Energies", "Numerical energies", "energy", {"quadrature", "algorithmic"}},
      {"Energies", "Imbalance of powers", "energy", {"imbalance"}},
      {"Energies",
       "In Code_Aster's terms",
       "energy",
       {"ENER_CIN", "ENER_TOT", "TRAV_EXT", "TRAV_AMOR", "TRAV_LIAI", "DISS_SCH"}},
      {"Momentum", "Linear momentum", "momentum", {"momentum_x", "momentum_y", "momentum_z"}},
      {"Momentum",
       "Angular momentum",
       "angular momentum",
       {"angular_momentum_x", "angular_momentum_y", "angular_momentum_z"}},
      {"Momentum", "Imbalance of linear momentum", "momentum", {"momentum_error"}},
      {"Momentum", "Imbalance of angular momentum", "angular momentum", {"angular_momentum_error"}},
      {"Time steps", "Time step", "dt", {"dt"}},
      {"Time steps", "Iterations per step", "iterations", {"iterations"}},
  };
  for (const std::string& column : table.columns) {
    const bool elsewhere =
        column == "time" || column == "step" ||
        std::any_of(groups.begin() + 1, groups.end(), [&column](const Group& group) {
          return std::find(group.columns.begin(), group.columns.end(), column) != group.columns.end();
        });
    if (!elsewhere) groups.front().columns.push_back(column);
  }
  return groups;
}

/// One group per place and quantity, in the order of the columns.
std::vector<Group> place_groups(const CsvTable& table, const std::string& section) {
  std::vector<Group> groups;
  for (const std::string& column : table.columns) {
    if (column == "time") continue;
    const ColumnName name = parse_column(column);
    const std::string quantity = with_spaces(name.quantity);
    const std::string title = name.place.empty() ? quantity : fmt::format("{} · {}", name.place, quantity);
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.title == title; });
    if (same != groups.end()) {
      same->columns.push_back(column);
    } else {
      groups.push_back({section, title, quantity, {column}});
    }
  }
  return groups;
}

void add_charts(std::vector<Chart>& charts, const std::vector<Group>& groups, const CsvTable& table,
                const Tables& tables, const Units& units) {
  if (table.rows() == 0) return;
  for (const Group& group : groups) {
    if (group.columns.empty()) continue;
    if (auto chart = make_chart(group, table, tables, units)) charts.push_back(std::move(*chart));
  }
}

std::string json_string(const std::string& text) {
  using Json = nlohmann::json;
  std::string quoted = Json(text).dump(-1, ' ', true, Json::error_handler_t::replace);
  std::string safe;
  for (const char c : quoted) {
    if (c == '<') {
      safe += "\\u003c";  // no "</script>" and no "<!--" inside the page's script element
    } else {
      safe += c;
    }
  }
  return safe;
}

/// Eight digits are more than a screen resolves and as many as the checks compare.
std::string json_numbers(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) fmt::format_to(std::back_inserter(text), "{:.8g},", value);
  if (text.back() == ',') text.pop_back();
  return text + "]";
}

}  // namespace

Curve make_curve(const CsvTable& table, const std::vector<double>& values, std::string name, CurveKind kind) {
  const std::vector<double>& time = table.values.front();
  Curve curve{std::move(name), {}, {}, kind};
  for (const std::size_t row : decimate(time, values, kIntervals)) {
    curve.time.push_back(time[row]);
    curve.values.push_back(values[row]);
  }
  return curve;
}

std::vector<Chart> make_charts(const Tables& tables, const Units& units) {
  std::vector<Chart> charts;
  if (tables.probes) add_charts(charts, place_groups(*tables.probes, "Probes"), *tables.probes, tables, units);
  if (tables.contact) add_charts(charts, place_groups(*tables.contact, "Contact"), *tables.contact, tables, units);
  if (tables.energy) add_charts(charts, energy_groups(*tables.energy), *tables.energy, tables, units);
  return charts;
}

std::string charts_json(const std::vector<Chart>& charts, const Units& units) {
  std::string text = fmt::format("{{\"time_unit\":{},\"charts\":[", json_string(units.time));
  for (const Chart& chart : charts) {
    fmt::format_to(std::back_inserter(text), "\n{{\"label\":{},\"unit\":{},\"curves\":[", json_string(chart.label),
                   json_string(chart.unit));
    for (const Curve& curve : chart.curves) {
      fmt::format_to(std::back_inserter(text), "{{\"name\":{},\"kind\":{},\"shown\":{},\"t\":{},\"y\":{}}},",
                     json_string(curve.name), kKinds.at(static_cast<std::size_t>(curve.kind)), curve.shown,
                     json_numbers(curve.time), json_numbers(curve.values));
    }
    if (text.back() == ',') text.pop_back();
    text += "]},";
  }
  if (text.back() == ',') text.pop_back();
  return text + "]}";
}

}  // namespace carom
