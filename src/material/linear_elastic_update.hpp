// Batch update and tangent of isotropic linear elasticity over a number type.
#pragma once

#include "material/isotropic_elastic.hpp"
#include "material/point_batch.hpp"
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

/// Stress lambda tr(e) 1 + 2 G e and stored energy density s : e / 2; Hooke's law on small strains, St. Venant and
/// Kirchhoff's on Green-Lagrange strains. parameters: const LameParameters*.
template <class Real>
static void linear_elastic_update(const void* parameters, const PointBatch& batch) {
  const double lambda = static_cast<const LameParameters*>(parameters)->lambda;
  const double G = static_cast<const LameParameters*>(parameters)->G;
  constexpr int n = lanes<Real>;
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
template <class Real>
static constexpr LawKernels st_venant_kirchhoff_kernels() {
  return linear_elastic_kernels<Real>();
}

}  // namespace carom
