// Logarithm, exponential and power over a number type, without calls of the library.
#pragma once

#include <limits>

#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp. Errors are those found by tests/unit/math/elementary_test.cpp, in
// units of the rounding of the result (2^-52 of it).
namespace carom {

namespace elementary {

using Bits = unsigned long long;

/// ln 2 = high + low; the product of high and any exponent is exact (fdlibm, e_log.c).
inline constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
/// x + shifter is a whole number, the lowest bits of the sum.
inline constexpr double shifter = 0x1.8p52;
inline constexpr Bits shifter_bits = 0x4338000000000000;

/// 2^k of k + shifter, |k| < 1023.
template <class Real>
[[gnu::always_inline]] static inline Real power_of_two(const Real& shifted) {
  double lane[lanes<Real>];
  store(lane, shifted);
  for (int l = 0; l < lanes<Real>; ++l)
    lane[l] = __builtin_bit_cast(double, (__builtin_bit_cast(Bits, lane[l]) + 1023) << 52);
  return load<Real>(lane);
}

/// x = m 2^e, m between the square roots of 1/2 and 2, of a normal x > 0.
template <class Real>
[[gnu::always_inline]] static inline void split(const Real& x, Real& m, Real& e) {
  constexpr Bits low = 0x3FE6A09E667F3BCD, offset = 1024;  // the square root of 1/2; so that nothing is negative
  double mantissa[lanes<Real>], exponent[lanes<Real>];
  store(mantissa, x);
  for (int l = 0; l < lanes<Real>; ++l) {
    const Bits bits = __builtin_bit_cast(Bits, mantissa[l]), k = ((bits - low + (offset << 52)) >> 52) - offset;
    mantissa[l] = __builtin_bit_cast(double, bits - (k << 52));
    exponent[l] = __builtin_bit_cast(double, shifter_bits + k);
  }
  m = load<Real>(mantissa);
  e = load<Real>(exponent) - shifter;
}

/// c[0] + c[1] x + ... + c[n - 1] x^(n - 1) in pairs, which do not wait for each other as Horner's do (Estrin's
/// scheme).
template <class Real, int n>
[[gnu::always_inline]] static inline Real polynomial(const double (&c)[n], Real x) {
  Real term[(n + 1) / 2];
  for (int i = 0; i < n / 2; ++i) term[i] = c[2 * i] + c[2 * i + 1] * x;
  if (n % 2 == 1) term[n / 2] = Real{} + c[n - 1];
  for (int left = (n + 1) / 2; left > 1; left = (left + 1) / 2) {
    x = x * x;
    for (int i = 0; i < left / 2; ++i) term[i] = term[2 * i] + x * term[2 * i + 1];
    if (left % 2 == 1) term[left / 2] = term[left - 1];
  }
  return term[0];
}

/// ln(1 + f) = 2 artanh(s) = 2 s + tail, s = f / (2 + f), tail = 2 s^3 (1/3 + s^2/5 + ...); ten terms leave 1e-17 for
/// s^2 <= 0.04, 1 + f between 2/3 and 3/2.
template <class Real>
[[gnu::always_inline]] static inline Real artanh_tail(const Real& s) {
  constexpr double odd[] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                            1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};
  const Real t = s * s;
  return (2.0 * s * t) * polynomial(odd, t);
}

/// exp(x) = scale (1 + p), p = exp(r) - 1 of |r| <= ln(2) / 2, of which thirteen terms leave 1e-17. Beyond +-708 x is
/// cut off.
template <class Real>
[[gnu::always_inline]] static inline void reduced_exponential(const Real& x, Real& scale, Real& p) {
  constexpr double largest = 708.0, by_ln2 = 1.44269504088896338700;
  const Real zero{};
  const Real high = x > largest ? zero + largest : x, within = high < -largest ? zero - largest : high;
  const Real shifted = within * by_ln2 + shifter, k = shifted - shifter;
  const Real r = (within - k * ln2_high) - k * ln2_low;
  scale = power_of_two(shifted);
  constexpr double factorial[] = {1.0 / 2,       1.0 / 6,        1.0 / 24,        1.0 / 120,
                                  1.0 / 720,     1.0 / 5040,     1.0 / 40320,     1.0 / 362880,
                                  1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800.0};
  p = r + (r * r) * polynomial(factorial, r);
}

}  // namespace elementary

/// log = ln(1 + q) and rest = q - log, both to round-off relative to themselves near q = 0; not numbers for q <= -1.
template <class Real>
[[gnu::always_inline]] static inline void logarithm(const Real& q, Real& log, Real& rest) {
  constexpr double least = -1.0 / 3.0, largest = 0.5;
  const Real zero{}, one = zero + 1.0, y = 1.0 + q;
  const auto series = [](const Real& f, Real& sum, Real& beyond) {
    const Real s = f / (2.0 + f), tail = elementary::artanh_tail(s);
    sum = 2.0 * s + tail;
    beyond = f * s - tail;
  };
  if (!any_above(q, largest) && !any_above(Real(-q), -least)) return series(q, log, rest);
  Real m, e;
  elementary::split(Real(y > 0.0 ? y : one), m, e);
  const Real is_far = q > largest ? one : (q < least ? one : zero);
  series(Real(is_far > 0.0 ? m - 1.0 : q), log, rest);
  const Real far = e * elementary::ln2_high + (log + e * elementary::ln2_low);
  log = is_far > 0.0 ? (y > 0.0 ? far : zero + std::numeric_limits<double>::quiet_NaN()) : log;
  rest = is_far > 0.0 ? q - log : rest;
}

/// ln(x) of a normal x > 0.
template <class Real>
[[gnu::always_inline]] static inline Real natural_logarithm(const Real& x) {
  Real m, e;
  elementary::split(x, m, e);
  const Real f = m - 1.0, s = f / (2.0 + f);
  return e * elementary::ln2_high + (2.0 * s + (elementary::artanh_tail(s) + e * elementary::ln2_low));
}

/// exp(x) - 1, to round-off of itself; x up to 708.
template <class Real>
[[gnu::always_inline]] static inline Real exponential_less_one(const Real& x) {
  Real scale, p;
  elementary::reduced_exponential(x, scale, p);
  return scale * p + (scale - 1.0);
}

/// exp(x), |x| up to 708.
template <class Real>
[[gnu::always_inline]] static inline Real exponential(const Real& x) {
  Real scale, p;
  elementary::reduced_exponential(x, scale, p);
  return scale * p + scale;
}

/// x^n of a normal x > 0: the rounding of n ln(x) comes on top.
template <class Real>
[[gnu::always_inline]] static inline Real power(const Real& x, double n) {
  return exponential(Real(n * natural_logarithm(x)));
}

}  // namespace carom
