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
  const double wd = 2.0 * std::numbers::pi * cfc * 2.0775;
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
  // Continue both ends by point reflection for one period of the cut-off, or as far as the data go.
  const auto wanted = static_cast<std::size_t>(std::ceil(1.0 / (2.0775 * cfc * dt)));
  const std::size_t pad = std::min(wanted, samples.size() - 1);
  std::vector<double> y(samples.size() + 2 * pad);
  std::copy(samples.begin(), samples.end(), y.begin() + static_cast<std::ptrdiff_t>(pad));
  for (std::size_t i = 1; i <= pad; ++i) {
    y[pad - i] = 2.0 * samples.front() - samples[i];
    y[y.size() - 1 - pad + i] = 2.0 * samples.back() - samples[samples.size() - 1 - i];
  }
  const Coefficients k = coefficients(dt, cfc);
  pass(k, y);
  std::reverse(y.begin(), y.end());
  pass(k, y);
  std::reverse(y.begin(), y.end());
  const auto first = y.begin() + static_cast<std::ptrdiff_t>(pad);
  return {first, first + static_cast<std::ptrdiff_t>(samples.size())};
}

}  // namespace carom
