// Batch update and tangent of isotropic linear elasticity over a number type.
#pragma once

#include "material/isotropic_elastic.hpp"
#include "material/point_batch.hpp"
#include "math/elementary.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// s = lambda tr(e) 1 + 2 G e in Voigt order.
template <class Real>
[[gnu::always_inline]] static inline void hooke(double lambda, double G, const Real e[6], Real s[6]) {
  const Real pressure_part = lambda * (e[0] + e[1] + e[2]);
  for (int c = 0; c < 3; ++c) s[c] = pressure_part + (2.0 * G) * e[c];
  for (int c = 3; c < 6; ++c) s[c] = G * e[c];
}

/// At least the largest principal value of a strain in Voigt order: mean + sqrt(2/3) |deviator|, which is attained
/// where two of them coincide (Wolkowicz and Styan, Linear Algebra Appl. 29, 1980, theorem 2.1).
template <class Real>
[[gnu::always_inline]] static inline Real largest_principal_bound(const Real e[6]) {
  const Real mean = (e[0] + e[1] + e[2]) * (1.0 / 3.0);
  Real square = 0.5 * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
  for (int c = 0; c < 3; ++c) square += (e[c] - mean) * (e[c] - mean);
  return mean + square_root(Real(square * (2.0 / 3.0)));
}

/// Dissipated energy of laws without memory.
template <class Real>
[[gnu::always_inline]] static inline void dissipate_nothing(const PointBatch& batch) {
  if (batch.dissipation == nullptr) return;
  for (int i = 0; i < batch.points * lanes<Real>; ++i) batch.dissipation[i] = 0.0;
}

/// Stress lambda tr(e) 1 + 2 G e and stored energy density s : e / 2; Hooke's law on small strains, St. Venant and
/// Kirchhoff's on Green-Lagrange strains. parameters: const LameParameters*.
template <class Real>
static void linear_elastic_update(const void* parameters, const PointBatch& batch) {
  const double lambda = static_cast<const LameParameters*>(parameters)->lambda;
  const double G = static_cast<const LameParameters*>(parameters)->G;
  constexpr int n = lanes<Real>;
  dissipate_nothing<Real>(batch);
  for (int i = 0; batch.wave_modulus != nullptr && i < batch.points * n; ++i) batch.wave_modulus[i] = lambda + 2.0 * G;
  for (int p = 0; p < batch.points; ++p) {
    const double* strain = batch.strain + 6 * p * n;
    double* stress = batch.stress + 6 * p * n;
    Real e[6], s[6];
    for (int c = 0; c < 6; ++c) e[c] = load<Real>(strain + c * n);
    hooke(lambda, G, e, s);
    for (int c = 0; c < 6; ++c) store(stress + c * n, s[c]);
    if (batch.energy == nullptr) continue;
    store(batch.energy + p * n,
          Real(0.5 * (s[0] * e[0] + s[1] * e[1] + s[2] * e[2] + s[3] * e[3] + s[4] * e[4] + s[5] * e[5])));
  }
}

/// Its tangent, the same at every strain.
template <class Real>
static void linear_elastic_tangent(const void* parameters, const TangentBatch& batch) {
  const double lambda = static_cast<const LameParameters*>(parameters)->lambda;
  const double G = static_cast<const LameParameters*>(parameters)->G;
  constexpr int n = lanes<Real>;
  for (int p = 0; p < batch.points; ++p) {
    Real e[6], s[6];
    for (int c = 0; c < 6; ++c) e[c] = load<Real>(batch.strain_change + (6 * p + c) * n);
    hooke(lambda, G, e, s);
    for (int c = 0; c < 6; ++c) store(batch.stress_change + (6 * p + c) * n, s[c]);
  }
}

template <class Real>
static constexpr LawKernels linear_elastic_kernels() {
  return {linear_elastic_update<Real>, linear_elastic_tangent<Real>};
}
/// The same with rho c^2 over current lengths: (lambda + 2 G) b_i^2 + tau_i along a principal direction, b_i = 1 + 2
/// E_i, tau_i = b_i S_i.
template <class Real>
static void st_venant_kirchhoff_update(const void* parameters, const PointBatch& batch) {
  linear_elastic_update<Real>(parameters, batch);
  if (batch.wave_modulus == nullptr) return;
  const double lambda = static_cast<const LameParameters*>(parameters)->lambda;
  const double G = static_cast<const LameParameters*>(parameters)->G;
  constexpr int n = lanes<Real>;
  for (int p = 0; p < batch.points; ++p) {
    Real e[6];
    for (int c = 0; c < 6; ++c) e[c] = load<Real>(batch.strain + (6 * p + c) * n);
    const Real largest = largest_principal_bound(e), b = 1.0 + 2.0 * largest, zero = Real{};
    const Real S = lambda * (e[0] + e[1] + e[2]) + 2.0 * G * largest;
    store(batch.wave_modulus + p * n, Real((lambda + 2.0 * G) * b * b + b * (S > 0.0 ? S : zero)));
  }
}

template <class Real>
static constexpr LawKernels st_venant_kirchhoff_kernels() {
  return {st_venant_kirchhoff_update<Real>, linear_elastic_tangent<Real>};
}

}  // namespace carom
