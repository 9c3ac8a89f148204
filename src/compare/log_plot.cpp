#include "compare/log_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "output/xml.hpp"
#include "report/html.hpp"
#include "report/xy_plot.hpp"

namespace carom::compare {

namespace {

// Of the picture, in its own units.
constexpr double kWidth = 560.0, kHeight = 330.0, kLeft = 62.0, kRight = 16.0, kTop = 10.0, kBottom = 44.0;
constexpr std::size_t kColours = 8;  // of page.css

/// Logarithm to a position, with room at both ends.
class Axis {
 public:
  /// begin, end: positions of the low and the high end.
  Axis(double low, double high, double begin, double end) : begin_(begin), end_(end) {
    const double middle = 0.5 * (std::log10(low) + std::log10(high));
    const double half = std::max(0.35, 0.5 * (std::log10(high) - std::log10(low)) * 1.12);
    low_ = middle - half;
    high_ = middle + half;
  }
  double at(double value) const { return begin_ + (end_ - begin_) * (std::log10(value) - low_) / (high_ - low_); }
  std::vector<double> ticks() const { return log_ticks(std::pow(10.0, low_), std::pow(10.0, high_)); }

 private:
  double begin_, end_, low_ = 0.0, high_ = 0.0;
};

template <class Value>
Axis axis_of(const LogPlot& plot, const Value& value, double begin, double end) {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const LogCurve& curve : plot.curves) {
    for (const LogPoint& point : curve.points) {
      low = std::min(low, value(point));
      high = std::max(high, value(point));
    }
  }
  return {low, high, begin, end};
}

std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::string grid(const LogPlot& plot, const Axis& x, const Axis& y) {
  std::string svg, text;
  for (const double tick : plot.x_ticks.empty() ? x.ticks() : distinct(plot.x_ticks)) {
    svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/>", x.at(tick), kTop, kHeight - kBottom);
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:g}</text>", x.at(tick),
                        kHeight - kBottom + 17.0, tick);
  }
  for (const double tick : y.ticks()) {
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\"/>", kLeft, y.at(tick), kWidth - kRight);
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>", kLeft - 7.0,
                        y.at(tick) + 4.0, tick);
  }
  return svg + text;
}

std::string labels(const LogPlot& plot) {
  const double x = 0.5 * (kLeft + kWidth - kRight), y = 0.5 * (kTop + kHeight - kBottom);
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>"
      "<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
      x, kHeight - 8.0, xml_escape(plot.x_label), y, xml_escape(plot.y_label));
}

/// The `rank`-th of the curves of one colour is paler than those before.
std::string own_colour(std::size_t colour, std::size_t rank) {
  constexpr std::array<double, 4> opacity{1.0, 0.72, 0.5, 0.35};  // as curve_style.js has them
  return fmt::format("--own:var(--curve-{});opacity:{:g}", colour % kColours + 1,
                     opacity.at(std::min(rank, opacity.size() - 1)));
}

std::string csv_of(const LogPlot& plot) {
  std::string csv = fmt::format("curve,{},{}\n", csv_field(plot.x_label), csv_field(plot.y_label));
  for (const LogCurve& curve : plot.curves)
    for (const LogPoint& p : curve.points) csv += fmt::format("{},{:.8g},{:.8g}\n", csv_field(curve.name), p.x, p.y);
  return csv;
}

std::string picture(const LogCurve& curve, const Axis& x, const Axis& y) {
  std::string path, dots;
  for (const LogPoint& p : curve.points) {
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x.at(p.x), y.at(p.y));
    dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\"><title>{}</title></circle>", x.at(p.x), y.at(p.y),
                        xml_escape(p.tip));
  }
  return fmt::format("<path class=\"curve\" d=\"{}\"/>{}", path, dots);
}

}  // namespace

std::string log_plot(const LogPlot& plot) {
  const Axis x = axis_of(
      plot, [](const LogPoint& p) { return p.x; }, kLeft, kWidth - kRight);
  const Axis y = axis_of(
      plot, [](const LogPoint& p) { return p.y; }, kHeight - kBottom, kTop);
  std::string legend, curves;
  std::map<std::size_t, std::size_t> drawn;  // of each colour
  for (const LogCurve& curve : plot.curves) {
    const std::string style = own_colour(curve.colour, drawn[curve.colour]++);
    legend += fmt::format("<span style=\"{}\"><i style=\"border-color:var(--own)\"></i>{}</span>", style,
                          xml_escape(curve.name));
    curves += fmt::format("<g style=\"{}\">{}</g>\n", style, picture(curve, x, y));
  }
  return plot_figure({plot.title, legend, kWidth, kHeight, grid(plot, x, y) + labels(plot) + curves, csv_of(plot)});
}

}  // namespace carom::compare
