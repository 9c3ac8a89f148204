#include "report/html.hpp"

#include <fmt/format.h>

#include <cmath>

#include "output/xml.hpp"
#include "report/assets.hpp"
#include "view/packed_arrays.hpp"

namespace carom {

TableCell text_cell(std::string_view text) {
  return {xml_escape(text)};
}

TableCell number_cell(std::string_view text) {
  return {xml_escape(text), "number"};
}

TableCell mark_cell(bool pass) {
  return pass ? TableCell{"✓ pass", "mark pass"} : TableCell{"✗ fail", "mark fail"};
}

std::string html_table(const std::vector<TableColumn>& columns, const std::vector<TableRow>& rows,
                       std::string_view style) {
  const auto class_of = [](std::string_view name) {
    return name.empty() ? std::string() : fmt::format(" class=\"{}\"", name);
  };
  std::string html = fmt::format("<div class=\"scroll\"><table{}><thead><tr>", class_of(style));
  for (const TableColumn& c : columns)
    html += fmt::format("<th{}>{}</th>", class_of(c.is_number ? "number" : ""), xml_escape(c.title));
  html += "</tr></thead><tbody>\n";
  for (const TableRow& row : rows) {
    html += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      html += fmt::format("<td{} data-label=\"{}\">{}</td>", class_of(row[c].style), xml_escape(columns[c].title),
                          row[c].html);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string table_section(const DataTable& table) {
  if (table.rows.empty()) return "";
  std::vector<TableRow> rows;
  for (const auto& cells : table.rows) {
    rows.emplace_back();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      rows.back().push_back(table.columns[c].is_number ? number_cell(cells[c]) : text_cell(cells[c]));
      if (cells[c].ends_with("✗")) rows.back().back().style = "number fail";
    }
  }
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", xml_escape(table.title),
                     html_table(table.columns, rows));
}

std::string foldable(std::string_view title, std::string_view text) {
  return fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n", xml_escape(title), xml_escape(text));
}

std::string chart_figures(const std::vector<Chart>& charts) {
  std::string html, said;
  const std::string* section = nullptr;
  const auto end_section = [&] {
    if (section != nullptr) html += "</div>\n" + said + "</section>\n";
    said.clear();
  };
  std::size_t drawn = 0;
  for (const Chart& chart : charts) {
    if (section == nullptr || chart.section != *section) {
      end_section();
      section = &chart.section;
      html += fmt::format("<section>\n<h2>{}</h2>\n<div class=\"charts\">\n", chart.section);
    }
    if (chart.curves.empty()) {
      said += fmt::format("<p class=\"note said\"><strong>{}</strong> {}</p>\n", xml_escape(chart.title),
                          xml_escape(chart.note));
      continue;
    }
    const std::string place =
        chart.place.empty() ? "" : fmt::format(" <span class=\"place\">{}</span>", xml_escape(chart.place));
    const std::string title = xml_escape(chart.title);
    if (chart.is_folded) html += fmt::format("<details class=\"asked\"><summary>{}</summary>\n", title);
    html += fmt::format(
        "<figure><figcaption>{}{}</figcaption><div class=\"legend\"></div><div class=\"chart\" data-chart=\"{}\"></div>"
        "<p class=\"note\">{}</p></figure>\n",
        title, place, drawn++, xml_escape(chart.note));
    if (chart.is_folded) html += "</details>\n";
  }
  end_section();
  if (drawn == 0) return html;
  return html +
         "<p class=\"note hint\">Drag over a picture to zoom all of them in time, hold shift to move, "
         "double-click to see all again; click a name to hide or show its curve. Long tables are drawn by the smallest "
         "and largest value in each of 1000 intervals of time; the .csv files hold every row.</p>\n";
}

std::string plot_figure(const PlotFigure& figure) {
  const std::string title = xml_escape(figure.title);
  return fmt::format(
      "<figure data-csv=\"{}\"><figcaption>{}</figcaption><div class=\"legend\">{}</div>\n"
      "<svg class=\"plot\" viewBox=\"0 0 {:g} {:g}\" role=\"img\" aria-label=\"{}\">{}</svg></figure>\n",
      xml_escape(figure.csv), title, figure.legend, figure.width, figure.height, title, figure.picture);
}

std::string view_sections(const std::vector<PageView>& views) {
  if (views.empty()) return "";
  std::string html = "<div class=\"views\">\n";
  for (std::size_t v = 0; v < views.size(); ++v) {
    html += fmt::format("<section class=\"view\" data-view=\"view-{}\">\n<h2>{}</h2>\n</section>\n", v,
                        xml_escape(views[v].title));
  }
  html += "</div>\n";
  for (std::size_t v = 0; v < views.size(); ++v)
    if (v == 0 || views[v].view.note != views[v - 1].view.note)
      html += fmt::format("<p class=\"note\">{}</p>\n", xml_escape(views[v].view.note));
  return html;
}

namespace {

/// The libraries of views, deflated: scripts/view_data.js runs them.
std::string view_libraries() {
  const auto element = [](std::string_view id, std::string_view library) {
    return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, base64_deflated(library));
  };
  return element("three-js", assets::three_js) + element("orbit-js", assets::orbit_js);
}

}  // namespace

std::size_t view_library_bytes() {
  return view_libraries().size();
}

std::string html_document(std::string_view title, const std::string& content, const ChartData& data,
                          const std::vector<PageView>& views, int refresh) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{}"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{} · Carom</title>\n"
      "<link rel=\"icon\" href=\"data:,\">\n<style>{}\n{}</style>\n</head>\n<body>\n<main>\n",
      refresh > 0 ? fmt::format("<meta http-equiv=\"refresh\" content=\"{}\">\n", refresh) : "", xml_escape(title),
      assets::dygraph_css, assets::page_css);
  html += content;
  html += fmt::format("</main>\n<script type=\"application/json\" id=\"charts\">{}</script>\n", charts_json(data));
  const auto run = [&html](std::string_view script) { html += fmt::format("<script>{}</script>\n", script); };
  run(assets::dygraph_js);
  run(assets::curves_js);
  if (!views.empty()) {
    html += view_libraries();
    for (std::size_t v = 0; v < views.size(); ++v)
      html += fmt::format("<script type=\"application/json\" id=\"view-{}\">{}</script>\n", v, views[v].view.json);
    run(assets::view_js);
  }
  return html + "</body>\n</html>\n";
}

}  // namespace carom
