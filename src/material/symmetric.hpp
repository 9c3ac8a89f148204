// Logarithm and exponential of symmetric 3 x 3 matrices near 1 over a number type.
#pragma once

#include "material/principal.hpp"

// Internal linkage throughout: see math/pack.hpp. Symmetric matrices are their components xx, yy, zz, xy, yz, zx.
namespace carom {

inline constexpr int voigt_row[6] = {0, 1, 2, 0, 1, 2}, voigt_column[6] = {0, 1, 2, 1, 2, 0};
inline constexpr int voigt_place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

/// A B of matrices that commute, so that it is symmetric.
template <class Real>
[[gnu::always_inline]] static inline void commuting_product(const Real A[6], const Real B[6], Real result[6]) {
  Real product[6];
  for (int c = 0; c < 6; ++c) {
    const int i = voigt_row[c], j = voigt_column[c];
    product[c] = A[voigt_place[i][0]] * B[voigt_place[0][j]] + A[voigt_place[i][1]] * B[voigt_place[1][j]] +
                 A[voigt_place[i][2]] * B[voigt_place[2][j]];
  }
  for (int c = 0; c < 6; ++c) result[c] = product[c];
}

/// A : A
template <class Real>
[[gnu::always_inline]] static inline Real norm_square(const Real A[6]) {
  return A[0] * A[0] + A[1] * A[1] + A[2] * A[2] + 2.0 * (A[3] * A[3] + A[4] * A[4] + A[5] * A[5]);
}

/// N diag(value) N^T
template <class Real>
[[gnu::always_inline]] static inline void from_principal(const Real N[3][3], const Real value[3], Real result[6]) {
  for (int c = 0; c < 6; ++c) {
    const int i = voigt_row[c], j = voigt_column[c];
    result[c] = value[0] * N[i][0] * N[j][0] + value[1] * N[i][1] * N[j][1] + value[2] * N[i][2] * N[j][2];
  }
}

template <class Real>
[[gnu::always_inline]] static inline void principal(const Real A[6], Real value[3], Real N[3][3]) {
  Real full[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) full[i][j] = A[voigt_place[i][j]];
  principal(full, value, N);
}

/// By principal values, which takes longer; for lanes that the series do not reach.
template <class Real>
[[gnu::noinline]] static void logarithm_by_values(const Real B[6], Real log[6]) {
  Real value[3], N[3][3], rest;
  principal(B, value, N);
  for (Real& v : value) logarithm(Real(v), v, rest);
  from_principal(N, value, log);
}

template <class Real>
[[gnu::noinline]] static void exponential_by_values(const Real A[6], Real result[6]) {
  Real value[3], N[3][3];
  principal(A, value, N);
  for (Real& v : value) v = exponential_less_one(v);
  from_principal(N, value, result);
}

/// 1 + T (1/3 + T (1/5 + ...)) to T^terms, and 1 + A (1/2 + A (1/6 + ...)), the first `terms` terms of (exp(A) - 1) /
/// A.
template <int terms, class Real>
[[gnu::always_inline]] static inline void inverse_odd_series(const Real T[6], Real sum[6]) {
  for (int c = 0; c < 6; ++c) sum[c] = Real{} + (c < 3 ? 1.0 / (2 * terms + 1) : 0.0);
  for (int k = 2 * terms - 1; k >= 1; k -= 2) {
    commuting_product(sum, T, sum);
    for (int c = 0; c < 3; ++c) sum[c] += 1.0 / k;
  }
}

template <int terms, class Real>
[[gnu::always_inline]] static inline void exponential_series(const Real A[6], Real sum[6]) {
  for (int c = 0; c < 6; ++c) sum[c] = Real{} + (c < 3 ? 1.0 : 0.0);
  for (int k = terms; k >= 2; --k) {
    commuting_product(sum, A, sum);
    for (int c = 0; c < 6; ++c) sum[c] = sum[c] * (1.0 / k) + (c < 3 ? 1.0 : 0.0);
  }
}

/// Squares of norms up to which few terms of the series do: those of the elastic strains of metals; and all of them.
inline constexpr double near_square = 1e-4, far_square = 0.04;

/// ln(1 + B) to round-off of |B|. With Z = B (2 + B)^-1 it is 2 artanh(Z) = 2 Z (1 + Z^2 (1/3 + Z^2 (1/5 + ...))); ten
/// terms leave 1e-17 for |Z|^2 <= 0.04, four for 1e-4.
template <class Real>
[[gnu::always_inline]] static inline void matrix_logarithm(const Real B[6], Real log[6]) {
  Real M[6], inverse[6], Z[6], T[6], sum[6];
  for (int c = 0; c < 6; ++c) M[c] = c < 3 ? 2.0 + B[c] : B[c];
  inverse[0] = M[1] * M[2] - M[4] * M[4];
  inverse[1] = M[2] * M[0] - M[5] * M[5];
  inverse[2] = M[0] * M[1] - M[3] * M[3];
  inverse[3] = M[4] * M[5] - M[3] * M[2];
  inverse[4] = M[5] * M[3] - M[4] * M[0];
  inverse[5] = M[3] * M[4] - M[5] * M[1];
  const Real scale = 1.0 / (M[0] * inverse[0] + M[3] * inverse[3] + M[5] * inverse[5]);
  for (Real& component : inverse) component *= scale;
  commuting_product(B, inverse, Z);
  commuting_product(Z, Z, T);
  const Real square = norm_square(Z);
  if (any_above(square, near_square))
    inverse_odd_series<10>(T, sum);
  else
    inverse_odd_series<4>(T, sum);
  commuting_product(sum, Z, log);
  for (int c = 0; c < 6; ++c) log[c] *= 2.0;
  if (!any_above(square, far_square)) return;
  Real far[6];
  logarithm_by_values(B, far);
  for (int c = 0; c < 6; ++c) log[c] = square <= far_square ? log[c] : far[c];
}

/// exp(A) - 1 to round-off of |A|: twelve terms of its series leave 1e-17 of it for |A|^2 <= 0.04, seven for 1e-4.
template <class Real>
[[gnu::always_inline]] static inline void matrix_exponential_less_one(const Real A[6], Real result[6]) {
  const Real square = norm_square(A);
  Real sum[6];
  if (any_above(square, near_square))
    exponential_series<12>(A, sum);
  else
    exponential_series<7>(A, sum);
  commuting_product(sum, A, result);
  if (!any_above(square, far_square)) return;
  Real far[6];
  exponential_by_values(A, far);
  for (int c = 0; c < 6; ++c) result[c] = square <= far_square ? result[c] : far[c];
}

}  // namespace carom
