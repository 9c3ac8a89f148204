// The kernels of HEXA8 under small strain: gather, interpolate, constitutive, integrate, scatter.
#pragma once

#include "kernels/hexa8_batch.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom::hexa8_small {

/// Strains and stresses at the Gauss points of one batch, with the geometry they were taken on; of parallelepipeds
/// those of the terms.
template <class Real>
struct BatchState {
  hexa8::PointGeometry<Real> geometry;
  alignas(sizeof(Real)) double strain[48 * lanes<Real>];
  alignas(sizeof(Real)) double stress[48 * lanes<Real>];
  alignas(sizeof(Real)) double energy[8 * lanes<Real>];
};

/// f_cell = F(u_cell); adds 512 x the energy of the `count` cells to sum if it is wanted. The laws are linear.
template <class Real>
[[gnu::always_inline]] static inline void internal_force(const Real x_cell[3][8], const Real u_cell[3][8],
                                                         const BatchLaw& law, bool wants_energy, int count,
                                                         Real f_cell[3][8], double& sum) {
  BatchState<Real> state;
  hexa8::Monomials<Real> x[3], u[3];
  for (int i = 0; i < 3; ++i) {
    x[i] = hexa8::monomials(x_cell[i]);
    u[i] = hexa8::monomials(u_cell[i]);
  }
  double* energy = wants_energy ? state.energy : nullptr;
  if (hexa8::are_affine(x)) {
    const hexa8::AffineGeometry<Real> geometry = hexa8::affine_geometry(x);
    hexa8::interpolate_terms(geometry, u, state.strain);
    law.update(law.parameters, {hexa8::terms, state.strain, state.stress, energy});
    hexa8::integrate_terms(state.stress, geometry, f_cell);
    if (wants_energy) add_integral_of_terms(state.energy, geometry, count, sum);
    return;
  }
  hexa8::interpolate(x, u, state.geometry, state.strain);
  law.update(law.parameters, {8, state.strain, state.stress, energy});
  hexa8::integrate(state.stress, state.geometry, f_cell);
  if (wants_energy) add_integral(state.energy, state.geometry, count, sum);
}

template <class Real>
static void add_internal_force(const CellBatches& batches, const BatchLaw& law, const double* u, double* f,
                               SolidEnergies* energies) {
  double sum = 0.0;
  for_each_batch<Real>(
      batches, [&](const Index* offset, int count, Index) __attribute__((always_inline)) {
        Real x_cell[3][8], u_cell[3][8], f_cell[3][8];
        gather(batches.x, offset, x_cell);
        gather(u, offset, u_cell);
        internal_force(x_cell, u_cell, law, energies != nullptr, count, f_cell, sum);
        scatter_batch(f_cell, offset, count, f);
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
        Real x_cell[3][8], u_cell[3][8], end[3][8], f_cell[3][8];
        double sum = 0.0;
        gather(batches.x, offset, x_cell);
        gather(u_0, offset, u_cell);
        gather(u_1, offset, end);
        for (int i = 0; i < 3; ++i)
          for (int a = 0; a < 8; ++a) u_cell[i][a] = 0.5 * (u_cell[i][a] + end[i][a]);
        internal_force(x_cell, u_cell, law, false, count, f_cell, sum);
        scatter_batch(f_cell, offset, count, f);
      });
}

template <class Real>
static void mean_stress(const CellBatches& batches, const BatchLaw& law, const double* u, double* stress) {
  for_each_batch<Real>(batches, [&](const Index* offset, int count, Index first) {
    BatchState<Real> state;
    Real x_cell[3][8], u_cell[3][8];
    gather(batches.x, offset, x_cell);
    gather(u, offset, u_cell);
    hexa8::Monomials<Real> x_monomials[3], u_monomials[3];
    for (int i = 0; i < 3; ++i) {
      x_monomials[i] = hexa8::monomials(x_cell[i]);
      u_monomials[i] = hexa8::monomials(u_cell[i]);
    }
    hexa8::interpolate(x_monomials, u_monomials, state.geometry, state.strain);
    law.update(law.parameters, {8, state.strain, state.stress});
    store_mean(state.stress, state.geometry, count, stress + 6 * first);
  });
}

template <class Real>
static constexpr CellKernels kernels() {
  return {add_internal_force<Real>, add_tangent_action<Real>, nullptr, add_discrete_gradient_force<Real>,
          mean_stress<Real>};
}

}  // namespace carom::hexa8_small
