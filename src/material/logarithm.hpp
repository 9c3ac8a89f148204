// Logarithm and exponential near 1 over a number type, to round-off relative to themselves.
#pragma once

#include <cmath>

#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// log = ln(1 + q) and rest = q - log, both to round-off relative to themselves near q = 0. With s = q / (2 + q),
/// ln(1 + q) = 2 artanh(s) = 2 s + 2 s^3 (1/3 + s^2/5 + ...); ten terms leave 1e-17 for s^2 <= 0.04 (1 + q between 2/3
/// and 3/2), and lanes beyond that take the library's function.
template <class Real>
[[gnu::always_inline]] static inline void logarithm(const Real& q, Real& log, Real& rest) {
  constexpr double largest_square = 0.04;
  const Real s = q / (2.0 + q), t = s * s;
  Real sum = Real{} + 1.0 / 21.0;
  for (int k = 19; k >= 3; k -= 2) sum = sum * t + 1.0 / k;
  const Real tail = 2.0 * s * t * sum;
  log = 2.0 * s + tail;
  rest = q * s - tail;
  constexpr int n = lanes<Real>;
  double square[n], change[n], log_lane[n], rest_lane[n];
  store(square, t);
  bool all_near = true;
  for (int l = 0; l < n; ++l) all_near = all_near && square[l] <= largest_square;
  if (all_near) return;
  store(change, q);
  store(log_lane, log);
  store(rest_lane, rest);
  for (int l = 0; l < n; ++l) {
    if (square[l] <= largest_square) continue;
    log_lane[l] = std::log1p(change[l]);
    rest_lane[l] = change[l] - log_lane[l];
  }
  log = load<Real>(log_lane);
  rest = load<Real>(rest_lane);
}

/// exp(x) - 1: twelve terms of its series leave 1e-17 of it for |x| <= 0.2, and lanes beyond that take the library's
/// function.
template <class Real>
[[gnu::always_inline]] static inline Real exponential_less_one(const Real& x) {
  constexpr double largest = 0.2;
  Real sum = Real{} + 1.0;
  for (int k = 12; k >= 2; --k) sum = 1.0 + sum * x * (1.0 / k);
  const Real result = x * sum;
  constexpr int n = lanes<Real>;
  double argument[n], value[n];
  store(argument, x);
  store(value, result);
  for (int l = 0; l < n; ++l)
    if (!(argument[l] <= largest && argument[l] >= -largest)) value[l] = std::expm1(argument[l]);
  return load<Real>(value);
}

}  // namespace carom
