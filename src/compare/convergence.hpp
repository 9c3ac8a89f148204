// How the error falls along one of the varied quantities.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/measure.hpp"

namespace carom::compare {

/// Slope of log(y) over log(x) by least squares; nothing with fewer than two different x. All numbers positive.
std::optional<double> slope(std::span<const double> x, std::span<const double> y);

struct Point {
  double x = 0.0, y = 0.0;
  std::size_t result = 0;  ///< its position
};

/// Variants that differ in one quantity only, ascending in x.
struct Series {
  std::string name;  ///< what they have in common
  std::vector<Point> points;
  /// cells: p of error ~ (1 / cells)^p; step: of error ~ step^p; stiffness: of error ~ (1 / stiffness)^p.
  std::optional<double> order;
};

enum class Along : std::uint8_t { cells, step, stiffness };

/// All series of at least two points along a quantity, with the L2 error of `quantity` as y. Variants that were not
/// compared, or have no error, are left out.
std::vector<Series> series_along(const std::vector<Result>& results, Along along, const std::string& quantity);

/// Error over processor time, without order: variants that differ in their cells only, or, where all have the same
/// cells, in their step.
std::vector<Series> series_of_cost(const std::vector<Result>& results, const std::string& quantity);

}  // namespace carom::compare
