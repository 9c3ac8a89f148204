// What the kernels over batches of HEXA8 cells share: sums over batches and points.
#pragma once

#include "element/hexa8_affine.hpp"
#include "kernels/batch_values.hpp"
#include "kernels/kernels.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// Calls body(offsets of the batch, cells in it, number of its first cell) for each batch.
template <class Real, class Body>
[[gnu::always_inline]] static inline void for_each_batch(const CellBatches& batches, const Body& body) {
  constexpr int n = lanes<Real>;
  const Index* offset = batches.offset;
  for (Index first = 0; first < batches.cells; first += n, offset += 8 * n) {
    const Index left = batches.cells - first;
    body(offset, left < n ? static_cast<int>(left) : n, first);
  }
}

/// Adds 512 x the integral over the `count` cells of a batch of density[p lanes] to sum.
template <class Real>
[[gnu::always_inline]] static inline void add_integral(const double* density,
                                                       const hexa8::PointGeometry<Real>& geometry, int count,
                                                       double& sum) {
  constexpr int n = lanes<Real>;
  Real cell = load<Real>(density) * geometry.det[0];
  for (int p = 1; p < 8; ++p) cell += load<Real>(density + p * n) * geometry.det[p];
  double per_cell[n];
  store(per_cell, cell);
  for (int l = 0; l < count; ++l) sum += per_cell[l];
}

/// The same of the energy densities of the terms of parallelepipeds.
template <class Real>
[[gnu::always_inline]] static inline void add_integral_of_terms(const double* density,
                                                                const hexa8::AffineGeometry<Real>& geometry, int count,
                                                                double& sum) {
  constexpr int n = lanes<Real>;
  Real cell = load<Real>(density);
  for (int term = 1; term < hexa8::terms; ++term) cell += hexa8::mean_square[term] * load<Real>(density + term * n);
  double per_cell[n];
  store(per_cell, Real(8.0 * cell * geometry.det));
  for (int l = 0; l < count; ++l) sum += per_cell[l];
}

/// mean[6 l + c] = volume mean of value[(6 p + c) lanes + l] for the `count` cells of a batch.
template <class Real>
[[gnu::always_inline]] static inline void store_mean(const double* value, const hexa8::PointGeometry<Real>& geometry,
                                                     int count, double* mean) {
  constexpr int n = lanes<Real>;
  Real volume = geometry.det[0];
  for (int p = 1; p < 8; ++p) volume += geometry.det[p];
  for (int c = 0; c < 6; ++c) {
    Real sum = load<Real>(value + c * n) * geometry.det[0];
    for (int p = 1; p < 8; ++p) sum += load<Real>(value + (6 * p + c) * n) * geometry.det[p];
    double per_cell[n];
    store(per_cell, Real(sum / volume));
    for (int l = 0; l < count; ++l) mean[6 * l + c] = per_cell[l];
  }
}

}  // namespace carom
