#include "report/page_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "output/xml.hpp"
#include "report/html.hpp"

namespace carom {

namespace {

/// Difference in percent of the reference, or as it is where the reference is zero or the tolerance absolute.
std::string difference(const CheckSummary& check) {
  if (check.tolerance_kind == ToleranceKind::absolute || check.reference == 0.0)
    return number_text(check.difference, 3);
  return number_text(100.0 * check.difference / std::abs(check.reference), 3) + " %";
}

std::string tolerance(const CheckSummary& check) {
  if (check.tolerance_kind == ToleranceKind::absolute) return fmt::format("± {}", number_text(check.tolerance, 3));
  return fmt::format("± {} %", number_text(100.0 * check.tolerance, 3));
}

std::string value_table(const std::string& title, const std::vector<NamedValue>& values, const std::string& unit) {
  if (values.empty()) return {};
  std::vector<TableRow> rows;
  for (const NamedValue& entry : values) {
    std::string name = entry.name;
    if (name.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") != 0) std::replace(name.begin(), name.end(), '_', ' ');
    rows.push_back({text_cell(name), number_cell(number_text(entry.value, 9))});
  }
  return html_table({{title}, {unit.empty() ? "energy" : fmt::format("energy [{}]", unit), true}}, rows);
}

TableCell vector_cell(const Vec3& v) {
  return number_cell(fmt::format("({}, {}, {})", number_text(v[0], 5), number_text(v[1], 5), number_text(v[2], 5)));
}

std::string momentum_table(const Summary& summary, const Units& units) {
  const auto row = [&units](const std::string& text, std::string_view column, const MomentumSummary& m) {
    const std::string unit = unit_of_column(units, column);
    return TableRow{text_cell(unit.empty() ? text : fmt::format("{} [{}]", text, unit)), vector_cell(m.begin),
                    vector_cell(m.end), vector_cell(m.impulse), number_cell(number_text(m.error, 2))};
  };
  return html_table({{"Momentum balance"},
                     {"at the beginning", true},
                     {"at the end", true},
                     {"impulse from outside", true},
                     {"largest error, relative", true}},
                    {row("linear", "momentum_x", summary.linear_momentum),
                     row("angular", "angular_momentum_x", summary.angular_momentum)});
}

std::string phases(const CostSummary& cost) {
  std::string text;
  for (const NamedValue& phase : cost.phases) {
    fmt::format_to(std::back_inserter(text), "{}{} {} s", text.empty() ? "" : ", ", phase.name,
                   number_text(phase.value, 3));
  }
  return text;
}

std::string groups(const MeshSummary& mesh) {
  std::string text;
  for (const MeshSummary::Group& group : mesh.groups) {
    fmt::format_to(std::back_inserter(text), "{}{} ({} nodes, {} cells)", text.empty() ? "" : ", ", group.name,
                   group.nodes, group.cells);
  }
  return text;
}

std::string steps(const SchemeSummary& scheme, const Units& units) {
  const std::string smallest = with_readable_unit(scheme.dt_smallest, units.time, 4);
  if (scheme.dt_smallest == scheme.dt_largest) return fmt::format("{} of {}", scheme.steps, smallest);
  return fmt::format("{} of {} to {}", scheme.steps, smallest, with_readable_unit(scheme.dt_largest, units.time, 4));
}

}  // namespace

std::string verdict_table(const Summary& summary) {
  if (summary.verdict.empty()) return {};
  std::vector<TableRow> rows, failed;
  for (const VerdictItem& item : summary.verdict) {
    rows.push_back({text_cell(item.name), number_cell(number_text(item.value, 3)),
                    number_cell(fmt::format("≤ {}", number_text(item.limit, 3))), mark_cell(item.pass),
                    text_cell(item.explanation)});
    if (!item.pass) failed.push_back(rows.back());
  }
  const auto table = [](const std::vector<TableRow>& shown) {
    return html_table({{"Item"}, {"value", true}, {"limit", true}, {""}, {"meaning"}}, shown);
  };
  const bool is_at_end = summary.outcome == Outcome::good || summary.outcome == Outcome::failed;
  if (is_at_end) return "<section>\n<h2>Verdict</h2>\n" + table(rows) + "</section>\n";
  // What an unfinished run has kept to so far does not say that it is right.
  return fmt::format(
      "<section>\n<h2>No verdict: the run did not reach its end</h2>\n{}<details><summary>The items up to there: {} of "
      "{} within their limits</summary>\n{}</details>\n</section>\n",
      failed.empty() ? "" : table(failed), rows.size() - failed.size(), rows.size(), table(rows));
}

namespace {

/// As notes of a translation end where the user has accepted a loss (translate/findings.cpp).
constexpr std::string_view accepted_mark = " (accepted)";

bool is_lost(const std::string& note) {
  return note.ends_with(accepted_mark);
}

std::string lines_list(std::string_view title, std::string_view style, const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  std::string html = fmt::format("<section>\n<h2>{}</h2>\n<ul class=\"{}\">\n", title, style);
  for (const std::string& line : lines) html += fmt::format("<li>{}</li>\n", xml_escape(line));
  return html + "</ul>\n</section>\n";
}

}  // namespace

std::string warnings_list(const Summary& summary) {
  return lines_list("Warnings", "notes", summary.warnings);
}

std::string notes_list(const Summary& summary) {
  std::vector<std::string> others;
  for (const std::string& note : summary.notes)
    if (!is_lost(note)) others.push_back(note);
  return lines_list("Notes", "remarks", others);
}

std::vector<std::string> lost_of_deck(const Summary& summary) {
  std::vector<std::string> lost;
  for (const std::string& note : summary.notes)
    if (is_lost(note)) lost.push_back(note.substr(0, note.size() - accepted_mark.size()));
  return lost;
}

std::string checks_table(const Summary& summary, const Units& units) {
  if (summary.checks.empty()) return {};
  std::vector<TableRow> rows;
  for (const CheckSummary& check : summary.checks) {
    const bool is_reached = !std::isnan(check.value);
    rows.push_back({text_cell(check.name), number_cell(number_text(check.time, 6)),
                    number_cell(number_text(check.value, 9)), number_cell(number_text(check.reference, 9)),
                    text_cell(unit_of_column(units, check.quantity)), number_cell(difference(check)),
                    number_cell(tolerance(check)),
                    is_reached ? mark_cell(check.pass) : TableCell{"not reached", "mark"}, text_cell(check.source)});
  }
  return "<section>\n<h2>Checks</h2>\n" +
         html_table({{"Quantity"},
                     {units.time.empty() ? "time" : fmt::format("time [{}]", units.time), true},
                     {"value", true},
                     {"reference", true},
                     {"unit"},
                     {"difference", true},
                     {"tolerance", true},
                     {""},
                     {"source"}},
                    rows) +
         "</section>\n";
}

std::string ledger_tables(const Summary& summary, const Units& units) {
  return "<section>\n<h2>Energy and momentum at the end</h2>\n<div class=\"columns\">\n" +
         value_table("Energy ledger", summary.ledger, units.energy) +
         (summary.code_aster.empty() ? ""
                                     : "<details><summary>In Code_Aster's terms</summary>\n" +
                                           value_table("Term", summary.code_aster, units.energy) + "</details>\n") +
         "</div>\n" + momentum_table(summary, units) + "</section>\n";
}

std::string run_table(const Summary& summary, const Units& units) {
  std::string html = "<section>\n<h2>What was run</h2>\n<dl>\n";
  const auto entry = [&html](std::string_view name, const std::string& text) {
    if (!text.empty()) html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, xml_escape(text));
  };
  const SchemeSummary& scheme = summary.scheme;
  entry("Case", summary.case_info.file);
  entry("Units", fmt::format("{} ({})", summary.case_info.units, units_comment(units).substr(7)));
  entry("Mesh", fmt::format("{} nodes, {} cells", summary.mesh.nodes, summary.mesh.cells));
  entry("Groups", groups(summary.mesh));
  if (scheme.stages.size() < 2) entry("Scheme", scheme.name);
  for (std::size_t i = 0; i < scheme.stages.size() && scheme.stages.size() > 1; ++i) {
    const StageSummary& stage = scheme.stages[i];
    entry(fmt::format("Stage {}", i + 1),
          fmt::format("{}, from {} to {}", stage.name, with_readable_unit(stage.begin, units.time, 4),
                      with_readable_unit(stage.end, units.time, 4)));
  }
  entry("Linear solver", scheme.solver);
  for (const std::string& note : scheme.mass_notes) entry("Mass", note);
  entry("Steps", steps(scheme, units));
  entry("Time", fmt::format("{} of {}", with_readable_unit(scheme.time_reached, units.time, 4),
                            with_readable_unit(scheme.time_end, units.time, 4)));
  entry("Program",
        fmt::format("carom {}, {}, kernels {}, {} thread{}", summary.program.version, summary.program.compiler,
                    summary.program.isa, summary.program.threads, summary.program.threads == 1 ? "" : "s"));
  entry("Wall clock", number_text(summary.cost.wall_seconds, 3) + " s");
  entry("Processor", number_text(summary.cost.cpu_seconds, 3) + " s");
  entry("Phases", phases(summary.cost));
  if (summary.cost.ranks > 1)
    entry("Processes", fmt::format("{}, of which the first has sent {} messages, {:.3g} MB", summary.cost.ranks,
                                   summary.cost.messages, 1e-6 * static_cast<double>(summary.cost.sent_bytes)));
  entry("Memory", fmt::format("{:.1f} MiB at most", static_cast<double>(summary.cost.peak_memory_bytes) / 1048576.0));
  return html + "</dl>\n</section>\n";
}

}  // namespace carom
