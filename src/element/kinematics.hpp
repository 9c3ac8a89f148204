// Strains and stresses at one point from the displacement gradient, over a number type.
#pragma once

#include <limits>

#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp. Matrices are [row][column]; Voigt order xx, yy, zz, xy, yz, zx with
// shear strains twice the tensor's.
namespace carom {

/// e = sym(A^T B) in Voigt order: the change of the Green-Lagrange strain when A = F and B = dH.
template <class Real>
[[gnu::always_inline]] static inline void symmetric_product(const Real A[3][3], const Real B[3][3], Real e[6]) {
  for (int c = 0; c < 3; ++c) e[c] = A[0][c] * B[0][c] + A[1][c] * B[1][c] + A[2][c] * B[2][c];
  constexpr int pair[3][2] = {{0, 1}, {1, 2}, {2, 0}};
  for (int c = 0; c < 3; ++c) {
    const int a = pair[c][0], b = pair[c][1];
    e[3 + c] = (A[0][a] * B[0][b] + A[1][a] * B[1][b] + A[2][a] * B[2][b]) +
               (A[0][b] * B[0][a] + A[1][b] * B[1][a] + A[2][b] * B[2][a]);
  }
}

/// e = sym(H)
template <class Real>
[[gnu::always_inline]] static inline void small_strain(const Real H[3][3], Real e[6]) {
  for (int c = 0; c < 3; ++c) e[c] = H[c][c];
  e[3] = H[0][1] + H[1][0];
  e[4] = H[1][2] + H[2][1];
  e[5] = H[2][0] + H[0][2];
}

/// e += H^T H / 2, which makes the Green-Lagrange strain E = (F^T F - 1) / 2 of the small strain.
template <class Real>
[[gnu::always_inline]] static inline void add_quadratic_strain(const Real H[3][3], Real e[6]) {
  Real square[6];
  symmetric_product(H, H, square);
  for (int c = 0; c < 6; ++c) e[c] += 0.5 * square[c];
}

/// det F
template <class Real>
[[gnu::always_inline]] static inline Real determinant(const Real F[3][3]) {
  return F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) - F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
         F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
}

/// Makes the strain not a number where J is not positive: stresses, energies and forces of an inverted cell follow.
template <class Real>
[[gnu::always_inline]] static inline void refuse_inversion(const Real& J, Real e[6]) {
  const Real nan = Real{} + std::numeric_limits<double>::quiet_NaN();
  e[0] = J > 0.0 ? e[0] : nan;
}

/// P = F S: the first Piola-Kirchhoff stress of a second one in Voigt order.
template <class Real>
[[gnu::always_inline]] static inline void first_piola(const Real F[3][3], const Real S[6], Real P[3][3]) {
  for (int i = 0; i < 3; ++i) {
    P[i][0] = F[i][0] * S[0] + F[i][1] * S[3] + F[i][2] * S[5];
    P[i][1] = F[i][0] * S[3] + F[i][1] * S[1] + F[i][2] * S[4];
    P[i][2] = F[i][0] * S[5] + F[i][1] * S[4] + F[i][2] * S[2];
  }
}

/// s = P F^T / J in Voigt order: the Cauchy stress.
template <class Real>
[[gnu::always_inline]] static inline void cauchy(const Real P[3][3], const Real F[3][3], const Real& J, Real s[6]) {
  constexpr int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  for (int c = 0; c < 6; ++c) {
    const int i = pair[c][0], j = pair[c][1];
    s[c] = (P[i][0] * F[j][0] + P[i][1] * F[j][1] + P[i][2] * F[j][2]) / J;
  }
}

}  // namespace carom
