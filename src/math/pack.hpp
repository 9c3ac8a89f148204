// Number types of the batch kernels: SIMD packs of doubles, one lane per cell, and plain double as the reference.
#pragma once

// Kernels are compiled once per instruction set. Everything here has internal linkage, so that the linker can never
// give code made for one instruction set to a unit made for another.
namespace carom {

using Pack2 = double __attribute__((vector_size(16)));
using Pack4 = double __attribute__((vector_size(32)));
using Pack8 = double __attribute__((vector_size(64)));

/// Number of doubles in a Real: 1, 2, 4 or 8.
template <class Real>
inline constexpr int lanes = static_cast<int>(sizeof(Real) / sizeof(double));

/// Real as it may stand anywhere in an array of doubles.
template <class Real>
struct InArray {
  using Type [[gnu::aligned(alignof(double)), gnu::may_alias]] = Real;
};

/// The `lanes<Real>` consecutive doubles at p (no alignment asked).
template <class Real>
[[gnu::always_inline]] static inline Real load(const double* p) {
  return *reinterpret_cast<const typename InArray<Real>::Type*>(p);
}

/// Writes the lanes of r to consecutive doubles at p.
template <class Real>
[[gnu::always_inline]] static inline void store(double* p, const Real& r) {
  *reinterpret_cast<typename InArray<Real>::Type*>(p) = r;
}

/// The square root of each lane.
template <class Real>
[[gnu::always_inline]] static inline Real square_root(const Real& r) {
  double lane[lanes<Real>];
  store(lane, r);
  for (int l = 0; l < lanes<Real>; ++l) lane[l] = __builtin_sqrt(lane[l]);
  return load<Real>(lane);
}

/// Is a lane of r above the limit, or no number?
template <class Real>
[[gnu::always_inline]] static inline bool any_above(const Real& r, double limit) {
  double lane[lanes<Real>];
  store(lane, r);
  bool above = false;
  for (int l = 0; l < lanes<Real>; ++l) above = above || !(lane[l] <= limit);
  return above;
}

}  // namespace carom
