// Eigenvalues and eigenvectors of symmetric 3 x 3 matrices over a number type.
#pragma once

#include "math/elementary.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// One rotation of Jacobi's method in the plane p, q: A <- R^T A R, N <- N R, which makes A_pq vanish. The tangent of
/// its angle, 2 A_pq / (d + sign(d) sqrt(d^2 + 4 A_pq^2)) with d = A_qq - A_pp, is at most 1 and has no cancellation
/// (Golub and Van Loan, Matrix Computations, 4th ed., section 8.5.2).
template <int p, int q, class Real>
[[gnu::always_inline]] static inline void rotate(Real A[3][3], Real N[3][3]) {
  constexpr int r = 3 - p - q;
  const Real zero = Real{}, one = Real{} + 1.0;
  const Real a = A[p][q], d = A[q][q] - A[p][p], twice = 2.0 * a;
  const Real size = d < 0.0 ? -d : d, root = square_root(Real(d * d + twice * twice));
  const Real sum = size + root, signed_twice = d < 0.0 ? -twice : twice;
  const Real t = sum > 0.0 ? signed_twice / (sum > 0.0 ? sum : one) : zero;
  const Real c = 1.0 / square_root(Real(1.0 + t * t)), s = t * c;
  A[p][p] -= t * a;
  A[q][q] += t * a;
  A[p][q] = zero;
  A[q][p] = zero;
  const Real rp = c * A[r][p] - s * A[r][q], rq = s * A[r][p] + c * A[r][q];
  A[r][p] = rp;
  A[p][r] = rp;
  A[r][q] = rq;
  A[q][r] = rq;
  for (int i = 0; i < 3; ++i) {
    const Real n = c * N[i][p] - s * N[i][q];
    N[i][q] = s * N[i][p] + c * N[i][q];
    N[i][p] = n;
  }
}

/// A = sum of value_i n_i n_i^T, N[.][i] = n_i, of the symmetric A, which is overwritten. Cyclic Jacobi: errors are
/// round-off of |A|, vectors orthonormal to round-off, equal values no special case.
template <class Real>
[[gnu::always_inline]] static inline void principal(Real A[3][3], Real value[3], Real N[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) N[i][j] = Real{} + (i == j ? 1.0 : 0.0);
  constexpr int n = lanes<Real>, most = 12;
  constexpr double negligible = 1e-36;  // of |A|^2
  for (int sweep = 0; sweep < most; ++sweep) {
    const Real off = A[0][1] * A[0][1] + A[1][2] * A[1][2] + A[0][2] * A[0][2];
    const Real square = A[0][0] * A[0][0] + A[1][1] * A[1][1] + A[2][2] * A[2][2] + off;
    double excess[n];
    store(excess, Real(off - negligible * square));
    bool is_diagonal = true;
    for (int l = 0; l < n; ++l) is_diagonal = is_diagonal && !(excess[l] > 0.0);
    if (is_diagonal) break;
    rotate<0, 1>(A, N);
    rotate<1, 2>(A, N);
    rotate<0, 2>(A, N);
  }
  for (int i = 0; i < 3; ++i) value[i] = A[i][i];
}

}  // namespace carom
