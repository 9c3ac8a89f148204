#include "compare/histories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "compare/curve_colours.hpp"
#include "energy/energy_terms.hpp"
#include "output/units.hpp"

namespace carom::compare {

namespace {

constexpr std::size_t kShown = 8;

/// Positions of the results that have curves, the smallest error first.
std::vector<std::size_t> ranked(const Comparison& comparison) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < comparison.results.size(); ++i) {
    const Result& r = comparison.results[i];
    if (r.failure.empty() && !r.is_reference && r.curves.rows() > 0) order.push_back(i);
  }
  const auto error = [&](std::size_t i) {
    const double e = comparison.results[i].error(comparison.quantity);
    return std::isnan(e) ? HUGE_VAL : e;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return error(a) < error(b); });
  return order;
}

std::vector<double> mechanical_energy(const CsvTable& table) {
  std::vector<double> sum(table.rows(), 0.0);
  for (const EnergyTerm& term : energy_terms) {
    if (term.kind != TermKind::stored) continue;
    const std::vector<double>* values = table.column(std::string(term.name));
    if (values == nullptr) return {};
    std::transform(sum.begin(), sum.end(), values->begin(), sum.begin(), std::plus<>());
  }
  return sum;
}

/// The table that the variants are compared with, or nullptr.
const CsvTable* reference_table(const Comparison& comparison, const std::vector<std::size_t>& order) {
  if (const Result* finest = comparison.finest()) return &finest->curves;
  // The exact solution on the rows of the variant that has most of them.
  const CsvTable* longest = nullptr;
  for (const std::size_t i : order) {
    const auto& exact = comparison.results[i].exact;
    if (exact && (longest == nullptr || exact->rows() > longest->rows())) longest = &*exact;
  }
  return longest;
}

/// values_of(table): what the chart shows of it; empty when it has nothing.
template <class Values>
Chart make_history(const Comparison& comparison, const std::vector<std::size_t>& order, Chart chart,
                   const Values& values_of) {
  const std::size_t hidden = order.size() > kShown ? order.size() - kShown : 0;
  const std::vector<std::size_t> colours = curve_colours(comparison.results);
  const auto add = [&](std::size_t k) {
    const Result& r = comparison.results[order[k]];
    const std::vector<double> values = values_of(r.curves);
    if (values.empty()) return;
    chart.curves.push_back(make_curve(r.curves, values, r.variant.label, CurveKind::computed));
    chart.curves.back().shown = k < kShown;
    chart.curves.back().colour = colours[order[k]];
  };
  for (std::size_t k = std::min(kShown, order.size()); k > 0; --k) add(k - 1);
  for (std::size_t k = kShown; k < order.size(); ++k) add(k);
  if (hidden > 0)
    chart.note = fmt::format(
        "The {} variants of larger error are hidden; open the list and click their names to see them.", hidden);
  if (const CsvTable* reference = reference_table(comparison, order)) {
    const std::vector<double> values = values_of(*reference);
    const Result* finest = comparison.finest();
    const std::string name = finest != nullptr ? "reference: " + finest->variant.label : "exact";
    if (!values.empty()) chart.curves.push_back(make_curve(*reference, values, name, CurveKind::exact));
  }
  return chart;
}

}  // namespace

std::vector<Chart> make_histories(const Comparison& comparison) {
  const std::vector<std::size_t> order = ranked(comparison);
  std::vector<Chart> charts;
  if (order.empty()) return charts;
  const Units units = units_of(comparison.units);
  for (const char* quantity : {"force", "velocity"}) {
    for (const NamedError& error : comparison.results[order.front()].columns) {
      const ColumnName name = parse_column(error.name);
      if (name.quantity != quantity) continue;
      const auto values = [&error](const CsvTable& table) {
        const std::vector<double>* column = table.column(error.name);
        return column == nullptr ? std::vector<double>{} : *column;
      };
      const std::string title = fmt::format("{} · {} {}", name.place, name.quantity, name.component);
      charts.push_back(make_history(
          comparison, order,
          {"Histories", title, std::string(name.quantity), unit_of_column(units, error.name), {}, {}}, values));
    }
  }
  charts.push_back(make_history(comparison, order, {"Histories", "Mechanical energy", "energy", units.energy, {}, {}},
                                mechanical_energy));
  std::erase_if(charts, [](const Chart& chart) { return chart.curves.empty(); });
  return charts;
}

}  // namespace carom::compare
