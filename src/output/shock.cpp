#include "output/shock.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "math/vec3.hpp"

namespace carom {

namespace {

/// The mean over an interval, to the power 2.5, times its length.
double injury(double integral, double length) {
  const double mean = integral / length;
  return length * mean * mean * std::sqrt(mean);
}

/// Where a line through two samples reaches a level, from 0 at the first to 1 at the second.
double crossing(double first, double second, double level) {
  return first == second ? 0.0 : std::clamp((level - first) / (second - first), 0.0, 1.0);
}

/// 1 - sin(x) / x
double one_less_sinc(double x) {
  constexpr double small = 0.02;  // three terms of the series: 1e-15 relative
  if (x > small) return 1.0 - std::sin(x) / x;
  return x * x / 6.0 * (1.0 - x * x / 20.0 * (1.0 - x * x / 42.0));
}

/// The absolute acceleration of an oscillator by Smallwood's recursion, for its increments, so that natural frequencies
/// far below that of the samples lose no digits: with d_k = y_k - y_(k-1)
///   d_k = e^-2A d_(k-1) - (b0 + b1 + b2) y_(k-1) + b0 x_k + b1 x_(k-1) + b2 x_(k-2).
class RampFilter {
 public:
  RampFilter(double angle, double quality_factor)
      : a_(0.5 * angle / quality_factor), b_(angle * std::sqrt(1.0 - 0.25 / (quality_factor * quality_factor))) {
    const double decay = std::exp(-a_), lost = std::expm1(-a_), half = std::sin(0.5 * b_), g = one_less_sinc(b_);
    b0_ = decay * g - lost;
    b1_ = 2.0 * decay * (2.0 * half * half - g);
    b2_ = decay * (lost + g);
    kept_ = decay * decay;
    spring_ = lost * lost + 4.0 * decay * half * half;
  }
  double next(double x) {
    d_ = kept_ * d_ - spring_ * y_ + b0_ * x + b1_ * x1_ + b2_ * x2_;
    y_ += d_;
    x2_ = x1_;
    x1_ = x;
    return y_;
  }
  /// Largest magnitude from the last sample but one on, where the base has no acceleration any more: of the free
  /// vibration y = e^(-A s) (c cos(B s) + e sin(B s)), s in samples, through the last two.
  double residual() const {
    const double half = std::sin(0.5 * b_), c = y_ - d_,
                 e = (c * (std::expm1(a_) + 2.0 * half * half) + d_ * std::exp(a_)) / std::sin(b_);
    double phase = std::atan2(b_ * e - a_ * c, b_ * c + a_ * e);  // where dy/ds = 0
    if (phase < 0.0) phase += std::numbers::pi;
    return std::max(std::abs(c), std::abs(std::exp(-a_ * phase / b_) * (c * std::cos(phase) + e * std::sin(phase))));
  }

