// Pieces of HTML that all pages share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/types.hpp"
#include "output/data_table.hpp"
#include "output/readable_unit.hpp"
#include "output/units.hpp"
#include "report/charts.hpp"
#include "view/view.hpp"

namespace carom {

/// A three-dimensional view under a title of its own.
struct PageView {
  std::string title;
  View view;
};

/// One cell of a table: HTML, and the style of page.css ("number": right-aligned, figures of equal width).
struct TableCell {
  std::string html;
  std::string_view style = "";
};
/// The text is escaped.
TableCell text_cell(std::string_view text);
TableCell number_cell(std::string_view text);
TableCell mark_cell(bool pass);

using TableRow = std::vector<TableCell>;

/// A table that is read row by row on narrow screens, each cell beside the title of its column, which is escaped.
/// `style` is that of page.css.
std::string html_table(const std::vector<TableColumn>& columns, const std::vector<TableRow>& rows,
                       std::string_view style = "");

/// A section with the table below its title; cells that end with ✗ have failed. "" for a table without rows.
std::string table_section(const DataTable& table);

/// A text of several lines that the reader unfolds.
std::string foldable(std::string_view title, std::string_view text);

/// Places for the charts, a section for each run of equal Chart::section, and below them what is said instead of drawn;
/// "" without charts. The charts themselves go to html_document.
std::string chart_figures(const std::vector<Chart>& charts);

/// A picture of its own, which scripts/plot_files.js can save.
struct PlotFigure {
  std::string title;     ///< escaped
  std::string legend;    ///< HTML
  double width, height;  ///< in the units of the picture
  std::string picture;   ///< what stands inside of the <svg> element
  std::string csv;       ///< the numbers that are drawn
};
std::string plot_figure(const PlotFigure& figure);

/// Places for the views, a section each; "" without views. What they show goes to html_document.
std::string view_sections(const std::vector<PageView>& views);

/// The bytes that the libraries of a page with views take.
std::size_t view_library_bytes();

/// One document with style, scripts and the data of charts and views inside; `content` is HTML. It is read again every
/// `refresh` seconds where that is not 0.
std::string html_document(std::string_view title, const std::string& content, const ChartData& data,
                          const std::vector<PageView>& views = {}, int refresh = 0);

}  // namespace carom
