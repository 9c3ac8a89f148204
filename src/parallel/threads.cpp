#include "parallel/threads.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

double dot(std::span<const double> a, std::span<const double> b) {
  return parallel_sum(a.size(), [&](std::size_t i) { return a[i] * b[i]; });
}

double sum_of(std::span<const double> values) {
  return parallel_sum(values.size(), [&](std::size_t i) { return values[i]; });
}

double largest_of(std::span<const double> values) {
  return parallel_max(values.size(), 0.0, [&](std::size_t i) { return std::abs(values[i]); });
}

bool is_zero(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return value == 0.0; });
}

bool is_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

}  // namespace carom
