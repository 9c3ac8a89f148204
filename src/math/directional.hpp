// Numbers with their change along one direction (forward differentiation), over a number type of the kernels.
#pragma once

#include "math/pack.hpp"

// Everything is inlined into functions of internal linkage: see math/pack.hpp.
namespace carom {

/// A value and its change: what is computed of values comes out with its derivative along the direction, exact to
/// round-off (Griewank and Walther, Evaluating Derivatives, 2nd ed., chapter 3). For gradients of polynomials at
/// compile time there is math/dual.hpp.
template <class Real>
struct Directional {
  Real value{}, change{};
};

template <class Real>
[[gnu::always_inline]] static inline Directional<Real> operator+(const Directional<Real>& a,
                                                                 const Directional<Real>& b) {
  return {a.value + b.value, a.change + b.change};
}
template <class Real>
[[gnu::always_inline]] static inline Directional<Real> operator-(const Directional<Real>& a,
                                                                 const Directional<Real>& b) {
  return {a.value - b.value, a.change - b.change};
}
template <class Real>
[[gnu::always_inline]] static inline Directional<Real> operator-(const Directional<Real>& a) {
  return {-a.value, -a.change};
}
template <class Real>
[[gnu::always_inline]] static inline Directional<Real> operator*(const Directional<Real>& a,
                                                                 const Directional<Real>& b) {
  return {a.value * b.value, a.change * b.value + a.value * b.change};
}
template <class Real>
[[gnu::always_inline]] static inline Directional<Real> operator+(const Directional<Real>& a, const Real& b) {
  return {a.value + b, a.change};
}
template <class Real>
[[gnu::always_inline]] static inline Directional<Real> operator-(const Directional<Real>& a, const Real& b) {
  return {a.value - b, a.change};
}
/// Times a number that does not change: a scalar or one of each lane.
template <class Scalar, class Real>
[[gnu::always_inline]] static inline Directional<Real> operator*(const Scalar& a, const Directional<Real>& b) {
  return {a * b.value, a * b.change};
}
template <class Real>
[[gnu::always_inline]] static inline Directional<Real> operator/(double a, const Directional<Real>& b) {
  const Real quotient = a / b.value;
  return {quotient, -quotient * b.change / b.value};
}
template <class Real>
[[gnu::always_inline]] static inline Directional<Real>& operator+=(Directional<Real>& a, const Directional<Real>& b) {
  a.value += b.value;
  a.change += b.change;
  return a;
}
template <class Real>
[[gnu::always_inline]] static inline Directional<Real>& operator-=(Directional<Real>& a, const Directional<Real>& b) {
  a.value -= b.value;
  a.change -= b.change;
  return a;
}

}  // namespace carom
