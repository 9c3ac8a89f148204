// The report page as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/summary.hpp"
#include "output/units.hpp"
#include "report/charts.hpp"
#include "report/figures.hpp"

namespace carom {

/// All that the page shows.
struct ReportData {
  std::string folder;              ///< title of a page without summary
  std::optional<Summary> summary;  ///< nothing when the run was interrupted
  Units units;
  std::vector<KeyFigure> figures;
  std::vector<Chart> charts;
  std::string case_text;           ///< case.resolved.toml
  std::vector<std::string> notes;  ///< files that are missing or cut short
};

/// One HTML document with style, script and data inside. Every text of the user is escaped.
std::string make_page(const ReportData& data);

}  // namespace carom
