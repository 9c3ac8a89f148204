// The report page as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/summary.hpp"
#include "output/units.hpp"
#include "report/charts.hpp"
#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/xy_plot.hpp"

namespace carom {

/// How far a run that is still going on has come.
struct RunningState {
  double end = 0.0;                    ///< of the case; 0: not known
  std::optional<double> seconds_left;  ///< of the clock, by its pace lately
  int refresh = 0;                     ///< seconds until the page is read again
};

/// All that the page shows.
struct ReportData {
  std::string folder;              ///< title of a page without summary
  std::optional<Summary> summary;  ///< nothing when the run was interrupted
  Units units;
  std::vector<KeyFigure> figures;
  std::vector<LargestValue> largest{};
  PartValues parts{};
  std::vector<XyPlot> spectra{};
  std::vector<Chart> charts;
  std::string title;                         ///< of the case, as the tables know it; "" where there are none
  double time_reached = 0.0;                 ///< of the last row of energy.csv
  std::optional<double> largest_force_at{};  ///< when it is: the view opens there
  std::optional<RunningState> running{};
  std::vector<PageView> views{};
  std::string case_text;           ///< case.resolved.toml
  std::vector<std::string> notes;  ///< files that are missing or cut short
};

/// One HTML document with style, script and data inside. Every text of the user is escaped.
std::string make_page(const ReportData& data);

}  // namespace carom
