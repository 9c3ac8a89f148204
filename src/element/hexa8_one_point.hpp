// HEXA8 with one point, in the coefficients of its monomials.
#pragma once

#include "element/cell_operators.hpp"

// Everything is inlined into functions of internal linkage: see math/pack.hpp.
namespace carom {

/// What MeanGradientCell<Hexa8Cell> is, by sums of nodal values with the signs of the monomials 1, xi, eta, zeta, xi
/// eta, eta zeta, zeta xi, xi eta zeta, S_k = s_ka n_a. With the sums X_k of the coordinates the volume is
///   V = (det(X_1, X_2, X_3) + (det(X_1, X_4, X_6) + det(X_4, X_2, X_5) + det(X_6, X_5, X_3)) / 3) / 64,
/// a function of six of them, so that the mean gradients are dN_a/dX_j = s_ka G_kj with V G_kj = dV/dX_kj.
struct Hexa8OnePointCell {
  using Shape = Hexa8;
  static constexpr Frame frame = Frame::solid;
  static constexpr int nodes = 8, dimension = 3, points = 1;
  static constexpr int modes = Hexa8::modes, directions = 3;

  template <class Real>
  struct Geometry {
    Real weight[1];
    Real stiffness;       ///< k for coefficient x modulus = 1
    Real gradient[6][3];  ///< G
    Real mode[4][3];      ///< Gamma_b X_jb / 8
  };

  template <class Real>
  [[gnu::always_inline]] static inline void prepare(const Real x[3][8], double, Geometry<Real>& out) {
    Real X[7][3];
    sum_components(x, X);
    const Real *a = X[0], *b = X[1], *c = X[2], *ab = X[3], *bc = X[4], *ca = X[5];
    constexpr double third = 1.0 / 3.0;
    add_crosses(b, c, 1.0, ab, ca, third, out.gradient[0]);
    add_crosses(c, a, 1.0, bc, ab, third, out.gradient[1]);
    add_crosses(a, b, 1.0, ca, bc, third, out.gradient[2]);
    add_crosses(ca, a, third, b, bc, third, out.gradient[3]);
    add_crosses(ab, b, third, c, ca, third, out.gradient[4]);
    add_crosses(a, ab, third, bc, c, third, out.gradient[5]);
    Real volume[6], square[6];  // of degree 3: X_kj dV/dX_kj / 3
    for (int k = 0; k < 6; ++k) {
      const Real* D = out.gradient[k];
      volume[k] = X[k][0] * D[0] + X[k][1] * D[1] + X[k][2] * D[2];
      square[k] = D[0] * D[0] + D[1] * D[1] + D[2] * D[2];
    }
    const Real threefold = sum_of_six(volume), inverse = 1.0 / threefold;  // 192 V
    const Real scale = 3.0 * inverse;
    for (Real(&row)[3] : out.gradient)
      for (Real& entry : row) entry *= scale;
    out.weight[0] = (1.0 / 192.0) * threefold;
    out.stiffness = (2.0 / 3.0) * inverse * sum_of_six(square);  // 16/9 V x 8 |G|^2: the signs of all nodes square to 8
    for (int m = 0; m < 4; ++m)
      for (int j = 0; j < 3; ++j) out.mode[m][j] = 0.125 * X[3 + m][j];
  }

  template <class Real>
  [[gnu::always_inline]] static inline void gradients(const Geometry<Real>& geometry, const Real u[3][8],
                                                      double* gradient, double* q) {
    Real U[7][3], H[3][3] = {};
    sum_components(u, U);
    for (int k = 0; k < 6; ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) H[i][j] += U[k][i] * geometry.gradient[k][j];
    store_point(gradient, 0, H);
    for (int m = 0; m < 4; ++m)
      for (int i = 0; i < 3; ++i) {
        Real of_mode = 0.125 * U[3 + m][i];
        for (int j = 0; j < 3; ++j) of_mode -= geometry.mode[m][j] * H[i][j];
        store(q + (3 * m + i) * lanes<Real>, of_mode);
      }
  }

