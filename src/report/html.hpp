// Pieces of HTML that all pages share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "output/units.hpp"
#include "report/charts.hpp"

namespace carom {

/// The number with so many digits, or a dash for NaN.
std::string number_text(double value, int digits);

// Cells of a table; the text is escaped.
std::string text_cell(std::string_view text);
/// Right-aligned, figures of equal width.
std::string number_cell(std::string_view text);
std::string mark_cell(bool pass);

/// A text of several lines that the reader unfolds.
std::string foldable(std::string_view title, std::string_view text);

/// Places for the charts, a section for each run of equal Chart::section; "" without charts. The charts themselves go
/// to html_document.
std::string chart_figures(const std::vector<Chart>& charts);

/// One document with style, script and the data of the charts inside; `content` is HTML.
std::string html_document(std::string_view title, const std::string& content, const std::vector<Chart>& charts,
                          const Units& units);

}  // namespace carom
