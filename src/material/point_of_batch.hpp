// Points of a batch one by one, for kernels that ask another law.
#pragma once

#include "material/point_batch.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// A place in an array that may be null.
template <class Number>
[[gnu::always_inline]] static inline Number* at(Number* array, int offset) {
  return array == nullptr ? nullptr : array + offset;
}

/// Point p of a batch of n lanes whose points have `history` variables.
template <int n>
[[gnu::always_inline]] static inline PointBatch point_of(const PointBatch& batch, int p, int history) {
  const int H = history * n;
  return {1,
          batch.strain + 6 * p * n,
          batch.stress + 6 * p * n,
          at(batch.energy, p * n),
          batch.dt,
          at(batch.history, H * p),
          at(batch.new_history, H * p),
          at(batch.dissipation, p * n),
          at(batch.wave_modulus, p * n),
          at(batch.yield_stress, p * n),
          at(batch.mode_square, p * n),
          at(batch.share, p * n),
          batch.is_over};
}

}  // namespace carom
