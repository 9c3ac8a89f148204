// A picture of curves over anything but time, such as stress over strain.
#pragma once

#include <string>
#include <vector>

namespace carom {

struct XyCurve {
  std::string name;
  std::vector<double> x, y;  ///< of one length
  bool has_dots = false;     ///< points by themselves, such as measured ones; else joined in their order
};

struct XyPlot {
  std::string title, x_label, y_label, x_unit, y_unit;
  std::vector<XyCurve> curves;
  bool is_logarithmic = false;  ///< both axes, of positive numbers
};

/// An HTML figure with an SVG picture in the colours of the page (page.css), and its legend where there are several
/// curves. Axes are in readable units.
std::string xy_plot(const XyPlot& plot);

/// At most about eight round numbers within [low, high]: multiples of 1, 2 or 5 times a power of ten.
std::vector<double> round_ticks(double low, double high);

/// Ticks of a logarithmic axis within [low, high]: powers of ten, and 2 and 5 times them where the axis spans fewer
/// than three decades.
std::vector<double> log_ticks(double low, double high);

}  // namespace carom
