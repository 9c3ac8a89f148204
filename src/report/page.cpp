#include "report/page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string_view>

#include "output/xml.hpp"
#include "report/assets.hpp"
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

std::string header(const ReportData& data) {
  const Banner banner = banner_of(data.summary);
  const std::string title = data.summary ? data.summary->case_info.title : data.folder;
  const bool has_message = data.summary && !data.summary->message.empty();
  std::string html = fmt::format(
      "<header>\n<p class=\"kicker\">Carom · report of a run</p>\n<h1>{}</h1>\n"
      "<div class=\"banner {}\" role=\"status\"><strong>{}</strong><span>{}</span></div>\n",
      xml_escape(title), banner.style, banner.word,
      xml_escape(has_message ? std::string_view(data.summary->message) : banner.text));
  if (!data.notes.empty()) {
    html += "<ul class=\"notes\">\n";
    for (const std::string& note : data.notes) html += fmt::format("<li>{}</li>\n", xml_escape(note));
    html += "</ul>\n";
  }
  return html + "</header>\n";
}

std::string charts(const std::vector<Chart>& charts) {
  std::string html;
  std::string section;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Chart& chart = charts[i];
    if (chart.section != section) {
      if (!section.empty()) html += "</div>\n</section>\n";
      section = chart.section;
      html += fmt::format("<section>\n<h2>{}</h2>\n<div class=\"charts\">\n", section);
    }
    html += fmt::format(
        "<figure><figcaption>{}</figcaption><div class=\"legend\"></div><div class=\"chart\" data-chart=\"{}\"></div>"
        "<p class=\"note\">{}</p></figure>\n",
        xml_escape(chart.title), i, xml_escape(chart.note));
  }
  if (section.empty()) return html;
  return html +
         "</div>\n</section>\n<p class=\"note\">Drag over a picture to zoom all of them in time, hold shift to move, "
         "double-click to see all again; click a name to hide its curve. Long tables are drawn by the smallest and "
         "largest value in each of 1000 intervals of time; the .csv files hold every row.</p>\n";
}

std::string footer(const ReportData& data) {
  std::string html = "<footer>\n";
  if (!data.case_text.empty()) {
    html += fmt::format(
        "<details><summary>The case with all defaults (case.resolved.toml)</summary><pre>{}</pre></details>\n",
        xml_escape(data.case_text));
  }
  html +=
      fmt::format("<details><summary>Licence of dygraphs, which draws the curves</summary><pre>{}</pre></details>\n",
                  xml_escape(assets::dygraph_licence));
  return html + "</footer>\n";
}

}  // namespace

std::string make_page(const ReportData& data) {
  const std::string title = data.summary ? data.summary->case_info.title : data.folder;
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{} · Carom</title>\n"
      "<link rel=\"icon\" href=\"data:,\">\n<style>{}\n{}</style>\n</head>\n<body>\n<main>\n",
      xml_escape(title), assets::dygraph_css, assets::page_css);
  html += header(data);
  if (data.summary) {
    const Summary& summary = *data.summary;
    html += verdict_table(summary);
    html += checks_table(summary, data.units);
  }
  html += charts(data.charts);
  if (data.summary) {
    html += ledger_tables(*data.summary, data.units);
    html += run_table(*data.summary, data.units);
  }
  html += footer(data);
  html += fmt::format("</main>\n<script type=\"application/json\" id=\"charts\">{}</script>\n",
                      charts_json(data.charts, data.units));
  html += fmt::format("<script>{}</script>\n<script>{}</script>\n</body>\n</html>\n", assets::dygraph_js,
                      assets::curves_js);
  return html;
}

}  // namespace carom