 private:
  double a_, b_, b0_ = 0.0, b1_ = 0.0, b2_ = 0.0, kept_ = 0.0, spring_ = 0.0;
  double x1_ = 0.0, x2_ = 0.0, y_ = 0.0, d_ = 0.0;
};

}  // namespace

HeadInjury head_injury_criterion(std::span<const double> a, double dt, double window) {
  if (a.size() < 2) return {};
  std::vector<double> velocity(a.size(), 0.0);
  for (std::size_t i = 1; i < a.size(); ++i) velocity[i] = velocity[i - 1] + 0.5 * dt * (a[i - 1] + a[i]);
  constexpr double rounding = 1e-9, most_pairs = 3e7;
  const auto longest = static_cast<std::size_t>(window / dt * (1.0 + rounding));
  const std::size_t within = std::min(longest, a.size() - 1);
  const double pairs = static_cast<double>(a.size()) * static_cast<double>(within);
  // Of long records every some samples first, then all around the best: at a maximum both ends change it little.
  const auto stride = static_cast<std::size_t>(std::ceil(std::sqrt(std::max(1.0, pairs / most_pairs))));
  HeadInjury best;
  std::size_t first = 0, last = 0;
  const auto look = [&](std::size_t i, std::size_t j) {
    const double value = injury(velocity[j] - velocity[i], dt * static_cast<double>(j - i));
    if (!(value > best.value)) return;
    best.value = value;
    first = i;
    last = j;
  };
  for (std::size_t i = 0; i < a.size(); i += stride)
    for (std::size_t j = i + stride; j < a.size() && j - i <= within; j += stride) look(i, j);
  const std::size_t i0 = first - std::min(first, stride), i1 = first + stride, j0 = last - std::min(last, stride),
                    j1 = std::min(last + stride, a.size() - 1);
  for (std::size_t i = i0; stride > 1 && i <= i1; ++i)
    for (std::size_t j = std::max(i + 1, j0); j <= j1 && j - i <= within; ++j) look(i, j);
  best.begin = dt * static_cast<double>(first);
  best.end = dt * static_cast<double>(last);
  return best;
}

ShockPulse shock_pulse(const std::array<std::vector<double>, 3>& a, double dt) {
  ShockPulse pulse;
  const std::size_t n = a[0].size();
  const auto at = [&](std::size_t i) { return Vec3{a[0][i], a[1][i], a[2][i]}; };
  std::size_t top = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (const double value = norm(at(i)); value > pulse.peak) {
      pulse.peak = value;
      top = i;
    }
  if (pulse.peak == 0.0) return pulse;
  const Vec3 along = scaled(at(top), 1.0 / pulse.peak);
  std::vector<double> s(n);
  for (std::size_t i = 0; i < n; ++i) s[i] = dot(at(i), along);
  constexpr double share = 0.1;
  /// How many samples it is from the peak to where the component falls to a level, in one direction.
  const auto way = [&](double level, std::ptrdiff_t step) {
    auto i = static_cast<std::ptrdiff_t>(top);
    const auto end = static_cast<std::ptrdiff_t>(n);
    for (; i + step >= 0 && i + step < end; i += step) {
      const double here = s[static_cast<std::size_t>(i)], next = s[static_cast<std::size_t>(i + step)];
      if (next <= level)
        return std::abs(static_cast<double>(i - static_cast<std::ptrdiff_t>(top))) + crossing(here, next, level);
    }
    return std::abs(static_cast<double>(i - static_cast<std::ptrdiff_t>(top)));
  };
  const auto time = [&](double samples) { return dt * samples; };
  const double middle = static_cast<double>(top), before = way(0.0, -1), after = way(0.0, 1);
  pulse.time = time(middle);
  pulse.begin = time(middle - way(share * pulse.peak, -1));
  pulse.end = time(middle + way(share * pulse.peak, 1));
  // The trapezoidal rule over whole intervals, and triangles to where the component is zero.
  const std::size_t low = top - static_cast<std::size_t>(before), high = top + static_cast<std::size_t>(after);
  double sum = 0.5 * s[low] * (before - std::floor(before)) + 0.5 * s[high] * (after - std::floor(after));
  for (std::size_t i = low; i < high; ++i) sum += 0.5 * (s[i] + s[i + 1]);
  pulse.velocity_change = dt * sum;
  return pulse;
}

std::vector<double> shock_response_spectrum(std::span<const double> a, double dt, std::span<const double> frequencies,
                                            double quality_factor) {
  std::vector<double> spectrum;
  for (const double frequency : frequencies) {
    RampFilter filter(2.0 * std::numbers::pi * frequency * dt, quality_factor);
    double largest = 0.0;
    for (const double x : a) largest = std::max(largest, std::abs(filter.next(x)));
    filter.next(0.0);
    filter.next(0.0);
    spectrum.push_back(std::max(largest, filter.residual()));
  }
  return spectrum;
}

std::vector<double> spectrum_frequencies(double duration, double highest) {
  constexpr double per_octave = 12.0, rounding = 1e-9;
  std::vector<double> frequencies;
  const auto last = static_cast<long>(std::floor(per_octave * std::log2(highest) + rounding));
  for (auto k = static_cast<long>(std::ceil(per_octave * std::log2(0.1 / duration) - rounding)); k <= last; ++k)
    frequencies.push_back(std::exp2(static_cast<double>(k) / per_octave));
  return frequencies;
}

}  // namespace carom
