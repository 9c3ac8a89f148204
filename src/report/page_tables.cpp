#include "report/page_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string_view>

#include "output/xml.hpp"
#include "report/html.hpp"

namespace carom {

namespace {

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

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

std::string value_table(std::string_view title, const std::vector<NamedValue>& values, const std::string& unit) {
  if (values.empty()) return {};
  std::string html = fmt::format(
      "<div class=\"scroll\"><table><thead><tr><th>{}</th><th class=\"number\">{}</th></tr></thead><tbody>\n", title,
      xml_escape(unit.empty() ? "energy" : fmt::format("energy [{}]", unit)));
  for (const NamedValue& entry : values) {
    std::string name = entry.name;
    if (name.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") != 0) {
      for (char& c : name) c = c == '_' ? ' ' : c;
    }
    html += fmt::format("<tr>{}{}</tr>\n", text_cell(name), number_cell(number_text(entry.value, 9)));
  }
  return html + "</tbody></table></div>\n";
}

std::string vector_cell(const Vec3& v) {
  return number_cell(fmt::format("({}, {}, {})", number_text(v[0], 5), number_text(v[1], 5), number_text(v[2], 5)));
}

std::string momentum_table(const Summary& summary, const Units& units) {
  std::string html =
      "<div class=\"scroll\"><table><thead><tr><th>Momentum balance</th><th class=\"number\">at the beginning</th>"
      "<th class=\"number\">at the end</th><th class=\"number\">impulse from outside</th>"
      "<th class=\"number\">largest error, relative</th></tr></thead><tbody>\n";
  const auto row = [&html](const std::string& name, const MomentumSummary& m) {
    html += fmt::format("<tr>{}{}{}{}{}</tr>\n", text_cell(name), vector_cell(m.begin), vector_cell(m.end),
                        vector_cell(m.impulse), number_cell(number_text(m.error, 2)));
  };
  const auto name = [&units](const std::string& text, std::string_view column) {
    const std::string unit = unit_of_column(units, column);
    return unit.empty() ? text : fmt::format("{} [{}]", text, unit);
  };
  row(name("linear", "momentum_x"), summary.linear_momentum);
  row(name("angular", "angular_momentum_x"), summary.angular_momentum);
  return html + "</tbody></table></div>\n";
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
  const std::string smallest = with_unit(number_text(scheme.dt_smallest, 6), units.time);
  if (scheme.dt_smallest == scheme.dt_largest) return fmt::format("{} of {}", scheme.steps, smallest);
  return fmt::format("{} of {} to {}", scheme.steps, smallest,
                     with_unit(number_text(scheme.dt_largest, 6), units.time));
}

}  // namespace

std::string verdict_table(const Summary& summary) {
  if (summary.verdict.empty()) return {};
  std::string html =
      "<section>\n<h2>Verdict</h2>\n<div class=\"scroll\"><table><thead><tr><th>Item</th><th "
      "class=\"number\">value</th>"
      "<th class=\"number\">limit</th><th></th><th>meaning</th></tr></thead><tbody>\n";
  for (const VerdictItem& item : summary.verdict) {
    html += fmt::format("<tr>{}{}{}{}{}</tr>\n", text_cell(item.name), number_cell(number_text(item.value, 3)),
                        number_cell(fmt::format("≤ {}", number_text(item.limit, 3))), mark_cell(item.pass),
                        text_cell(item.explanation));
  }
  return html + "</tbody></table></div>\n</section>\n";
}

std::string warnings_list(const Summary& summary) {
  const auto list = [](std::string_view title, std::string_view style, const std::vector<std::string>& lines) {
    std::string html;
    if (lines.empty()) return html;
    html = fmt::format("<section>\n<h2>{}</h2>\n<ul class=\"{}\">\n", title, style);
    for (const std::string& line : lines) html += fmt::format("<li>{}</li>\n", xml_escape(line));
    return html + "</ul>\n</section>\n";
  };
  return list("Warnings", "notes", summary.warnings) + list("Notes", "remarks", summary.notes);
}

std::string checks_table(const Summary& summary, const Units& units) {
  if (summary.checks.empty()) return {};
  std::string html = fmt::format(
      "<section>\n<h2>Checks</h2>\n<div class=\"scroll\"><table><thead><tr><th>Quantity</th>"
      "<th class=\"number\">time{}</th><th class=\"number\">value</th><th class=\"number\">reference</th><th>unit</th>"
      "<th class=\"number\">difference</th><th class=\"number\">tolerance</th><th></th><th>source</th></tr></thead>"
      "<tbody>\n",
      units.time.empty() ? "" : fmt::format(" [{}]", xml_escape(units.time)));
  for (const CheckSummary& check : summary.checks) {
    html += fmt::format("<tr>{}{}{}{}{}{}{}{}{}</tr>\n", text_cell(check.name), number_cell(number_text(check.time, 6)),
                        number_cell(number_text(check.value, 9)), number_cell(number_text(check.reference, 9)),
                        text_cell(unit_of_column(units, check.quantity)), number_cell(difference(check)),
                        number_cell(tolerance(check)), mark_cell(check.pass), text_cell(check.source));
  }
  return html + "</tbody></table></div>\n</section>\n";
}

std::string ledger_tables(const Summary& summary, const Units& units) {
  return "<section>\n<h2>Energy and momentum at the end</h2>\n<div class=\"columns\">\n" +
         value_table("Energy ledger", summary.ledger, units.energy) +
         value_table("In Code_Aster's terms", summary.code_aster, units.energy) + "</div>\n" +
         momentum_table(summary, units) + "</section>\n";
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
  entry("Scheme", scheme.name);
  entry("Linear solver", scheme.solver);
  for (const std::string& note : scheme.mass_notes) entry("Mass", note);
  entry("Steps", steps(scheme, units));
  entry("Time", fmt::format("{} of {}", number_text(scheme.time_reached, 6),
                            with_unit(number_text(scheme.time_end, 6), units.time)));
  entry("Program",
        fmt::format("carom {}, {}, kernels {}, {} thread{}", summary.program.version, summary.program.compiler,
                    summary.program.isa, summary.program.threads, summary.program.threads == 1 ? "" : "s"));
  entry("Wall clock", number_text(summary.cost.wall_seconds, 3) + " s");
  entry("Processor", number_text(summary.cost.cpu_seconds, 3) + " s");
  entry("Phases", phases(summary.cost));
  entry("Memory", fmt::format("{:.1f} MiB at most", static_cast<double>(summary.cost.peak_memory_bytes) / 1048576.0));
  return html + "</dl>\n</section>\n";
}

}  // namespace carom
