#include "output/cfc_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace carom {

namespace {

struct Coefficients {
  double a0, a1, a2, b1, b2;
};

Coefficients coefficients(double dt, double cfc) {
  const double wd = 2.0 * std::numbers::pi * cfc_limit(cfc);
  const double wa = std::tan(wd * dt / 2.0);
  const double denominator = 1.0 + std::numbers::sqrt2 * wa + wa * wa;
  const double a0 = wa * wa / denominator;
  return {a0, 2.0 * a0, a0, -2.0 * (wa * wa - 1.0) / denominator,
          (-1.0 + std::numbers::sqrt2 * wa - wa * wa) / denominator};
}

/// One pass over y in place, started as if y[0] had been there for ever.
void pass(const Coefficients& k, std::vector<double>& y) {
  double x1 = y.front(), x2 = y.front(), y1 = y.front(), y2 = y.front();
  for (double& value : y) {
    const double x0 = value;
    value = k.a0 * x0 + k.a1 * x1 + k.a2 * x2 + k.b1 * y1 + k.b2 * y2;
    x2 = x1;
    x1 = x0;
    y2 = y1;
    y1 = value;
  }
}

/// The slope from sample to sample of the straight line of least squares; 0 of one sample.
double mean_slope(std::span<const double> samples) {
  const double middle = 0.5 * static_cast<double>(samples.size() - 1);
  double moment = 0.0, inertia = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double from_middle = static_cast<double>(i) - middle;
    moment += from_middle * samples[i];
    inertia += from_middle * from_middle;
  }
  return inertia > 0.0 ? moment / inertia : 0.0;
}

}  // namespace

std::vector<double> cfc_filter(std::span<const double> samples, double dt, double cfc) {
  if (!(cfc > 0.0) || !(dt > 0.0)) {
    throw std::invalid_argument(fmt::format("CFC filter: class {} and sampling step {} must be positive", cfc, dt));
  }
  if (dt * cfc > cfc_longest_sampling * (1.0 + 1e-9)) {
    throw std::invalid_argument(
        fmt::format("CFC {} needs a sample at least every {:.3g} s (10 times the class); found one every {:.3g} s", cfc,
                    cfc_longest_sampling / cfc, dt));
  }
  if (samples.empty()) return {};
  // After three periods of the cut-off a transient is exp(-3 sqrt(2) pi) of what it was.
  const double period = 1.0 / (cfc_limit(cfc) * dt);
  const std::size_t pad = std::min(static_cast<std::size_t>(std::ceil(3.0 * period)), samples.size() - 1),
                    near = std::min(static_cast<std::size_t>(std::ceil(2.0 * period)) + 1, samples.size());
  const double first_slope = mean_slope(samples.first(near)), last_slope = mean_slope(samples.last(near));
  std::vector<double> y(samples.size() + 2 * pad);
  std::copy(samples.begin(), samples.end(), y.begin() + static_cast<std::ptrdiff_t>(pad));
  for (std::size_t i = 1; i <= pad; ++i) {
    const double way = 2.0 * static_cast<double>(i);
    y[pad - i] = samples[i] - way * first_slope;
    y[y.size() - 1 - pad + i] = samples[samples.size() - 1 - i] + way * last_slope;
  }
  const Coefficients k = coefficients(dt, cfc);
  pass(k, y);
  std::reverse(y.begin(), y.end());
  pass(k, y);
  std::reverse(y.begin(), y.end());
  const auto first = y.begin() + static_cast<std::ptrdiff_t>(pad);
  return {first, first + static_cast<std::ptrdiff_t>(samples.size())};
}

std::vector<double> equal_times(std::span<const double> time, double cfc) {
  constexpr double rounding = 1e-6;  // far above that of times
  const double length = time.back() - time.front(), mean = length / static_cast<double>(time.size() - 1);
  double smallest = mean;
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double step = time[i] - time[i - 1];
    if (step > 1e-9 * mean) smallest = std::min(smallest, step);  // equal times are no interval
  }
  const double wanted = std::max(smallest, 1e-3 / cfc);
  const auto intervals = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length / wanted - rounding)));
  std::vector<double> at(intervals + 1);
  for (std::size_t i = 0; i <= intervals; ++i)
    at[i] = time.front() + length * (static_cast<double>(i) / static_cast<double>(intervals));
  return at;
}

std::vector<double> resampled(std::span<const double> time, std::span<const double> values,
                              std::span<const double> at) {
  std::vector<double> out;
  out.reserve(at.size());
  std::size_t next = 1;
  for (const double t : at) {
    while (next + 1 < time.size() && time[next] < t) ++next;
    const double step = time[next] - time[next - 1];
    const double w = step > 0.0 ? std::clamp((t - time[next - 1]) / step, 0.0, 1.0) : 1.0;
    out.push_back((1.0 - w) * values[next - 1] + w * values[next]);
  }
  return out;
}

}  // namespace carom
