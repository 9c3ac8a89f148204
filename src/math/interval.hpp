// A range of numbers, as values that users give are declared with.
#pragma once

#include <limits>

namespace carom {

/// The numbers between two bounds, and those bounds that are closed.
struct Interval {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool is_closed_low = false, is_closed_high = false;

  bool operator==(const Interval&) const = default;
};

}  // namespace carom
