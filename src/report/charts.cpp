#include "report/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "energy/energy_terms.hpp"
#include "output/readable_unit.hpp"
#include "report/decimate.hpp"
#include "report/place_text.hpp"

namespace carom {

namespace {

constexpr std::size_t kIntervals = 1000;
constexpr std::array<std::string_view, 4> kKinds{"\"computed\"", "\"raw\"", "\"filtered\"", "\"exact\""};

/// A chart before its curves are cut down: columns of one table that belong together.
struct Group {
  std::string section, title, label;
  std::vector<std::string> columns;
  bool is_by_place = false;  ///< one column for each place, whose number is its colour
  bool is_folded = false;
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

/// Name and colour of the curve of a column of a group.
Curve named(Curve curve, const Group& group, const std::string& column) {
  if (!group.is_by_place) return curve;
  curve.name = parse_column(column).place;
  curve.colour = static_cast<std::size_t>(std::ranges::find(group.columns, column) - group.columns.begin());
  return curve;
}

/// Of many curves those that rise highest are shown until the reader asks for others.
void show_highest(Chart& chart) {
  constexpr std::size_t most = 8;
  if (chart.curves.size() <= most) return;
  std::vector<double> heights;
  for (const Curve& curve : chart.curves) heights.push_back(largest_magnitude(curve.values));
  std::vector<double> sorted = heights;
  std::ranges::sort(sorted, std::greater<>());
  for (std::size_t k = 0; k < heights.size(); ++k) chart.curves[k].shown = heights[k] >= sorted[most - 1];
}

/// A column of another table that is laid over the computed one of the same name.
void add_overlay(Chart& chart, const std::string& column, const std::optional<CsvTable>& table, CurveKind kind,
                 std::string_view word) {
  const auto* values = table ? table->column(column) : nullptr;
  if (values == nullptr) return;
  chart.curves.push_back(make_curve(*table, *values, fmt::format("{}, {}", curve_name(column), word), kind));
}

double largest_of(const Group& group, const CsvTable& table) {
  double largest = 0.0;
  for (const std::string& column : group.columns) {
    if (const auto* values = table.column(column)) largest = std::max(largest, largest_magnitude(*values));
  }
  return largest;
}

/// What a table of filtered curves says of the records of a place or of a column.
std::string remarks_on_filters(const Group& group, const std::optional<CsvTable>& filtered) {
  std::string text;
  if (!filtered) return text;
  const std::string place = fmt::format("note: {}: ", parse_column(group.columns.front()).place);
  for (const std::string& comment : filtered->comments) {
    const auto is_of = [&](const std::string& column) { return comment.starts_with(column + ": not filtered"); };
    if (comment.starts_with(place)) {
      text += fmt::format(" Filtered: {}.", std::string_view(comment).substr(place.size()));
    } else if (is_of(group.columns.front())) {
      text +=
          fmt::format(" Not filtered: {}.", std::string_view(comment).substr(comment.find(": not filtered: ") + 16));
    }
  }
  return text;
}

/// The chart of a group that is not zero.
Chart make_chart(const Group& group, const CsvTable& table, const Tables& tables, const Units& units) {
  Chart chart{group.section, group.title, group.label, unit_of_column(units, group.columns.front()), {}, {}};
  const double scale = largest_of(group, table);
  chart.is_folded = group.is_folded;
  const bool is_contact = group.section == "Contact";
  const std::optional<CsvTable>& filtered = is_contact ? tables.contact_filtered : tables.probes_filtered;
  std::vector<std::string> left_out, drawn;
  for (const std::string& column : group.columns) {
    const auto* values = table.column(column);
    if (values == nullptr) continue;
    const bool is_negligible = largest_magnitude(*values) < kNegligible * scale;
    (is_negligible ? left_out : drawn).push_back(column);
  }
  for (const std::string& column : drawn) {
    const bool is_filtered = filtered && filtered->column(column) != nullptr;
    chart.curves.push_back(named(make_curve(table, *table.column(column), curve_name(column),
                                            is_filtered ? CurveKind::raw : CurveKind::computed),
                                 group, column));
  }
  if (group.is_by_place) show_highest(chart);
  for (const std::string& column : drawn) add_overlay(chart, column, filtered, CurveKind::filtered, "filtered");
  for (const std::string& column : drawn) add_overlay(chart, column, tables.exact, CurveKind::exact, "exact");
  for (std::string& column : left_out)
    column = group.is_by_place ? std::string(parse_column(column).place) : curve_name(column);
  if (!left_out.empty())
    chart.note = fmt::format("Not drawn, zero or below 1e-9 of the largest: {}.", fmt::join(left_out, ", "));
  if (is_contact || group.section == "Probes") chart.note += remarks_on_filters(group, filtered);
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
       {"ENER_CIN", "ENER_TOT", "TRAV_EXT", "TRAV_AMOR", "TRAV_LIAI", "DISS_SCH"},
       false,
       true},
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

/// Of tables of several places, one group per quantity and component.
std::vector<Group> groups_by_place(const CsvTable& table, const std::string& section) {
  std::vector<Group> groups;
  for (const std::string& column : table.columns) {
    if (column == "time") continue;
    const ColumnName name = parse_column(column);
    const std::string quantity = with_spaces(name.quantity);
    std::string title = name.component.empty() ? quantity : fmt::format("{}, {}", quantity, name.component);
    title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
    auto same = std::ranges::find(groups, title, &Group::title);
    if (same == groups.end()) same = groups.insert(same, {section, title, quantity, {}, true});
    same->columns.push_back(column);
  }
  if (!groups.empty() && groups.front().columns.size() < 2) groups.clear();  // of one part they are those of the ledger
  return groups;
}

/// Numbers of the group up to this cannot be told from rounding.
double rounding_of(const Group& group, const CsvTable& table, const Scales& scales) {
  constexpr double of_its_kind = 1e-12, of_position = 1e-15, of_energy = 1e-10;  // that of the verdict
  const bool is_of_parts = group.section == "Parts", is_momentum = group.label == "momentum";
  if (group.section == "Energies" || (is_of_parts && !is_momentum)) return of_energy * scales.energy;
  if (group.section == "Momentum" || is_of_parts)
    return of_its_kind * scales.momentum * (group.columns.front().starts_with("angular") ? scales.reach : 1.0);
  if (group.section == "Time steps") return 0.0;
  const auto largest = [&table](std::string_view quantity) {
    double most = 0.0;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (parse_column(table.columns[c]).quantity == quantity)
        most = std::max(most, largest_magnitude(table.values[c]));
    }
    return most;
  };
  const std::string_view quantity = parse_column(group.columns.front()).quantity;
  double rounding = of_its_kind * largest(quantity);
  if (quantity == "displacement") rounding = std::max(rounding, of_position * scales.reach);
  if (quantity == "velocity") rounding = std::max(rounding, of_its_kind * scales.speed);
  if (quantity == "moment") rounding = std::max(rounding, of_its_kind * scales.reach * largest("force"));
  return rounding;
}

/// Of an imbalance whose bound the run has kept to: what to say instead of drawing its noise.
std::optional<std::string> kept_bound(const Group& group, const std::optional<Summary>& summary) {
  static constexpr std::array<std::array<std::string_view, 2>, 3> items{
      {{"imbalance", "energy balance"},
       {"momentum_error", "linear momentum"},
       {"angular_momentum_error", "angular momentum"}}};
  constexpr double round_off = 1e-6;  // wider bounds are those of schemes' errors, which are worth a look
  if (!summary) return std::nullopt;
  for (const auto& [column, name] : items) {
    if (group.columns.front() != column) continue;
    for (const VerdictItem& item : summary->verdict) {
      if (item.name == name && item.pass && item.limit < round_off)
        return fmt::format("zero within the bound: at most {:.2g} of {:.2g} allowed, relative.", item.value,
                           item.limit);
    }
  }
  return std::nullopt;
}

/// The sum of the stored energies, drawn beside its terms.
void add_mechanical_energy(Chart& chart, const CsvTable& table) {
  std::vector<double> sum(table.rows(), 0.0);
  std::string name = "total: ";
  for (const EnergyTerm& term : energy_terms) {
    if (term.kind != TermKind::stored) continue;
    const auto* values = table.column(std::string(term.name));
    if (values == nullptr) return;
    std::transform(sum.begin(), sum.end(), values->begin(), sum.begin(), std::plus<>());
    if (!name.ends_with(' ')) name += " + ";
    name += with_spaces(term.name);
  }
  chart.curves.push_back(make_curve(table, sum, std::move(name), CurveKind::computed));
}

/// A step that does not change is a line of text.
std::optional<std::string> constant_step(const Group& group, const CsvTable& table, const Units& units) {
  const auto* dt = table.column("dt");
  if (group.columns.front() != "dt" || dt == nullptr || dt->size() < 3) return std::nullopt;
  const auto [least, most] = std::minmax_element(dt->begin() + 1, dt->end() - 1);  // the first row is before any step
  const double last = dt->back();
  if (!(*most - *least <= 1e-9 * *most) || last > *most * (1.0 + 1e-9)) return std::nullopt;
  const bool is_whole = last >= *most * (1.0 - 1e-9);
  return fmt::format("{}{}.", with_readable_unit(*most, units.time, 5),
                     is_whole ? " throughout" : ", the last shorter");
}

void add_charts(std::vector<Chart>& charts, const std::vector<Group>& groups, const CsvTable& table,
                const Tables& tables, const Units& units, const std::optional<Summary>& summary) {
  if (table.rows() == 0) return;
  const Scales scales = scales_of(tables, summary);
  std::vector<std::string> zero, rounding;
  std::vector<Chart> said;
  const auto finish_section = [&](const std::string& section) {
    if (!rounding.empty())
      said.push_back({section, "Round-off, not drawn:", {}, {}, {}, fmt::format("{}.", fmt::join(rounding, "; "))});
    if (!zero.empty())
      said.push_back({section, "Zero throughout:", {}, {}, {}, fmt::format("{}.", fmt::join(zero, "; "))});
    charts.insert(charts.end(), said.begin(), said.end());
    for (auto* list : {&zero, &rounding}) list->clear();
    said.clear();
  };
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Group& group = groups[g];
    if (g > 0 && group.section != groups[g - 1].section) finish_section(groups[g - 1].section);
    if (group.columns.empty()) continue;
    const double largest = largest_of(group, table);
    auto instead = kept_bound(group, summary);
    if (!instead) instead = constant_step(group, table, units);
    if (instead) {
      if (table.column(group.columns.front()) != nullptr)
        said.push_back({group.section, group.title + ":", {}, {}, {}, *instead});
    } else if (largest == 0.0) {
      const bool is_known = table.column(group.columns.front()) != nullptr;
      if (is_known && group.section != "Time steps") zero.push_back(group.title);
    } else if (largest <= rounding_of(group, table, scales)) {
      rounding.push_back(group.title);
    } else {
      charts.push_back(make_chart(group, table, tables, units));
      if (&group == groups.data() && group.section == "Energies") add_mechanical_energy(charts.back(), table);
    }
  }
  if (!groups.empty()) finish_section(groups.back().section);
}

void add_places(std::vector<Chart>& charts, const Units& units, const Summary& summary) {
  for (Chart& chart : charts) {
    for (const ProbeSummary& probe : summary.probes) {
      if (chart.section == "Probes" && chart.title.starts_with(probe.name + " · "))
        chart.place =
            fmt::format("{} at {}", probe.place, place_text(probe.position, summary.mesh.reach, units.length));
    }
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

std::string numbered(const char* key, const std::optional<std::size_t>& number) {
  return number ? fmt::format("\"{}\":{},", key, *number) : "";
}

/// Eight digits are more than a screen resolves and as many as the checks compare.
std::string json_numbers(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) fmt::format_to(std::back_inserter(text), "{:.8g},", value);
  if (text.back() == ',') text.pop_back();
  return text + "]";
}

}  // namespace

Scales scales_of(const Tables& tables, const std::optional<Summary>& summary) {
  Scales scales;
  if (tables.energy) {
    for (const EnergyTerm& term : energy_terms) {
      const bool is_counted = term.kind == TermKind::stored || term.kind == TermKind::supplied;
      const auto* values = is_counted ? tables.energy->column(std::string(term.name)) : nullptr;
      if (values != nullptr) scales.energy = std::max(scales.energy, largest_magnitude(*values));
    }
  }
  if (!summary) return scales;
  double mass = 0.0;
  for (const PartSummary& part : summary->parts) mass += part.mass;
  scales.momentum = std::sqrt(2.0 * mass * scales.energy);
  if (mass > 0.0) scales.speed = scales.momentum / mass;
  scales.reach = summary->mesh.reach;
  return scales;
}

Curve make_curve(const CsvTable& table, const std::vector<double>& values, std::string name, CurveKind kind) {
  const std::vector<double>& time = table.values.front();
  Curve curve{std::move(name), {}, {}, kind};
  for (const std::size_t row : decimate(time, values, kIntervals)) {
    curve.time.push_back(time[row]);
    curve.values.push_back(values[row]);
  }
  return curve;
}

std::vector<Chart> make_charts(const Tables& tables, const Units& units, const std::optional<Summary>& summary) {
  std::vector<Chart> charts;
  const auto add = [&](const std::vector<Group>& groups, const CsvTable& table) {
    add_charts(charts, groups, table, tables, units, summary);
  };
  if (tables.probes) add(place_groups(*tables.probes, "Probes"), *tables.probes);
  if (tables.contact) add(place_groups(*tables.contact, "Contact"), *tables.contact);
  if (tables.parts) add(groups_by_place(*tables.parts, "Parts"), *tables.parts);
  if (tables.energy) add(energy_groups(*tables.energy), *tables.energy);
  if (summary) add_places(charts, units, *summary);
  for (Chart& chart : charts) {
    const std::string_view label = chart.label;
    chart.is_count = label == "iterations" || label == "closed" || label == "closings";
  }
  return charts;
}

std::string charts_json(const ChartData& data) {
  double longest = 0.0;
  for (const Chart& chart : data.charts)
    for (const Curve& curve : chart.curves) longest = std::max(longest, largest_magnitude(curve.time));
  const ReadableUnit time = readable_unit(longest, data.time_unit);
  std::string text =
      fmt::format("{{\"time_unit\":{},\"time_power\":{},\"marks\":[", json_string(time.name), time.power);
  const auto end_list = [&text](std::string_view end) {
    if (text.back() == ',') text.pop_back();
    text += end;
  };
  for (const TimeMark& mark : data.marks)
    fmt::format_to(std::back_inserter(text), "{{\"t\":{:.8g},\"name\":{}}},", mark.time, json_string(mark.name));
  end_list("],\"charts\":[");
  for (const Chart& chart : data.charts) {
    if (chart.curves.empty()) continue;
    double largest = 0.0;
    for (const Curve& curve : chart.curves) largest = std::max(largest, largest_magnitude(curve.values));
    const ReadableUnit unit = chart.is_count ? ReadableUnit{} : readable_unit(largest, chart.unit);
    fmt::format_to(std::back_inserter(text), "\n{{\"label\":{},\"unit\":{},\"power\":{},\"count\":{},\"curves\":[",
                   json_string(chart.label), json_string(unit.name), unit.power, chart.is_count);
    for (const Curve& curve : chart.curves) {
      fmt::format_to(std::back_inserter(text), "{{\"name\":{},\"kind\":{},\"shown\":{},{}{}\"t\":{},\"y\":{}}},",
                     json_string(curve.name), kKinds.at(static_cast<std::size_t>(curve.kind)), curve.shown,
                     numbered("colour", curve.colour), numbered("line", curve.line), json_numbers(curve.time),
                     json_numbers(curve.values));
    }
    end_list("]},");
  }
  end_list("]}");
  return text;
}

}  // namespace carom
