// HEXA8 whose shape is a parallelepiped, under linear laws: the 2 x 2 x 2 rule in closed form.
#pragma once

#include "element/hexa8_kernel.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom::hexa8 {

/// On a parallelepiped the displacement gradient is a polynomial of seven terms,
///   1, xi, eta, zeta, eta zeta, zeta xi, xi eta,
/// which the two-point rule takes for orthogonal, with mean squares of 1, 1/3 and 1/9. A law that is linear may then be
/// asked once for each term instead of once for each Gauss point, and the geometry is that of one point.
inline constexpr int terms = 7;
inline constexpr double mean_square[terms] = {1.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 9.0, 1.0 / 9.0, 1.0 / 9.0};

/// True when no lane's cell is off a parallelepiped by more than 1e-12 of its edges: much less than its coordinates
/// are known to.
template <class Real>
[[gnu::always_inline]] static inline bool are_affine(const Monomials<Real> x[3]) {
  constexpr double near = 1e-12;
  Real edges{}, rest{};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      edges += x[i].linear[k] * x[i].linear[k];
      rest += x[i].bilinear[k] * x[i].bilinear[k];
    }
    rest += x[i].trilinear * x[i].trilinear;
  }
  double excess[lanes<Real>];
  store(excess, Real(rest - near * near * edges));
  bool any = false;
  for (const double e : excess) any |= e > 0.0;
  return !any;
}

/// What both ways need of the geometry.
template <class Real>
struct AffineGeometry {
  Real cofactor[3][3];  ///< as PointGeometry
  Real det, inverse;    ///< and 1 / det
};

template <class Real>
[[gnu::always_inline]] static inline AffineGeometry<Real> affine_geometry(const Monomials<Real> x[3]) {
  AffineGeometry<Real> geometry;
  Real g[3][3];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) g[k][i] = x[i].linear[k];
  Real(&c)[3][3] = geometry.cofactor;
  cross(g[1], g[2], c[0]);
  cross(g[2], g[0], c[1]);
  cross(g[0], g[1], c[2]);
  geometry.det = g[0][0] * c[0][0] + g[0][1] * c[0][1] + g[0][2] * c[0][2];
  geometry.inverse = 1.0 / geometry.det;
  return geometry;
}

/// Strains of the terms, strain[(6 term + c) lanes].
template <class Real>
[[gnu::always_inline]] static inline void interpolate_terms(const AffineGeometry<Real>& geometry,
                                                            const Monomials<Real> u[3], double* strain) {
  Real A[3][3];
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) A[k][j] = geometry.inverse * geometry.cofactor[k][j];
#pragma GCC unroll 7
  for (int term = 0; term < terms; ++term) {
    const int j = term % 3, k = (term + 1) % 3;  // the two others, of the terms xi, eta, zeta
    Real H[3][3];
    for (int i = 0; i < 3; ++i) {
      const Real *linear = u[i].linear, *bilinear = u[i].bilinear;
      for (int n = 0; n < 3; ++n)
        H[i][n] = term == 0  ? linear[0] * A[0][n] + linear[1] * A[1][n] + linear[2] * A[2][n]
                  : term < 4 ? bilinear[k] * A[j][n] + bilinear[j] * A[k][n]
                             : u[i].trilinear * A[term - 4][n];
    }
    constexpr int pair[3][2] = {{0, 1}, {1, 2}, {2, 0}};
    for (int i = 0; i < 3; ++i) {
      store(strain + (6 * term + i) * lanes<Real>, H[i][i]);
      const int a = pair[i][0], b = pair[i][1];
      store(strain + (6 * term + 3 + i) * lanes<Real>, Real(H[a][b] + H[b][a]));
    }
  }
}

/// f[component i][node a] of the stresses of the terms, as `integrate`.
template <class Real>
[[gnu::always_inline]] static inline void integrate_terms(const double* stress, const AffineGeometry<Real>& geometry,
                                                          Real f[3][8]) {
  Monomials<Real> w[3]{};
  const Real(&c)[3][3] = geometry.cofactor;
  constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
#pragma GCC unroll 7
  for (int term = 0; term < terms; ++term) {
    const double scale = 8.0 / 512.0 * mean_square[term];
    Real s[6];
    for (int v = 0; v < 6; ++v) s[v] = scale * load<Real>(stress + (6 * term + v) * lanes<Real>);
    for (int i = 0; i < 3; ++i) {
      const auto flux = [&](int k) __attribute__((always_inline)) {
        return Real(s[voigt[i][0]] * c[k][0] + s[voigt[i][1]] * c[k][1] + s[voigt[i][2]] * c[k][2]);
      };
      if (term == 0)
        for (int k = 0; k < 3; ++k) w[i].linear[k] = flux(k);
      else if (term < 4) {
        const int j = term % 3, k = (term + 1) % 3;
        w[i].bilinear[k] += flux(j);
        w[i].bilinear[j] += flux(k);
      } else {
        w[i].trilinear += flux(term - 4);
      }
    }
  }
  for (int i = 0; i < 3; ++i) nodal_values(w[i], f[i]);
}

}  // namespace carom::hexa8
