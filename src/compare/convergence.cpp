#include "compare/convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace carom::compare {

namespace {

/// The stiffness as a number; NaN for a word.
double stiffness_of(const Variant& variant) {
  double value = std::nan("");
  if (variant.choice.stiffness) {
    const std::string& word = *variant.choice.stiffness;
    std::from_chars(word.data(), word.data() + word.size(), value);
  }
  return value;
}

double abscissa(const Result& result, Along along) {
  switch (along) {
    case Along::cells:
      return result.variant.cells;
    case Along::step:
      return result.step();
    case Along::stiffness:
      return stiffness_of(result.variant);
  }
  return std::nan("");
}

/// Name of the series: the choice without what varies along it.
std::string series_name(const Variant& variant, bool with_stiffness, bool with_cells, bool with_courant) {
  Choice shared = variant.varied;
  shared.scheme = variant.scheme;
  if (!with_stiffness) shared.stiffness.reset();
  if (!with_cells) {
    shared.cells.reset();
    shared.refine.reset();
  }
  if (!with_courant) shared.courant.reset();
  return label_of(shared);
}

void add_point(std::vector<Series>& all, const std::string& name, const Point& point) {
  if (!std::isfinite(point.x) || !(point.x > 0.0) || !std::isfinite(point.y) || !(point.y > 0.0)) return;
  const auto same = std::find_if(all.begin(), all.end(), [&name](const Series& s) { return s.name == name; });
  Series& series = same != all.end() ? *same : all.emplace_back(Series{name, {}, {}});
  series.points.push_back(point);
}

void sort_points(std::vector<Series>& all) {
  for (Series& s : all) {
    std::sort(s.points.begin(), s.points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  }
}

bool has_different_x(const Series& s) {
  return s.points.size() > 1 && s.points.back().x > s.points.front().x * (1.0 + 1e-6);
}

std::optional<Order> order_of(std::span<const double> x, std::span<const double> y) {
  if (x.size() < 3) return std::nullopt;
  const std::optional<double> all = slope(x, y);
  if (!all) return std::nullopt;
  Order order{*all, *all, *all};
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const std::optional<double> pair = slope(x.subspan(i, 2), y.subspan(i, 2));
    if (!pair) continue;
    order.least = std::min(order.least, *pair);
    order.largest = std::max(order.largest, *pair);
  }
  return order;
}

}  // namespace

std::string to_string(const Order& order) {
  return fmt::format("{:.2f} ({:.2f} to {:.2f})", order.slope, order.least, order.largest);
}

std::optional<double> slope(std::span<const double> x, std::span<const double> y) {
  double mean_x = 0.0, mean_y = 0.0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += std::log(x[i]) / n;
    mean_y += std::log(y[i]) / n;
  }
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = std::log(x[i]) - mean_x;
    xx += dx * dx;
    xy += dx * (std::log(y[i]) - mean_y);
  }
  if (!(xx > 1e-12)) return std::nullopt;  // round-off of equal logarithms
  return xy / xx;
}

std::vector<Series> series_along(const std::vector<Result>& results, Along along, const std::string& quantity) {
  std::vector<Series> all;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Result& r = results[i];
    if (!r.compared() || !r.is_judged) continue;
    const std::string name =
        series_name(r.variant, along != Along::stiffness, along != Along::cells, along != Along::step);
    add_point(all, name, {abscissa(r, along), r.error(quantity), i});
  }
  sort_points(all);
  for (Series& s : all) {
    std::vector<double> x, y;
    for (const Point& p : s.points) {
      x.push_back(along == Along::step ? p.x : 1.0 / p.x);
      y.push_back(p.y);
    }
    s.order = order_of(x, y);
  }
  std::erase_if(all, [](const Series& s) { return !has_different_x(s); });
  return all;
}

std::vector<Series> series_of_cost(const std::vector<Result>& results, const std::string& quantity,
                                   ReferenceKind reference) {
  std::vector<Series> all;
  const auto other_cells = [&results](const Result& r) { return r.variant.cells != results.front().variant.cells; };
  const bool by_cells = std::any_of(results.begin(), results.end(), other_cells);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Result& r = results[i];
    if (!r.failure.empty()) continue;
    const double error = reference == ReferenceKind::exact ? r.error(quantity) : r.claimed;
    add_point(all, series_name(r.variant, true, false, by_cells), {r.cpu_seconds(), error, i});
  }
  sort_points(all);
  return all;
}

}  // namespace carom::compare
