// The kernels of HEXA8 under small strain: gather, interpolate, constitutive, integrate, scatter.
#pragma once

#include "solid/hexa8_batch.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom::hexa8_small {

/// Strains and stresses at the Gauss points of one batch, with the geometry they were taken on.
template <class Real>
struct BatchState {
  hexa8::PointGeometry<Real> geometry;
  alignas(sizeof(Real)) double strain[48 * lanes<Real>];
  alignas(sizeof(Real)) double stress[48 * lanes<Real>];
  alignas(sizeof(Real)) double energy[8 * lanes<Real>];
};

/// Stages 1 and 2.
template <class Real>
[[gnu::always_inline]] static inline void interpolate(const double* x, const Index* offset, const double* u,
                                                      BatchState<Real>& state) {
  Real x_cell[3][8], u_cell[3][8];
  gather(x, offset, x_cell);
  gather(u, offset, u_cell);
  hexa8::interpolate(x_cell, u_cell, state.geometry, state.strain);
}

template <class Real>
static void add_internal_force(const CellBatches& batches, const BatchLaw& law, const double* u, double* f,
                               SolidEnergies* energies) {
  double sum = 0.0;
  for_each_batch<Real>(
      batches, [&](const Index* offset, int count, Index) __attribute__((always_inline)) {
        BatchState<Real> state;
        interpolate(batches.x, offset, u, state);
        law.update(law.parameters, {8, state.strain, state.stress, energies != nullptr ? state.energy : nullptr});
        Real f_cell[3][8];
        hexa8::integrate(state.stress, state.geometry, f_cell);
        scatter_batch(f_cell, offset, count, f);
        if (energies != nullptr) add_integral(state.energy, state.geometry, count, sum);
      });
  if (energies != nullptr) energies->strain += sum / 512.0;
}

/// K does not depend on u: K x = F(x).
template <class Real>
static void add_tangent_action(const CellBatches& batches, const BatchLaw& law, const double*, const double* x,
                               double* y) {
  add_internal_force<Real>(batches, law, x, y, nullptr);
}

/// F((u_0 + u_1) / 2), which is the discrete gradient of a quadratic energy.
template <class Real>
static void add_discrete_gradient_force(const CellBatches& batches, const BatchLaw& law, const double* u_0,
                                        const double* u_1, double* f) {
  for_each_batch<Real>(
      batches, [&](const Index* offset, int count, Index) __attribute__((always_inline)) {
        BatchState<Real> state;
        Real x_cell[3][8], u_cell[3][8], end[3][8], f_cell[3][8];
        gather(batches.x, offset, x_cell);
        gather(u_0, offset, u_cell);
        gather(u_1, offset, end);
        for (int i = 0; i < 3; ++i)
          for (int a = 0; a < 8; ++a) u_cell[i][a] = 0.5 * (u_cell[i][a] + end[i][a]);
        hexa8::interpolate(x_cell, u_cell, state.geometry, state.strain);
        law.update(law.parameters, {8, state.strain, state.stress, nullptr});
        hexa8::integrate(state.stress, state.geometry, f_cell);
        scatter_batch(f_cell, offset, count, f);
      });
}

template <class Real>
static void mean_stress(const CellBatches& batches, const BatchLaw& law, const double* u, double* stress) {
  for_each_batch<Real>(batches, [&](const Index* offset, int count, Index first) {
    BatchState<Real> state;
    interpolate(batches.x, offset, u, state);
    law.update(law.parameters, {8, state.strain, state.stress});
    store_mean(state.stress, state.geometry, count, stress + 6 * first);
  });
}

template <class Real>
static constexpr CellKernels kernels() {
  return {add_internal_force<Real>, add_tangent_action<Real>, add_discrete_gradient_force<Real>, mean_stress<Real>};
}

}  // namespace carom::hexa8_small
