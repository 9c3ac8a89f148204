// HEXA8 over a number type: strains at the 2 x 2 x 2 Gauss points and the transposed operation, by sum factorisation.
#pragma once

#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom::hexa8 {

/// 1 / sqrt(3), the abscissa of the two-point Gauss rule.
inline constexpr double gauss_abscissa = 0.57735026918962576451;

/// What the integration needs again of the geometry. With nodal sums in place of means (J' = 8 J), cofactor is
/// 64 det(J) J^-T, [point][column k][component j], and det is 512 det(J).
template <class Real>
struct PointGeometry {
  Real cofactor[8][3][3];
  Real det[8];
};

/// Values of 8 x d/dxi_k of a trilinear field at the Gauss points; [k][m], m counts the two other directions, the lower
/// one fastest: the derivative along a direction is constant along it.
template <class Real>
struct ParentDerivatives {
  Real d[3][4];
};

/// (a + s_1 g b) + s_2 g (c + s_1 g d) for the four signs (s_1, s_2).
template <class Real>
[[gnu::always_inline]] static inline void gauss_butterfly(Real a, Real b, Real c, Real d, Real out[4]) {
  const Real a_minus = a - gauss_abscissa * b, a_plus = a + gauss_abscissa * b;
  const Real c_minus = c - gauss_abscissa * d, c_plus = c + gauss_abscissa * d;
  out[0] = a_minus - gauss_abscissa * c_minus;
  out[1] = a_plus - gauss_abscissa * c_plus;
  out[2] = a_minus + gauss_abscissa * c_minus;
  out[3] = a_plus + gauss_abscissa * c_plus;
}

/// A trilinear field without its mean: 8 x its coefficients of the monomials xi, eta, ..., or weights on these.
template <class Real>
struct Monomials {
  Real linear[3];    ///< xi, eta, zeta
  Real bilinear[3];  ///< eta zeta, zeta xi, xi eta
  Real trilinear;    ///< xi eta zeta
};

/// Of the 8 nodal values n (in node order).
template <class Real>
[[gnu::always_inline]] static inline Monomials<Real> monomials(const Real n[8]) {
  const Real s00 = n[0] + n[1], s10 = n[3] + n[2], s01 = n[4] + n[5], s11 = n[7] + n[6];  // sums along xi
  const Real d00 = n[1] - n[0], d10 = n[2] - n[3], d01 = n[5] - n[4], d11 = n[6] - n[7];  // differences along xi
  const Real ss0 = s00 + s10, ss1 = s01 + s11, sd0 = s10 - s00, sd1 = s11 - s01;          // ... then along eta
  const Real ds0 = d00 + d10, ds1 = d01 + d11, dd0 = d10 - d00, dd1 = d11 - d01;
  return {{ds0 + ds1, sd0 + sd1, ss1 - ss0}, {sd1 - sd0, ds1 - ds0, dd0 + dd1}, dd1 - dd0};  // ... then along zeta
}

/// Transpose of `monomials`: nodal values from weights.
template <class Real>
[[gnu::always_inline]] static inline void nodal_values(const Monomials<Real>& m, Real n[8]) {
  const auto& [xi, eta, zeta] = m.linear;
  const auto& [eta_zeta, zeta_xi, xi_eta] = m.bilinear;
  const Real ds0 = xi - zeta_xi, ds1 = xi + zeta_xi, dd0 = xi_eta - m.trilinear, dd1 = xi_eta + m.trilinear;
  const Real sd0 = eta - eta_zeta, sd1 = eta + eta_zeta;
  const Real s00 = -zeta - sd0, s10 = sd0 - zeta, s01 = zeta - sd1, s11 = zeta + sd1;
  const Real d00 = ds0 - dd0, d10 = ds0 + dd0, d01 = ds1 - dd1, d11 = ds1 + dd1;
  n[0] = s00 - d00, n[1] = s00 + d00;
  n[3] = s10 - d10, n[2] = s10 + d10;
  n[4] = s01 - d01, n[5] = s01 + d01;
  n[7] = s11 - d11, n[6] = s11 + d11;
}

