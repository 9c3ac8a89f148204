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

/// A slope by least squares, and the least and the largest of the slopes between neighbouring points.
struct Order {
  double slope = 0.0, least = 0.0, largest = 0.0;
};

/// "1.02 (0.98 to 1.1)"
std::string to_string(const Order& order);

/// Variants that differ in one quantity only, ascending in x.
struct Series {
  std::string name;  ///< what they have in common
  std::vector<Point> points;
  /// cells: p of error ~ (1 / cells)^p; step: of error ~ step^p; stiffness: of error ~ (1 / stiffness)^p. Only of three
  /// points or more.
  std::optional<Order> order;
};

enum class Along : std::uint8_t { cells, step, stiffness };

/// All series of at least two points along a quantity, with the L2 error of `quantity` as y. Variants that were not
/// compared, have no error, or share mesh, step or enforcement with the reference, are left out.
std::vector<Series> series_along(const std::vector<Result>& results, Along along, const std::string& quantity);

/// Error (where there is no exact solution the one that is claimed) over processor time, without order: variants that
/// differ in their cells only, or, where all have the same cells, in their step.
std::vector<Series> series_of_cost(const std::vector<Result>& results, const std::string& quantity,
                                   ReferenceKind reference);

}  // namespace carom::compare
