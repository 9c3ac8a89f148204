#include "compare/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/curve_colours.hpp"
#include "compare/histories.hpp"
#include "compare/log_plot.hpp"
#include "output/xml.hpp"
#include "report/assets.hpp"
#include "report/html.hpp"

namespace carom::compare {

namespace {

std::string percent(double ratio, int digits) {
  return std::isfinite(ratio) ? fmt::format("{:.{}g} %", 100.0 * ratio, digits) : "–";
}

std::string header(const Comparison& c) {
  const Recommendation& advice = c.recommendation;
  std::string html = fmt::format(
      "<header>\n<p class=\"kicker\">Carom · comparison{}</p>\n<h1>{}</h1>\n"
      "<div class=\"banner {}\" role=\"status\"><strong>{}</strong><span>{}</span></div>\n<ul>\n",
      c.common.empty() ? "" : xml_escape(" · in all variants: " + c.common), xml_escape(c.title),
      advice.result ? "good" : "stopped", advice.result ? "Recommended" : "No recommendation",
      xml_escape(advice.headline));
  for (const std::string& reason : advice.reasons) html += fmt::format("<li>{}</li>\n", xml_escape(reason));
  return html + "</ul>\n</header>\n";
}

std::string reference_name(const Comparison& c) {
  return c.reference == ReferenceKind::exact ? "exact" : "reference";
}

TableRow row(const Comparison& c, std::size_t i, const std::vector<std::string>& quantities) {
  const Result& r = c.results[i];
  const double peak = r.reference_peak_force > 0.0 ? r.peak_force / r.reference_peak_force : std::nan("");
  const std::vector<std::string> items = r.failed_items();
  TableRow row{{fmt::format("<a href=\"variants/{}/report.html\">{}</a>{}{}", xml_escape(r.variant.name),
                            xml_escape(r.variant.label), r.is_reference ? " (reference)" : "",
                            c.recommendation.result == i ? " <strong>recommended</strong>" : "")},
               text_cell(r.variant.enforcement)};
  for (const std::string& quantity : quantities)
    row.push_back(number_cell(r.is_reference ? "–" : percent(r.error(quantity), 3)));
  for (const std::string& text :
       {percent(r.claimed, 3), number_text(peak, 4), percent(r.energy_kept, 5), number_text(r.penetration, 3),
        number_text(r.step() / r.variant.element_step, 3),
        r.summary ? std::to_string(r.summary->scheme.steps) : std::string("–"), number_text(r.cpu_seconds(), 3)})
    row.push_back(number_cell(text));
  const bool pass = items.empty();
  row.push_back(pass ? TableCell{"✓ pass", "mark pass"}
                     : TableCell{xml_escape(fmt::format("✗ {}", fmt::join(items, ", "))), "mark fail"});
  return row;
}

/// Whose errors the table shows: force and velocity where they were compared, else what variants are ranked by.
std::vector<std::string> shown_quantities(const Comparison& c) {
  std::vector<std::string> shown;
  for (const char* quantity : {"force", "velocity"}) {
    const auto has = [quantity](const Result& r) { return std::isfinite(r.error(quantity)); };
    if (std::any_of(c.results.begin(), c.results.end(), has)) shown.emplace_back(quantity);
  }
  if (shown.empty() && !c.quantity.empty()) shown.push_back(c.quantity);
  return shown;
}

std::string main_table(const Comparison& c) {
  const Units units = units_of(c.units);
  const std::vector<std::string> quantities = shown_quantities(c);
  std::vector<TableColumn> columns{{"Variant"}, {"contact"}};
  for (const std::string& quantity : quantities)
    columns.push_back({(c.reference == ReferenceKind::exact ? "error, " : "off reference, ") + quantity, true});
  for (const std::string& title :
       {"claimed error, " + c.quantity, "peak / " + reference_name(c), std::string("energy kept"),
        units.length.empty() ? std::string("penetration") : fmt::format("penetration [{}]", units.length),
        std::string("Courant"), std::string("steps"), std::string("CPU [s]")})
    columns.push_back({title, true});
  columns.push_back({"verdict"});
  std::vector<TableRow> rows;
  for (std::size_t i = 0; i < c.results.size(); ++i)
    if (c.results[i].failure.empty()) rows.push_back(row(c, i, quantities));
  if (rows.empty()) return "";
  return "<section>\n<h2>Variants</h2>\n" + html_table(columns, rows, "wide") +
         fmt::format(
             "<p class=\"note\">Errors are relative L2 norms over the time of the run, all "
             "columns of the quantity together, against {}. Claimed: what runs of other cells, steps and enforcements "
             "say of the error, without any exact solution. Peak: largest contact force over that of the reference. "
             "Energy kept: 1 minus what the computation lost, over the larger of initial and supplied energy; 100 % is "
             "exact. Courant: step over shortest cell / fastest wave. CPU: processor time of the whole run on one "
             "thread. compare.csv and compare.json hold all of it, and L1 norms.</p>\n</section>\n",
             xml_escape(c.reference_text()));
}

std::string remarks_table(const std::vector<Remark>& remarks, std::string_view title, const std::string& heading) {
  if (remarks.empty()) return "";
  std::vector<TableRow> rows;
  for (const Remark& r : remarks) rows.push_back({text_cell(r.variants), text_cell(r.text)});
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", title,
                     html_table({{"Variants"}, {heading}}, rows, "wide even"));
}

/// Ticks of the horizontal axis: where the points are, or at round numbers.
enum class Ticks : std::uint8_t { points, round };

LogPlot plot_of(const Comparison& c, const std::vector<Series>& all, std::string title, std::string x_label,
                Ticks ticks) {
  LogPlot plot{std::move(title), std::move(x_label), fmt::format("relative L2 error, {}", c.quantity), {}, {}};
  const std::vector<std::size_t> colours = curve_colours(c.results);
  for (const Series& s : all) {
    LogCurve curve{s.order ? fmt::format("{}: order {}", s.name, to_string(*s.order)) : s.name,
                   {},
                   colours[s.points.front().result]};
    for (const Point& p : s.points) {
      const Result& r = c.results[p.result];
      curve.points.push_back(
          {p.x, p.y, fmt::format("{}: error {}, {:.3g} s", r.variant.label, percent(p.y, 3), r.cpu_seconds())});
    }
    plot.curves.push_back(std::move(curve));
  }
  if (ticks == Ticks::points) {
    for (const LogCurve& curve : plot.curves) {
      for (const LogPoint& p : curve.points) plot.x_ticks.push_back(p.x);
    }
  }
  return plot;
}

std::string plots(const Comparison& c) {
  const Units units = units_of(c.units);
  const auto in = [](const char* name, const std::string& unit) {
    return unit.empty() ? std::string(name) : fmt::format("{} [{}]", name, unit);
  };
  std::string html;
  const auto add = [&](const std::vector<Series>& all, const char* title, const std::string& x_label, Ticks ticks) {
    if (!all.empty()) html += log_plot(plot_of(c, all, title, x_label, ticks));
  };
  const bool halves_a_file = std::all_of(c.results.begin(), c.results.end(), [](const Result& r) {
    return r.variant.choice.refine && r.variant.cells == 1 << *r.variant.choice.refine;
  });
  add(series_along(c.results, Along::cells, c.quantity), "Convergence with the mesh",
      halves_a_file ? "cells along each edge of a cell of the mesh" : "cells along the longest edge", Ticks::points);
  add(series_along(c.results, Along::step, c.quantity), "Convergence with the step", in("time step", units.time),
      Ticks::round);
  add(series_along(c.results, Along::stiffness, c.quantity), "Influence of the contact stiffness", "stiffness",
      Ticks::points);
  add(series_of_cost(c.results, c.quantity, c.reference), "Error against cost", "processor time [s]", Ticks::round);
  if (html.empty()) return "";
  return "<section>\n<h2>Convergence and cost</h2>\n<div class=\"charts\">\n" + html +
         "</div>\n<p class=\"note\">Orders are slopes by least squares over all points of a line, of three at least, "
         "and in brackets the least and the largest between neighbours: error ~ (1 / cells)^p, step^p, (1 / "
         "stiffness)^p. Variants that share mesh, step or enforcement with a run that they are compared with are left "
         "out; costs are over the claimed error where there is no exact solution.</p>\n</section>\n";
}

}  // namespace

std::string make_page(const Comparison& comparison, const std::string& case_text) {
  const std::vector<Chart> histories = make_histories(comparison);
  const std::string content =
      header(comparison) + main_table(comparison) +
      remarks_table(observations(comparison), "What strikes in these numbers", "what") + plots(comparison) +
      chart_figures(histories) + remarks_table(failures(comparison), "Not compared", "why") +
      remarks_table(changes(comparison), "Changes that the choices brought with them", "change") + "<footer>\n" +
      foldable("The case that was varied", case_text) +
      foldable("Licence of dygraphs, which draws the curves", assets::dygraph_licence) + "</footer>\n";
  return html_document(comparison.title + ": comparison", content, {histories, units_of(comparison.units).time});
}

}  // namespace carom::compare
