// The stages of a batch that know points alone, over a number type: kinematics of small and finite strain.
#pragma once

#include "element/cell_operators.hpp"
#include "element/kinematics.hpp"
#include "kernels/stages.hpp"
#include "material/discrete_gradient.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

template <class Real>
[[gnu::always_inline]] static inline void load_voigt(const double* values, int p, Real s[6]) {
  for (int c = 0; c < 6; ++c) s[c] = load<Real>(values + (6 * p + c) * lanes<Real>);
}
template <class Real>
[[gnu::always_inline]] static inline void store_voigt(double* values, int p, const Real s[6]) {
  for (int c = 0; c < 6; ++c) store(values + (6 * p + c) * lanes<Real>, s[c]);
}
template <class Real>
[[gnu::always_inline]] static inline Real scalar(const double* values, int p) {
  return load<Real>(values + p * lanes<Real>);
}

/// A d A in Voigt order, of a stress-like A and a strain-like d (shears twice the tensor's).
template <class Real>
[[gnu::always_inline]] static inline void double_product(const Real A[6], const Real d[6], Real out[6]) {
  constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  constexpr int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  Real e[6], product[3][3];
  for (int c = 0; c < 6; ++c) e[c] = (c < 3 ? 1.0 : 0.5) * d[c];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      product[i][j] =
          A[voigt[i][0]] * e[voigt[0][j]] + A[voigt[i][1]] * e[voigt[1][j]] + A[voigt[i][2]] * e[voigt[2][j]];
  for (int c = 0; c < 6; ++c) {
    const int i = pair[c][0], j = pair[c][1];
    out[c] = product[i][0] * A[voigt[0][j]] + product[i][1] * A[voigt[1][j]] + product[i][2] * A[voigt[2][j]];
  }
}

/// F at rest.
template <class Real>
[[gnu::always_inline]] static inline void load_frame(const double* frame, Real A[3][3]) {
  if (frame != nullptr) return load_point(frame, 0, A);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) A[i][j] = Real{} + (i == j ? 1.0 : 0.0);
}

/// Volume ratio of F; of bars the square of the stretch.
template <class Real>
[[gnu::always_inline]] static inline Real jacobian(const double* frame, const Real F[3][3]) {
  if (frame == nullptr) return determinant(F);
  return F[0][0] * F[0][0] + F[1][0] * F[1][0] + F[2][0] * F[2][0];
}

/// sym(frame^T H)
template <class Real>
[[gnu::always_inline]] static inline void strain_of(const double* frame, const Real H[3][3], Real e[6]) {
  if (frame == nullptr) return small_strain(H, e);
  Real A[3][3];
  load_frame(frame, A);
  symmetric_product(A, H, e);
}

namespace small_stages {

template <class Real>
static void strain(int points, const double* frame, double* gradient, double* strain) {
  for (int p = 0; p < points; ++p) {
    Real H[3][3], e[6];
    load_point(gradient, p, H);
    strain_of(frame, H, e);
    store_voigt(strain, p, e);
  }
}

template <class Real>
static void stress(int points, const double* frame, const double*, const double* S, double* P) {
  Real A[3][3], s[6], result[3][3];
  load_frame(frame, A);
  for (int p = 0; p < points; ++p) {
    load_voigt(S, p, s);
    first_piola(A, s, result);
    store_point(P, p, result);
  }
}

template <class Real>
static void strain_change(int points, const double* frame, const double*, const double* dH, double* dE) {
  for (int p = 0; p < points; ++p) {
    Real H[3][3], e[6];
    load_point(dH, p, H);
    strain_of(frame, H, e);
    store_voigt(dE, p, e);
  }
}

template <class Real>
static void stress_change(int points, const double* frame, const double* F, const double*, const double*,
                          const double* dS, double* P) {
  stress<Real>(points, frame, F, dS, P);
}

template <class Real>
static void cauchy(int points, const double* frame, const double*, const double*, const double* S, double* sigma) {
  for (int p = 0; p < points; ++p) {
    Real s[6];
    load_voigt(S, p, s);
    if (frame != nullptr) {
      Real A[3][3], P[3][3];
      load_frame(frame, A);
      first_piola(A, s, P);
      carom::cauchy(P, A, Real(Real{} + 1.0), s);
    }
    store_voigt(sigma, p, s);
  }
}

template <class Real>
static constexpr PointStages stages() {
  return {false, strain<Real>, stress<Real>, strain_change<Real>, stress_change<Real>, cauchy<Real>};
}

}  // namespace small_stages

namespace finite_stages {

template <class Real>
static void strain(int points, const double* frame, double* gradient, double* strain) {
  for (int p = 0; p < points; ++p) {
    Real H[3][3], A[3][3], E[6];
    load_point(gradient, p, H);
    load_frame(frame, A);
    strain_of(frame, H, E);
    add_quadratic_strain(H, E);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) H[i][j] += A[i][j];
    refuse_inversion(jacobian(frame, H), E);
    store_point(gradient, p, H);
    store_voigt(strain, p, E);
  }
}

template <class Real>
static void stress(int points, const double*, const double* F, const double* S, double* P) {
  for (int p = 0; p < points; ++p) {
    Real f[3][3], s[6], result[3][3];
    load_point(F, p, f);
    load_voigt(S, p, s);
    first_piola(f, s, result);
    store_point(P, p, result);
  }
}

template <class Real>
static void strain_change(int points, const double*, const double* F, const double* dH, double* dE) {
  for (int p = 0; p < points; ++p) {
    Real f[3][3], dh[3][3], e[6];
    load_point(F, p, f);
    load_point(dH, p, dh);
    symmetric_product(f, dh, e);
    store_voigt(dE, p, e);
  }
}

template <class Real>
static void stress_change(int points, const double*, const double* F, const double* dH, const double* S,
                          const double* dS, double* P) {
  for (int p = 0; p < points; ++p) {
    Real f[3][3], dh[3][3], s[6], ds[6], by_gradient[3][3], result[3][3];
    load_point(F, p, f);
    load_point(dH, p, dh);
    load_voigt(S, p, s);
    load_voigt(dS, p, ds);
    first_piola(dh, s, by_gradient);
    first_piola(f, ds, result);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) result[i][j] += by_gradient[i][j];
    store_point(P, p, result);
  }
}

/// det(1 + 2 E)
template <class Real>
[[gnu::always_inline]] static inline Real stretch_determinant(const Real e[6]) {
  const Real C[3][3] = {{1.0 + 2.0 * e[0], e[3], e[5]}, {e[3], 1.0 + 2.0 * e[1], e[4]}, {e[5], e[4], 1.0 + 2.0 * e[2]}};
  return determinant(C);
}

template <class Real>
static void cauchy(int points, const double*, const double* F, const double* E, const double* S, double* sigma) {
  for (int p = 0; p < points; ++p) {
    Real f[3][3], e[6], s[6], P[3][3];
    load_point(F, p, f);
    load_voigt(E, p, e);
    load_voigt(S, p, s);
    first_piola(f, s, P);
    carom::cauchy(P, f, square_root(stretch_determinant(e)), s);
    store_voigt(sigma, p, s);
  }
}

template <class Real>
static constexpr PointStages stages() {
  return {true, strain<Real>, stress<Real>, strain_change<Real>, stress_change<Real>, cauchy<Real>};
}

}  // namespace finite_stages

}  // namespace carom
