#include "math/time_function.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace carom {

namespace {

/// First entry after t. A time that misses an entry by rounding alone (steps are multiples of dt) has reached it.
std::vector<double>::const_iterator first_after(const std::vector<double>& time, double t) {
  return std::upper_bound(time.begin(), time.end(), t + 1e-12 * std::abs(t));
}

}  // namespace

double TimeFunction::operator()(double t) const {
  const auto next = first_after(time, t);
  if (next == time.begin()) return value.front();
  if (next == time.end()) return value.back();
  const auto i = static_cast<std::size_t>(next - time.begin());
  return value[i - 1] + (value[i] - value[i - 1]) * (t - time[i - 1]) / (time[i] - time[i - 1]);
}

double TimeFunction::derivative(double t) const {
  const auto next = first_after(time, t);
  if (next == time.begin() || next == time.end()) return 0.0;
  const auto i = static_cast<std::size_t>(next - time.begin());
  return (value[i] - value[i - 1]) / (time[i] - time[i - 1]);
}

}  // namespace carom
