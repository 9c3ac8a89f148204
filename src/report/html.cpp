#include "report/html.hpp"

#include <fmt/format.h>

#include <cmath>

#include "output/xml.hpp"
#include "report/assets.hpp"

namespace carom {

std::string number_text(double value, int digits) {
  return std::isnan(value) ? "–" : fmt::format("{:.{}g}", value, digits);
}

std::string text_cell(std::string_view text) {
  return fmt::format("<td>{}</td>", xml_escape(text));
}

std::string number_cell(std::string_view text) {
  return fmt::format("<td class=\"number\">{}</td>", xml_escape(text));
}

std::string mark_cell(bool pass) {
  return pass ? "<td class=\"mark pass\">✓ pass</td>" : "<td class=\"mark fail\">✗ fail</td>";
}

std::string foldable(std::string_view title, std::string_view text) {
  return fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n", xml_escape(title), xml_escape(text));
}

std::string chart_figures(const std::vector<Chart>& charts) {
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
         "double-click to see all again; click a name to hide or show its curve. Long tables are drawn by the smallest "
         "and largest value in each of 1000 intervals of time; the .csv files hold every row.</p>\n";
}

std::string html_document(std::string_view title, const std::string& content, const std::vector<Chart>& charts,
                          const Units& units) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{} · Carom</title>\n"
      "<link rel=\"icon\" href=\"data:,\">\n<style>{}\n{}</style>\n</head>\n<body>\n<main>\n",
      xml_escape(title), assets::dygraph_css, assets::page_css);
  html += content;
  html +=
      fmt::format("</main>\n<script type=\"application/json\" id=\"charts\">{}</script>\n", charts_json(charts, units));
  html += fmt::format("<script>{}</script>\n<script>{}</script>\n</body>\n</html>\n", assets::dygraph_js,
                      assets::curves_js);
  return html;
}

}  // namespace carom
