#include "report/xy_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/readable_unit.hpp"
#include "output/xml.hpp"
#include "report/html.hpp"

namespace carom {

namespace {

// Of the picture, in its own units.
constexpr double kWidth = 560.0, kHeight = 330.0, kLeft = 62.0, kRight = 16.0, kTop = 10.0, kBottom = 44.0;
constexpr std::size_t kColours = 8;  // of page.css

/// Numbers to positions, in a readable unit.
struct Axis {
  double low = 0.0, high = 0.0, begin = 0.0, end = 0.0;  ///< low, high: of logarithms where it is logarithmic
  ReadableUnit unit;
  bool is_logarithmic = false;

  double of(double value) const { return is_logarithmic ? std::log10(value) : value; }
  double at(double value) const { return begin + (end - begin) * (of(value) - low) / (high - low); }
  double scale() const { return std::pow(10.0, unit.power); }
  /// In the readable unit.
  std::vector<double> ticks() const {
    if (!is_logarithmic) return round_ticks(low / scale(), high / scale());
    return log_ticks(std::pow(10.0, low) / scale(), std::pow(10.0, high) / scale());
  }
};

Axis axis_of(const XyPlot& plot, std::vector<double> XyCurve::*values, const std::string& unit, double begin,
             double end) {
  double low = std::numeric_limits<double>::infinity(), high = -low, largest = 0.0;
  for (const XyCurve& curve : plot.curves)
    for (const double value : curve.*values) {
      const double place = plot.is_logarithmic ? std::log10(value) : value;
      low = std::min(low, place);
      high = std::max(high, place);
      largest = std::max(largest, std::abs(value));
    }
  if (plot.is_logarithmic) {
    constexpr double least = 1.0, room = 0.04;  // decades, and of the range
    const double middle = 0.5 * (low + high), half = std::max(0.5 * least, (0.5 + room) * (high - low));
    return {middle - half, middle + half, begin, end, unit.empty() ? ReadableUnit{} : readable_unit(largest, unit),
            true};
  }
  constexpr double round_off = 1e-9;  // a range as small as that shows nothing but noise
  const double flat = largest > 0.0 ? 0.1 * largest : 1.0;
  const double room = high - low > round_off * largest ? 0.04 * (high - low) : flat;
  return {low - room, high + room, begin, end, unit.empty() ? ReadableUnit{} : readable_unit(largest, unit)};
}

std::string titled(const std::string& label, const std::string& unit) {
  return xml_escape(unit.empty() ? label : fmt::format("{} [{}]", label, unit));
}

std::string grid(const XyPlot& plot, const Axis& x, const Axis& y) {
  std::string svg;
  for (const double tick : x.ticks()) {
    const double at = x.at(tick * x.scale());
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4:g}"
        "</text>",
        at, kTop, kHeight - kBottom, kHeight - kBottom + 17.0, tick);
  }
  for (const double tick : y.ticks()) {
    const double at = y.at(tick * y.scale());
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:g}"
        "</text>",
        kLeft, at, kWidth - kRight, kLeft - 7.0, at + 4.0, tick);
  }
  const double middle_x = 0.5 * (kLeft + kWidth - kRight), middle_y = 0.5 * (kTop + kHeight - kBottom);
  return svg + fmt::format(
                   "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>"
                   "<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                   middle_x, kHeight - 8.0, titled(plot.x_label, x.unit.name), middle_y,
                   titled(plot.y_label, y.unit.name));
}

std::string picture(const XyCurve& curve, const Axis& x, const Axis& y) {
  std::string path, dots;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double px = x.at(curve.x[i]), py = y.at(curve.y[i]);
    if (curve.has_dots)
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>", px, py);
    else
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px, py);
  }
  return curve.has_dots ? dots : fmt::format("<path class=\"curve\" d=\"{}\"/>", path);
}

std::string csv_of(const XyPlot& plot) {
  const auto title = [](const std::string& label, const std::string& unit) {
    return csv_field(unit.empty() ? label : fmt::format("{} [{}]", label, unit));
  };
  std::string csv = fmt::format("curve,{},{}\n", title(plot.x_label, plot.x_unit), title(plot.y_label, plot.y_unit));
  for (const XyCurve& curve : plot.curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      csv += fmt::format("{},{:.8g},{:.8g}\n", csv_field(curve.name), curve.x[i], curve.y[i]);
  return csv;
}

std::string own_colour(std::size_t curve) {
  return fmt::format("--own:var(--curve-{})", curve % kColours + 1);
}

}  // namespace

std::vector<double> round_ticks(double low, double high) {
  std::vector<double> ticks;
  if (!(high > low)) return ticks;
  constexpr double most = 8.0;
  const double power = std::pow(10.0, std::floor(std::log10((high - low) / most)));
  double step = power;
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    step = factor * power;
    if (high - low <= most * step) break;
  }
  for (double k = std::ceil(low / step); k * step <= high; k += 1.0) ticks.push_back(k == 0.0 ? 0.0 : k * step);
  return ticks;
}

std::vector<double> log_ticks(double low, double high) {
  const bool is_long = high / low >= 1000.0;
  std::vector<double> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, power) <= high; ++power) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * std::pow(10.0, power);
      if (tick >= low && tick <= high && (factor == 1.0 || !is_long)) ticks.push_back(tick);
    }
  }
  return ticks;
}

std::string xy_plot(const XyPlot& plot) {
  const Axis x = axis_of(plot, &XyCurve::x, plot.x_unit, kLeft, kWidth - kRight);
  const Axis y = axis_of(plot, &XyCurve::y, plot.y_unit, kHeight - kBottom, kTop);
  std::string legend, svg = grid(plot, x, y);
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    if (plot.curves.size() > 1)
      legend += fmt::format("<span style=\"{}\"><i style=\"border-color:var(--own)\"></i>{}</span>", own_colour(i),
                            xml_escape(plot.curves[i].name));
    svg += fmt::format("<g style=\"{}\">{}</g>\n", own_colour(i), picture(plot.curves[i], x, y));
  }
  return plot_figure({plot.title, legend, kWidth, kHeight, svg, csv_of(plot)});
}

}  // namespace carom
