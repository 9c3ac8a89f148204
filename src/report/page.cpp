#include "report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "output/progress.hpp"
#include "output/readable_unit.hpp"
#include "output/xml.hpp"
#include "report/assets.hpp"
#include "report/html.hpp"
#include "report/page_tables.hpp"

namespace carom {

namespace {

struct Banner {
  std::string_view style, word, text;
};

Banner banner_of(const std::optional<Summary>& summary) {
  if (!summary) {
    return {
        "stopped", "No verdict",
        "The run has not written its summary: it is still going on or was interrupted. What it left is shown below."};
  }
  switch (summary->outcome) {
    case Outcome::good:
      if (!summary->doubts.empty())
        return {"doubtful", "Good, with doubts", "The books close, but a warning says why numbers may be wrong."};
      if (!lost_of_deck(*summary).empty())
        return {"cautious", "Good, for what is left of the deck", "The books close; what the deck lost stands below."};
      if (!summary->warnings.empty())
        return {"cautious", summary->checks.empty() ? "Good, with warnings, no checks" : "Good, with warnings",
                "The books close; what the run was warned of stands below."};
      if (summary->checks.empty())
        return {"unchecked", "Good, no checks", "The books close; nothing was compared with a reference."};
      return {"good", "Good", "All checks and all items of the verdict passed."};
    case Outcome::failed:
      return {"failed", "Failed", "A check or an item of the verdict did not pass."};
    case Outcome::stopped:
      return {"stopped", "Stopped", "The run was stopped before its end."};
    case Outcome::error:
      return {"failed", "Error", "The run could not go on."};
  }
  return {};
}

/// What did not pass: by how much, what it means and what helps.
std::string failures(const std::optional<Summary>& summary) {
  if (!summary) return "";
  std::string html;
  const auto add = [&](const std::string& name, const std::string& text) {
    html += fmt::format("<li><strong>{}</strong>: {}</li>\n", xml_escape(name), xml_escape(text));
  };
  for (const VerdictItem& item : summary->verdict)
    if (!item.pass)
      add(item.name, fmt::format("{}, and the limit is {} ({})", number_text(item.value, 3), number_text(item.limit, 3),
                                 item.explanation));
  for (const CheckSummary& check : summary->checks)
    if (!check.pass && check.time <= summary->scheme.time_reached)
      add("check " + check.name, fmt::format("{}, reference {} ({})", number_text(check.value, 6),
                                             number_text(check.reference, 6), check.source));
  return html.empty() ? "" : "<ul>\n" + html + "</ul>\n";
}

/// What the user has accepted that the deck loses.
std::string lost_list(const std::optional<Summary>& summary) {
  if (!summary) return "";
  const std::vector<std::string> lost = lost_of_deck(*summary);
  if (lost.empty()) return "";
  std::string html = "<div class=\"lost\"><strong>Not carried over from the deck</strong>\n<ul>\n";
  for (const std::string& line : lost) html += fmt::format("<li>{}</li>\n", xml_escape(line));
  return html + "</ul></div>\n";
}

/// Bar, time reached and time left of a run that goes on.
std::string progress_bar(const ReportData& data) {
  if (!data.running) return "";
  const RunningState& state = *data.running;
  std::string text = fmt::format("t = {}", with_readable_unit(data.time_reached, data.units.time, 4));
  if (state.end > 0.0)
    text += fmt::format(" of {}, {}", with_readable_unit(state.end, data.units.time, 4),
                        progress_share(data.time_reached, state.end, state.seconds_left));
  const double share = state.end > 0.0 ? std::min(data.time_reached / state.end, 1.0) : 0.0;
  return fmt::format("<div class=\"progress\"><progress max=\"1\" value=\"{:.4f}\"></progress> <span>{}</span></div>\n",
                     share, xml_escape(text));
}

std::string title_of(const ReportData& data) {
  if (data.summary) return data.summary->case_info.title;
  return data.title.empty() ? data.folder : data.title;
}

std::string header(const ReportData& data) {
  const Banner banner = data.running ? Banner{"unchecked", "Running",
                                              "What there is so far; this page reads itself again until the run ends."}
                                     : banner_of(data.summary);
  const std::string title = title_of(data);
  const bool has_message = data.summary && !data.summary->message.empty();
  const std::size_t warnings = data.summary ? data.summary->warnings.size() : 0;
  std::string html = fmt::format(
      "<header>\n<p class=\"kicker\">Carom · {}</p>\n<h1>{}</h1>\n"
      "<div class=\"banner {}\" role=\"status\"><strong>{}</strong><span>{}</span>{}{}</div>\n",
      data.running ? "a run that goes on" : "report of a run", xml_escape(title), banner.style, banner.word,
      xml_escape(has_message ? std::string_view(data.summary->message) : banner.text),
      warnings == 0 ? ""
                    : fmt::format("<span class=\"warned\">{} warning{}</span>", warnings, warnings == 1 ? "" : "s"),
      failures(data.summary));
  html += lost_list(data.summary) + progress_bar(data);
  if (!data.notes.empty()) {
    html += "<ul class=\"notes\">\n";
    for (const std::string& note : data.notes) html += fmt::format("<li>{}</li>\n", xml_escape(note));
    html += "</ul>\n";
  }
  return html + "</header>\n";
}

std::string figures_list(const std::vector<KeyFigure>& figures) {
  if (figures.empty()) return "";
  std::string html = "<section>\n<h2>Key figures</h2>\n<dl class=\"figures\">\n";
  for (const KeyFigure& f : figures) {
    html += fmt::format("<div><dt>{}</dt><dd><strong>{}</strong> {}</dd></div>\n", xml_escape(f.title),
                        xml_escape(f.value), xml_escape(f.remark));
  }
  return html + "</dl>\n</section>\n";
}

std::string largest_table(const std::vector<LargestValue>& largest) {
  if (largest.empty()) return "";
  std::vector<TableRow> rows;
  for (const LargestValue& l : largest)
    rows.push_back({text_cell(l.quantity), number_cell(l.value), number_cell(l.time), text_cell(l.where)});
  return "<section>\n<h2>Largest values</h2>\n" +
         html_table({{"Quantity"}, {"value", true}, {"time", true}, {"where"}}, rows) + "</section>\n";
}

std::string parts_table(const PartValues& of) {
  if (of.parts.empty()) return "";
  std::vector<TableColumn> columns{{"Part"}};
  for (const std::string& quantity : of.quantities) columns.push_back({quantity, true});
  std::vector<TableRow> rows;
  for (std::size_t p = 0; p < of.parts.size(); ++p) {
    rows.push_back({text_cell(of.parts[p])});
    for (const PartValues::Value& v : of.values[p])
      rows.back().push_back(
          {fmt::format("{}{}", xml_escape(v.value),
                       v.time.empty() ? "" : fmt::format("<br><small>at {}</small>", xml_escape(v.time))),
           "number"});
  }
  return "<section>\n<h2>Largest values of the parts</h2>\n" + html_table(columns, rows, "wide") + "</section>\n";
}

std::string spectrum_figures(const std::vector<XyPlot>& spectra) {
  if (spectra.empty()) return "";
  std::string html = "<section>\n<h2>Shock response spectra</h2>\n<div class=\"charts\">\n";
  for (const XyPlot& plot : spectra) html += xy_plot(plot);
  return html + "</div>\n</section>\n";
}

/// Where another scheme takes over.
std::vector<TimeMark> stage_marks(const std::optional<Summary>& summary) {
  std::vector<TimeMark> marks;
  if (!summary) return marks;
  for (const StageSummary& stage : summary->scheme.stages)
    if (stage.begin > 0.0) marks.push_back({stage.begin, stage.name});
  return marks;
}

std::string footer(const ReportData& data) {
  std::string html = "<footer>\n";
  if (!data.case_text.empty()) html += foldable("The case with all defaults (case.resolved.toml)", data.case_text);
  html += foldable("Licence of dygraphs, which draws the curves", assets::dygraph_licence);
  if (!data.views.empty()) html += foldable("Licence of three.js, which draws the view", assets::three_licence);
  return html + "</footer>\n";
}

}  // namespace

std::string make_page(const ReportData& data) {
  std::string content = header(data);
  if (data.summary) content += warnings_list(*data.summary);
  content += figures_list(data.figures);
  content += view_sections(data.views);
  if (data.summary) {
    content += checks_table(*data.summary, data.units);
    content += verdict_table(*data.summary);
  }
  content += largest_table(data.largest) + parts_table(data.parts);
  content += spectrum_figures(data.spectra) + chart_figures(data.charts);
  if (data.summary) {
    content += notes_list(*data.summary);
    content += ledger_tables(*data.summary, data.units);
    content += run_table(*data.summary, data.units);
  }
  content += footer(data);
  return html_document(title_of(data), content, {data.charts, data.units.time, stage_marks(data.summary)}, data.views,
                       data.running ? data.running->refresh : 0);
}

}  // namespace carom
