// A picture with logarithmic axes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace carom::compare {

struct LogPoint {
  double x = 0.0, y = 0.0;  ///< positive
  std::string tip;          ///< shown under the pointer
};

/// Points joined by a line in their order.
struct LogCurve {
  std::string name;
  std::vector<LogPoint> points;
  std::size_t colour = 0;  ///< its number; curves of the same colour get paler one after the other
};

struct LogPlot {
  std::string title, x_label, y_label;
  std::vector<double> x_ticks;  ///< empty: log_ticks
  std::vector<LogCurve> curves;
};

/// An HTML figure with an SVG picture in the colours of the page (report/page.css), and its legend.
std::string log_plot(const LogPlot& plot);

}  // namespace carom::compare
