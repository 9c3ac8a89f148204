// Batch update and tangent of the compressible neo-Hookean law over a number type.
#pragma once

#include "material/isotropic_elastic.hpp"
#include "material/linear_elastic_update.hpp"
#include "material/point_batch.hpp"
#include "math/elementary.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// C^-1 = adjugate / (1 + q), det C = 1 + q, of C = 1 + 2 e with the invariants of e kept apart: nothing cancels at
/// small strains. diagonal is that of (1 + q) 1 - adjugate, 1 + q times the diagonal of 1 - C^-1.
template <class Real>
struct RightCauchyGreen {
  Real q, adjugate[6], diagonal[3];
  Real second_and_third;  ///< 4 I_2 + 8 I_3 of e
};

template <class Real>
[[gnu::always_inline]] static inline RightCauchyGreen<Real> right_cauchy_green(const Real e[6]) {
  RightCauchyGreen<Real> C;
  const Real xy = e[3] * e[3], yz = e[4] * e[4], zx = e[5] * e[5];
  const Real I_2 = e[0] * e[1] + e[1] * e[2] + e[2] * e[0] - 0.25 * (xy + yz + zx);
  const Real I_3 = e[0] * e[1] * e[2] + 0.25 * (e[3] * e[4] * e[5] - e[0] * yz - e[1] * zx - e[2] * xy);
  C.second_and_third = 4.0 * I_2 + 8.0 * I_3;
  C.q = 2.0 * (e[0] + e[1] + e[2]) + C.second_and_third;
  const Real minors[3] = {2.0 * (e[1] + e[2]) + 4.0 * e[1] * e[2] - yz, 2.0 * (e[2] + e[0]) + 4.0 * e[2] * e[0] - zx,
                          2.0 * (e[0] + e[1]) + 4.0 * e[0] * e[1] - xy};
  for (int c = 0; c < 3; ++c) {
    C.adjugate[c] = 1.0 + minors[c];
    C.diagonal[c] = C.q - minors[c];
  }
  C.adjugate[3] = e[4] * e[5] - e[3] * (1.0 + 2.0 * e[2]);
  C.adjugate[4] = e[5] * e[3] - e[4] * (1.0 + 2.0 * e[0]);
  C.adjugate[5] = e[3] * e[4] - e[5] * (1.0 + 2.0 * e[1]);
  return C;
}

/// S = G (1 - C^-1) + lambda ln J C^-1 and W = G/2 (tr C - 3) - G ln J + lambda/2 (ln J)^2 (NeoHookean), of the
/// Green-Lagrange strain; not a number where det C is not positive. rho c^2 over current lengths along n is G n.bn, and
/// lambda + G - lambda ln J more of pressure waves. parameters: const LameParameters*.
template <class Real>
static void neo_hookean_update(const void* parameters, const PointBatch& batch) {
  const double lambda = static_cast<const LameParameters*>(parameters)->lambda;
  const double G = static_cast<const LameParameters*>(parameters)->G;
  constexpr int n = lanes<Real>;
  dissipate_nothing<Real>(batch);
  for (int p = 0; p < batch.points; ++p) {
    double* stress = batch.stress + 6 * p * n;
    Real e[6], log, rest;
    for (int c = 0; c < 6; ++c) e[c] = load<Real>(batch.strain + (6 * p + c) * n);
    const auto C = right_cauchy_green(e);
    logarithm(C.q, log, rest);
    const Real ln_J = 0.5 * log, inverse = 1.0 / (1.0 + C.q), volumetric = lambda * ln_J;
    for (int c = 0; c < 3; ++c) store(stress + c * n, Real((G * C.diagonal[c] + volumetric * C.adjugate[c]) * inverse));
    for (int c = 3; c < 6; ++c) store(stress + c * n, Real((volumetric - G) * C.adjugate[c] * inverse));
    if (batch.energy != nullptr)
      store(batch.energy + p * n, Real(0.5 * G * (rest - C.second_and_third) + 0.5 * volumetric * ln_J));
    if (batch.wave_modulus != nullptr) {
      const Real pressure = (lambda + G) - volumetric, zero = Real{};
      store(batch.wave_modulus + p * n,
            Real(G + 2.0 * G * largest_principal_bound(e) + (pressure > 0.0 ? pressure : zero)));
    }
  }
}

/// dS = 2 (G - lambda ln J) C^-1 dE C^-1 + lambda (C^-1 : dE) C^-1 (Bonet and Wood, eq. 6.30).
template <class Real>
static void neo_hookean_tangent(const void* parameters, const TangentBatch& batch) {
  const double lambda = static_cast<const LameParameters*>(parameters)->lambda;
  const double G = static_cast<const LameParameters*>(parameters)->G;
  constexpr int n = lanes<Real>;
  for (int p = 0; p < batch.points; ++p) {
    Real e[6], d[6], log, rest;
    for (int c = 0; c < 6; ++c) e[c] = load<Real>(batch.strain + (6 * p + c) * n);
    for (int c = 0; c < 6; ++c) d[c] = load<Real>(batch.strain_change + (6 * p + c) * n);
    const auto C = right_cauchy_green(e);
    logarithm(C.q, log, rest);
    const Real inverse = 1.0 / (1.0 + C.q), shear = 2.0 * G - lambda * log;
    constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    constexpr int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    Real c_inverse[6], product[3][3];  // product = C^-1 dE
    for (int c = 0; c < 6; ++c) c_inverse[c] = inverse * C.adjugate[c];
    for (int c = 3; c < 6; ++c) d[c] *= 0.5;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        product[i][j] = c_inverse[voigt[i][0]] * d[voigt[0][j]] + c_inverse[voigt[i][1]] * d[voigt[1][j]] +
                        c_inverse[voigt[i][2]] * d[voigt[2][j]];
    const Real volumetric = lambda * (product[0][0] + product[1][1] + product[2][2]);
    for (int c = 0; c < 6; ++c) {
      const int i = pair[c][0], j = pair[c][1];
      const Real sandwich = product[i][0] * c_inverse[voigt[0][j]] + product[i][1] * c_inverse[voigt[1][j]] +
                            product[i][2] * c_inverse[voigt[2][j]];
      store(batch.stress_change + (6 * p + c) * n, Real(shear * sandwich + volumetric * c_inverse[c]));
    }
  }
}

template <class Real>
static constexpr LawKernels neo_hookean_kernels() {
  return {neo_hookean_update<Real>, neo_hookean_tangent<Real>};
}

}  // namespace carom
