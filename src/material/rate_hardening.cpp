#include "material/rate_hardening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace carom {

namespace {

using Points = std::vector<std::array<double, 2>>;

/// Stress and slope of a polygon, the last stress of which holds beyond.
std::pair<double, double> on_polygon(const Points& points, double alpha) {
  const auto after =
      std::upper_bound(points.begin(), points.end(), alpha,
                       [](double value, const std::array<double, 2>& point) { return value < point[0]; });
  if (after == points.end()) return {points.back()[1], 0.0};
  const auto before = after == points.begin() ? after : after - 1;
  if (before == after) return {points.front()[1], 0.0};
  const double slope = ((*after)[1] - (*before)[1]) / ((*after)[0] - (*before)[0]);
  return {(*before)[1] + slope * (alpha - (*before)[0]), slope};
}

/// The polygons of a table in which each begins at plastic strain 0.
std::vector<Points> polygons_of(const Points& table) {
  std::vector<Points> polygons;
  for (const auto& point : table) {
    if (polygons.empty() || point[0] == 0.0) polygons.emplace_back();
    polygons.back().push_back(point);
  }
  return polygons;
}

}  // namespace

RateHardening::RateHardening(const Material& material) {
  const std::vector<Points> polygons = polygons_of(material.curve);
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < polygons.size(); ++i) curves.push_back({material.rates.at(i), polygons[i]});
  curves_ = std::make_shared<const std::vector<Curve>>(std::move(curves));
}

RateHardening::Value RateHardening::at(double alpha, double rate) const {
  const std::vector<Curve>& curves = *curves_;
  const auto after = std::upper_bound(curves.begin(), curves.end(), rate,
                                      [](double value, const Curve& curve) { return value < curve.rate; });
  if (after == curves.begin() || after == curves.end()) {
    const Curve& only = after == curves.end() ? curves.back() : curves.front();
    const auto [stress, slope] = on_polygon(only.points, alpha);
    return {stress, slope, 0.0};
  }
  const Curve &slower = *(after - 1), &faster = *after;
  const auto [low, low_slope] = on_polygon(slower.points, alpha);
  const auto [high, high_slope] = on_polygon(faster.points, alpha);
  const double between = 1.0 / (faster.rate - slower.rate), share = (rate - slower.rate) * between;
  return {low + share * (high - low), low_slope + share * (high_slope - low_slope), (high - low) * between};
}

RateHardening::Return RateHardening::returned(double alpha, double trial, double three_G, double dt) const {
  const double per_time = dt > 0.0 ? 1.0 / dt : 0.0;
  const double excess = trial - at(alpha, 0.0).stress;
  if (!(excess > 0.0)) return {};
  // What is left of the trial stress falls; Newton's method where it stays between both sides, else halving.
  double low = 0.0, high = excess / three_G, x = high;
  Return found;
  constexpr int most = 100;
  for (int i = 0; i < most; ++i) {
    const Value y = at(alpha + x, x * per_time);
    found = {x, y.over_alpha + y.over_rate * per_time};
    const double left = trial - three_G * x - y.stress;
    if (std::abs(left) <= 4e-16 * trial) break;  // its rounding
    (left > 0.0 ? low : high) = x;
    const double newton = x + left / (three_G + found.slope);
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == x || next == low || next == high) break;
    x = next;
  }
  return found;
}

std::optional<LawProblem> check_rate_hardening(const Material& material) {
  const std::string table = "hardening_tables", rates = "rates";
  if (material.curve.empty()) return LawProblem{table, "nothing", "points [plastic strain, yield stress]", ""};
  if (material.curve.front()[0] != 0.0)
    return LawProblem{table, fmt::format("a first plastic strain of {:g}", material.curve.front()[0]), "0", ""};
  const std::vector<Points> polygons = polygons_of(material.curve);
  if (polygons.size() != material.rates.size())
    return LawProblem{rates, fmt::format("{} rates and {} curves", material.rates.size(), polygons.size()),
                      "one rate for each curve", "Each curve begins at plastic strain 0."};
  for (std::size_t i = 1; i < material.rates.size(); ++i)
    if (!(material.rates[i] > material.rates[i - 1]))
      return LawProblem{rates, fmt::format("{:g} after {:g}", material.rates[i], material.rates[i - 1]),
                        "rates in increasing order", ""};
  std::set<double> strains;
  for (const Points& points : polygons) {
    if (!(points.front()[1] > 0.0))
      return LawProblem{table, "a first yield stress of 0", "a yield stress > 0",
                        "A body that yields at once has no elastic states; take an elastic law, or a small stress."};
    for (std::size_t i = 0; i < points.size(); ++i) {
      strains.insert(points[i][0]);
      if (i == 0) continue;
      if (!(points[i][0] > points[i - 1][0]))
        return LawProblem{table, fmt::format("plastic strain {:g} after {:g}", points[i][0], points[i - 1][0]),
                          "plastic strains in increasing order in each curve", ""};
      if (points[i][1] < points[i - 1][1])
        return LawProblem{table, fmt::format("yield stress {:g} after {:g}", points[i][1], points[i - 1][1]),
                          "yield stresses that do not fall",
                          "Softening bodies localise in single cells; end the curve at its highest stress."};
    }
  }
  for (std::size_t i = 1; i < polygons.size(); ++i)
    for (const double strain : strains) {
      const double slow = on_polygon(polygons[i - 1], strain).first, fast = on_polygon(polygons[i], strain).first;
      if (fast < slow)
        return LawProblem{table,
                          fmt::format("{:g} at the rate {:g}, below {:g} at the rate {:g}, at plastic strain {:g}",
                                      fast, material.rates[i], slow, material.rates[i - 1], strain),
                          "yield stresses that do not fall with the rate", "Such bodies localise in single cells."};
    }
  return std::nullopt;
}

}  // namespace carom
