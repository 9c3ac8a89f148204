// The five stages over batches of HEXA8 cells: gather, interpolate, constitutive, integrate, scatter.
#pragma once

#include "element/hexa8_kernel.hpp"
#include "material/linear_elastic_update.hpp"
#include "solid/kernels.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// One lane per cell: the values at offset[0], offset[1], ...
template <class Real>
[[gnu::always_inline]] static inline Real gather_lanes(const double* values, const Index* offset) {
  if constexpr (lanes<Real> == 1) {
    return values[offset[0]];
  } else if constexpr (lanes<Real> == 2) {
    return Real{values[offset[0]], values[offset[1]]};
  } else if constexpr (lanes<Real> == 4) {
    return Real{values[offset[0]], values[offset[1]], values[offset[2]], values[offset[3]]};
  } else {
    return Real{values[offset[0]], values[offset[1]], values[offset[2]], values[offset[3]],
                values[offset[4]], values[offset[5]], values[offset[6]], values[offset[7]]};
  }
}

/// Stage 1: nodal values [component][node] of the cells of one batch from an interleaved vector.
template <class Real>
[[gnu::always_inline]] static inline void gather(const double* values, const Index* offset, Real out[3][8]) {
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) out[i][a] = gather_lanes<Real>(values + i, offset + a * lanes<Real>);
}

/// Stage 5: adds nodal values of the first `count` lanes to an interleaved vector. Cells of a batch may share nodes,
/// so lanes go one after the other.
template <class Real>
[[gnu::always_inline]] static inline void scatter(const Real in[3][8], const Index* offset, int count, double* values) {
  constexpr int n = lanes<Real>;
  for (int a = 0; a < 8; ++a) {
    double buffer[3 * n];
    for (int i = 0; i < 3; ++i) store(buffer + i * n, in[i][a]);
    for (int l = 0; l < count; ++l)
      for (int i = 0; i < 3; ++i) values[offset[a * n + l] + i] += buffer[i * n + l];
  }
}

/// Strains and stresses at the Gauss points of one batch, with the geometry they were taken on.
template <class Real>
struct BatchState {
  hexa8::PointGeometry<Real> geometry;
  alignas(sizeof(Real)) double strain[48 * lanes<Real>];
  alignas(sizeof(Real)) double stress[48 * lanes<Real>];
  alignas(sizeof(Real)) double energy[8 * lanes<Real>];
};

/// Stages 1 to 3. energy: where the stored energy density goes, or null.
template <class Real>
[[gnu::always_inline]] static inline void evaluate(const double* x, const Index* offset, const BatchLaw& law,
                                                   const double* u, BatchState<Real>& state, double* energy) {
  Real x_cell[3][8], u_cell[3][8];
  gather(x, offset, x_cell);
  gather(u, offset, u_cell);
  hexa8::interpolate(x_cell, u_cell, state.geometry, state.strain);
  law.update(law.parameters, {8, state.strain, state.stress, energy});
}

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

template <class Real>
static void add_internal_force(const CellBatches& batches, const BatchLaw& law, const double* u, double* f) {
  for_each_batch<Real>(
      batches, [&](const Index* offset, int count, Index) __attribute__((always_inline)) {
        BatchState<Real> state;
        evaluate(batches.x, offset, law, u, state, nullptr);
        Real f_cell[3][8];
        hexa8::integrate(state.stress, state.geometry, f_cell);
        scatter(f_cell, offset, count, f);
      });
}

template <class Real>
static double strain_energy(const CellBatches& batches, const BatchLaw& law, const double* u) {
  double sum = 0.0;
  for_each_batch<Real>(batches, [&](const Index* offset, int count, Index) {
    constexpr int n = lanes<Real>;
    BatchState<Real> state;
    evaluate(batches.x, offset, law, u, state, state.energy);
    Real cell = load<Real>(state.energy) * state.geometry.det[0];
    for (int p = 1; p < 8; ++p) cell += load<Real>(state.energy + p * n) * state.geometry.det[p];
    double per_cell[n];
    store(per_cell, cell);
    for (int l = 0; l < count; ++l) sum += per_cell[l];
  });
  return sum / 512.0;
}

template <class Real>
static void mean_stress(const CellBatches& batches, const BatchLaw& law, const double* u, double* stress) {
  for_each_batch<Real>(batches, [&](const Index* offset, int count, Index first) {
    constexpr int n = lanes<Real>;
    BatchState<Real> state;
    evaluate(batches.x, offset, law, u, state, nullptr);
    Real volume = state.geometry.det[0];
    for (int p = 1; p < 8; ++p) volume += state.geometry.det[p];
    for (int c = 0; c < 6; ++c) {
      Real sum = load<Real>(state.stress + c * n) * state.geometry.det[0];
      for (int p = 1; p < 8; ++p) sum += load<Real>(state.stress + (6 * p + c) * n) * state.geometry.det[p];
      double per_cell[n];
      store(per_cell, Real(sum / volume));
      for (int l = 0; l < count; ++l) stress[6 * (first + l) + c] = per_cell[l];
    }
  });
}

/// The kernels over Real.
template <class Real>
static constexpr KernelTable make_kernels() {
  return {lanes<Real>, add_internal_force<Real>, strain_energy<Real>, mean_stress<Real>, linear_elastic_update<Real>};
}

}  // namespace carom