  template <class Real>
  [[gnu::always_inline]] static inline void integrate(const Geometry<Real>& geometry, const double* stress,
                                                      const double* Q, Real f[3][8]) {
    Real P[3][3], force[4][3];
    load_point(stress, 0, P);
    for (int m = 0; m < 4; ++m)
      for (int i = 0; i < 3; ++i) force[m][i] = load<Real>(Q + (3 * m + i) * lanes<Real>);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        P[i][j] *= geometry.weight[0];
        for (int m = 0; m < 4; ++m) P[i][j] -= force[m][i] * geometry.mode[m][j];
      }
    for (int i = 0; i < 3; ++i) {
      Real F[7];
      for (int k = 0; k < 6; ++k) {
        const Real* G = geometry.gradient[k];
        F[k] = P[i][0] * G[0] + P[i][1] * G[1] + P[i][2] * G[2];
        if (k >= 3) F[k] += 0.125 * force[k - 3][i];
      }
      F[6] = 0.125 * force[3][i];
      spread(F, f[i]);
    }
  }

 private:
  /// In pairs, which do not wait for each other.
  template <class Real>
  [[gnu::always_inline]] static inline Real sum_of_six(const Real x[6]) {
    return ((x[0] + x[1]) + (x[2] + x[3])) + (x[4] + x[5]);
  }
  /// S_k of one component, but for that of the monomial 1.
  template <class Real>
  [[gnu::always_inline]] static inline void sums(const Real n[8], Real S[7]) {
    const Real s00 = n[0] + n[1], s10 = n[3] + n[2], s01 = n[4] + n[5], s11 = n[7] + n[6];  // along xi
    const Real d00 = n[1] - n[0], d10 = n[2] - n[3], d01 = n[5] - n[4], d11 = n[6] - n[7];
    const Real ss0 = s00 + s10, ss1 = s01 + s11, sd0 = s10 - s00, sd1 = s11 - s01;  // then along eta
    const Real ds0 = d00 + d10, ds1 = d01 + d11, dd0 = d10 - d00, dd1 = d11 - d01;
    S[0] = ds0 + ds1, S[1] = sd0 + sd1, S[2] = ss1 - ss0;  // then along zeta
    S[3] = dd0 + dd1, S[4] = sd1 - sd0, S[5] = ds1 - ds0, S[6] = dd1 - dd0;
  }
  template <class Real>
  [[gnu::always_inline]] static inline void sum_components(const Real n[3][8], Real S[7][3]) {
    for (int i = 0; i < 3; ++i) {
      Real of_component[7];
      sums(n[i], of_component);
      for (int k = 0; k < 7; ++k) S[k][i] = of_component[k];
    }
  }
  /// The transposed operation, f_a = s_ka F_k.
  template <class Real>
  [[gnu::always_inline]] static inline void spread(const Real F[7], Real f[8]) {
    const Real ds0 = F[0] - F[5], ds1 = F[0] + F[5], dd0 = F[3] - F[6], dd1 = F[3] + F[6];
    const Real sd0 = F[1] - F[4], sd1 = F[1] + F[4];
    const Real s00 = -F[2] - sd0, s10 = sd0 - F[2], s01 = F[2] - sd1, s11 = F[2] + sd1;
    const Real d00 = ds0 - dd0, d10 = ds0 + dd0, d01 = ds1 - dd1, d11 = ds1 + dd1;
    f[0] = s00 - d00, f[1] = s00 + d00;
    f[3] = s10 - d10, f[2] = s10 + d10;
    f[4] = s01 - d01, f[5] = s01 + d01;
    f[7] = s11 - d11, f[6] = s11 + d11;
  }
  /// out = s a x b + t c x d
  template <class Real>
  [[gnu::always_inline]] static inline void add_crosses(const Real a[3], const Real b[3], double s, const Real c[3],
                                                        const Real d[3], double t, Real out[3]) {
    Real ab[3], cd[3];
    hexa8::cross(a, b, ab);
    hexa8::cross(c, d, cd);
    for (int j = 0; j < 3; ++j) out[j] = s * ab[j] + t * cd[j];
  }
};

}  // namespace carom