/// To the parent derivatives.
template <class Real>
[[gnu::always_inline]] static inline void differentiate(const Monomials<Real>& m, ParentDerivatives<Real>& result) {
  const auto& [xi, eta, zeta] = m.linear;
  const auto& [eta_zeta, zeta_xi, xi_eta] = m.bilinear;
  gauss_butterfly(xi, xi_eta, zeta_xi, m.trilinear, result.d[0]);
  gauss_butterfly(eta, xi_eta, eta_zeta, m.trilinear, result.d[1]);
  gauss_butterfly(zeta, zeta_xi, eta_zeta, m.trilinear, result.d[2]);
}

/// From the 8 nodal values.
template <class Real>
[[gnu::always_inline]] static inline void differentiate(const Real n[8], ParentDerivatives<Real>& result) {
  differentiate(monomials(n), result);
}

/// Position in ParentDerivatives::d[k] of Gauss point p = i + 2 j + 4 k.
[[gnu::always_inline]] static inline constexpr int derivative_index(int direction, int p) {
  const int i = p & 1, j = (p >> 1) & 1, k = (p >> 2) & 1;
  return direction == 0 ? j + 2 * k : direction == 1 ? i + 2 * k : i + 2 * j;
}

/// c = a x b
template <class Real>
[[gnu::always_inline]] static inline void cross(const Real a[3], const Real b[3], Real c[3]) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/// Geometry at Gauss point p: cofactor columns and determinant.
template <class Real>
[[gnu::always_inline]] static inline void geometry_at_point(int p, const ParentDerivatives<Real> x[3],
                                                            PointGeometry<Real>& geometry) {
  Real g[3][3];  // g[k][i] = dX_i / dxi_k (times 8)
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) g[k][i] = x[i].d[k][derivative_index(k, p)];
  Real(&c)[3][3] = geometry.cofactor[p];
  cross(g[1], g[2], c[0]);
  cross(g[2], g[0], c[1]);
  cross(g[0], g[1], c[2]);
  geometry.det[p] = g[0][0] * c[0][0] + g[0][1] * c[0][1] + g[0][2] * c[0][2];
}

/// Strain at Gauss point p: eps = sym(grad u), shears as 2 eps_ij.
template <class Real>
[[gnu::always_inline]] static inline void strain_at_point(int p, const ParentDerivatives<Real> u[3],
                                                          const PointGeometry<Real>& geometry, Real strain[6]) {
  Real h[3][3];  // h[k][i] = du_i / dxi_k (times 8)
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) h[k][i] = u[i].d[k][derivative_index(k, p)];
  const Real(&c)[3][3] = geometry.cofactor[p];
  const Real inverse = 1.0 / geometry.det[p];
  constexpr int pair[3][2] = {{0, 1}, {1, 2}, {2, 0}};
  for (int i = 0; i < 3; ++i) {
    strain[i] = inverse * (h[0][i] * c[0][i] + h[1][i] * c[1][i] + h[2][i] * c[2][i]);
    const int a = pair[i][0], b = pair[i][1];
    strain[3 + i] = inverse * ((h[0][a] * c[0][b] + h[1][a] * c[1][b] + h[2][a] * c[2][b]) +
                               (h[0][b] * c[0][a] + h[1][b] * c[1][a] + h[2][b] * c[2][a]));
  }
}

/// Displacement gradient at Gauss point p: H[i][j] = du_i / dX_j.
template <class Real>
[[gnu::always_inline]] static inline void gradient_at_point(int p, const ParentDerivatives<Real> u[3],
                                                            const PointGeometry<Real>& geometry, Real H[3][3]) {
  const Real(&c)[3][3] = geometry.cofactor[p];
  const Real inverse = 1.0 / geometry.det[p];
  for (int i = 0; i < 3; ++i) {
    const Real h[3] = {u[i].d[0][derivative_index(0, p)], u[i].d[1][derivative_index(1, p)],
                       u[i].d[2][derivative_index(2, p)]};
    for (int j = 0; j < 3; ++j) H[i][j] = inverse * (h[0] * c[0][j] + h[1] * c[1][j] + h[2] * c[2][j]);
  }
}

