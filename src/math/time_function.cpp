#include "math/time_function.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "math/called_function.hpp"

namespace carom {

namespace {

/// First entry after t, or of those that are at t the first. A time that misses an entry by rounding alone (steps are
/// multiples of dt) has reached it.
std::vector<double>::const_iterator next_entry(const std::vector<double>& time, double t, JumpSide side) {
  constexpr double rounding = 1e-12;
  return side == JumpSide::after ? std::upper_bound(time.begin(), time.end(), t + rounding * std::abs(t))
                                 : std::lower_bound(time.begin(), time.end(), t - rounding * std::abs(t));
}

/// Calls visit(p, f(p), q, f(q)) for every piece [p, q] of [a, b] on which f is linear, from the left to the right.
template <class Visit>
void each_piece(const TimeFunction& f, double a, double b, const Visit& visit) {
  const std::vector<double>&t = f.time, &y = f.value;
  auto i = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), a) - t.begin());  // the first entry after p
  for (double p = a; p < b; ++i) {
    const double q = i < t.size() ? std::min(b, t[i]) : b;
    const auto at = [&](double s) {
      if (i == 0) return y.front();
      if (i == t.size()) return y.back();
      return y[i - 1] + (y[i] - y[i - 1]) * (s - t[i - 1]) / (t[i] - t[i - 1]);
    };
    if (q > p) visit(p, at(p), q, at(q));
    p = q;
  }
}

}  // namespace

double TimeFunction::operator()(double t, JumpSide side) const {
  if (called) return value.front() * called->at(t);
  const auto next = next_entry(time, t, side);
  if (next == time.begin()) return value.front();
  if (next == time.end()) return value.back();
  const auto i = static_cast<std::size_t>(next - time.begin());
  return value[i - 1] + (value[i] - value[i - 1]) * (t - time[i - 1]) / (time[i] - time[i - 1]);
}

double TimeFunction::derivative(double t) const {
  if (called) return value.front() * called->derivative(t);
  const auto next = next_entry(time, t, JumpSide::after);
  if (next == time.begin() || next == time.end()) return 0.0;
  const auto i = static_cast<std::size_t>(next - time.begin());
  return (value[i] - value[i - 1]) / (time[i] - time[i - 1]);
}

double TimeFunction::integral(double a, double b) const {
  if (called) return value.front() * called->integral(a, b);
  double sum = 0.0;
  each_piece(*this, a, b, [&](double p, double f_p, double q, double f_q) { sum += 0.5 * (q - p) * (f_p + f_q); });
  return sum;
}

double TimeFunction::second_integral(double a, double b) const {
  if (called) return value.front() * called->second_integral(a, b);
  double sum = 0.0;
  each_piece(*this, a, b, [&](double p, double f_p, double q, double f_q) {
    // Simpson's rule on the product of two linear functions.
    sum += (q - p) / 6.0 * ((b - p) * f_p + (2.0 * b - p - q) * (f_p + f_q) + (b - q) * f_q);
  });
  return sum;
}

}  // namespace carom