/// Strains at the 8 Gauss points (xi fastest): xx, yy, zz, 2 xy, 2 yz, 2 zx, written to strain[(6 p + c) lanes].
/// x, u: monomials of each component. All determinants must be positive.
template <class Real>
[[gnu::always_inline]] static inline void interpolate(const Monomials<Real> x[3], const Monomials<Real> u[3],
                                                      PointGeometry<Real>& geometry, double* strain) {
  ParentDerivatives<Real> dx[3], du[3];
  for (int i = 0; i < 3; ++i) {
    differentiate(x[i], dx[i]);
    differentiate(u[i], du[i]);
  }
#pragma GCC unroll 8
  for (int p = 0; p < 8; ++p) {
    Real eps[6];
    geometry_at_point(p, dx, geometry);
    strain_at_point(p, du, geometry, eps);
    for (int c = 0; c < 6; ++c) store(strain + (6 * p + c) * lanes<Real>, eps[c]);
  }
}

/// Transpose of `differentiate`, times 1/512: nodal values n from weights on the parent derivatives.
template <class Real>
[[gnu::always_inline]] static inline void differentiate_transposed(const ParentDerivatives<Real>& weights, Real n[8]) {
  Real a[3], b[3], c[3], d[3];  // sums with the signs (1, 1), (s_1, 1), (1, s_2), (s_1, s_2)
  for (int k = 0; k < 3; ++k) {
    const Real* w = weights.d[k];
    const Real s0 = w[0] + w[1], s1 = w[2] + w[3], d0 = w[1] - w[0], d1 = w[3] - w[2];
    a[k] = s0 + s1;
    b[k] = d0 + d1;
    c[k] = s1 - s0;
    d[k] = d1 - d0;
  }
  constexpr double scale = 1.0 / 512.0, scale_1 = scale * gauss_abscissa, scale_2 = scale / 3.0;
  nodal_values<Real>({{scale * a[0], scale * a[1], scale * a[2]},
                      {scale_1 * (c[1] + c[2]), scale_1 * (c[0] + b[2]), scale_1 * (b[0] + b[1])},
                      scale_2 * (d[0] + d[1] + d[2])},
                     n);
}

/// f[component i][node a] = sum over Gauss points of P_ij dN_a/dX_j det(J); stress_at(p, P) gives the stress of point
/// p.
template <class Real, class StressAt>
[[gnu::always_inline]] static inline void integrate(const PointGeometry<Real>& geometry, const StressAt& stress_at,
                                                    Real f[3][8]) {
  ParentDerivatives<Real> weights[3];
#pragma GCC unroll 8
  for (int p = 0; p < 8; ++p) {
    Real P[3][3];
    stress_at(p, P);
    for (int k = 0; k < 3; ++k) {
      const Real(&c)[3] = geometry.cofactor[p][k];
      const int m = derivative_index(k, p);
      const bool first = ((p >> k) & 1) == 0;
      for (int i = 0; i < 3; ++i) {
        const Real flux = P[i][0] * c[0] + P[i][1] * c[1] + P[i][2] * c[2];
        weights[i].d[k][m] = first ? flux : weights[i].d[k][m] + flux;
      }
    }
  }
  for (int i = 0; i < 3; ++i) differentiate_transposed(weights[i], f[i]);
}

/// The same of a symmetric stress, stress[(6 p + c) lanes]: xx, yy, zz, xy, yz, zx.
template <class Real>
[[gnu::always_inline]] static inline void integrate(const double* stress, const PointGeometry<Real>& geometry,
                                                    Real f[3][8]) {
  integrate<Real>(
      geometry,
      [&](int p, Real P[3][3]) __attribute__((always_inline)) {
        constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
        Real s[6];
        for (int c = 0; c < 6; ++c) s[c] = load<Real>(stress + (6 * p + c) * lanes<Real>);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) P[i][j] = s[voigt[i][j]];
      },
      f);
}

}  // namespace carom::hexa8
