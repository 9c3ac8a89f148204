// HEXA8 and QUAD4 with one point whose hourglass modes are held by the closed form of enhanced assumed strains.
#pragma once

#include "element/cell_operators.hpp"
#include "element/hexa8_one_point.hpp"
#include "element/mode_moduli.hpp"

// Everything is inlined into functions of internal linkage: see math/pack.hpp.
namespace carom {

/// What the modes of a cell store, and its derivatives. A cell has the half edges G_i = dX/dxi_i in the mean, and its
/// modes z_m = F^T q_m, q_m = gamma_ma u_a, are part of the covariant strains that vary over it: the mode xi_i xi_k
/// gives de_ii/dxi_k = G_i . z and the shears that go with it. All strains that are not in a plane across the direction
/// in which they vary are relaxed, as enhanced assumed strains do (Simo and Rifai, Int. J. Numer. Methods Eng. 29,
/// 1990): on parallelepipeds the stiffness is that of their nine modes, without parameters to eliminate, and positive
/// whatever the deformation. The metric is the current one, a_ij = G_i . C G_j, so that a stretched cell keeps its
/// stiffness.
///
/// The elastic part of a mode strain is e - sym(a p) with the plastic mixed strains p that the cell remembers; they
/// flow along the elastic mixed strains a^-1 e, and so the derivatives by a are the same before and after a flow that
/// leaves the forces T alone.
template <class Number, int modes, int strains>
struct ModeForces {
  Number energy{};            ///< per reference volume
  Number T[modes][3]{};       ///< its derivatives by z
  Number metric[3][3]{};      ///< and by a_ij, symmetric
  Number elastic[strains]{};  ///< mixed strains
};

/// One direction of a cell that bends in itself: adds the energy (modulus / 6) r^2, r = z . G_i / a_ii - p.
template <class Number, class Real, int modes, int strains>
[[gnu::always_inline]] static inline void add_line(double modulus, const Real G[3], int i, const Number& a, int m,
                                                   const Number z[3], const Real& p, int at,
                                                   ModeForces<Number, modes, strains>& out) {
  const Number inverse = 1.0 / a, total = inverse * (G[0] * z[0] + G[1] * z[1] + G[2] * z[2]);
  const Number strain = total - p, force = (modulus / 3.0) * strain, by_metric = inverse * force;
  out.energy += 0.5 * (force * strain);
  for (int k = 0; k < 3; ++k) out.T[m][k] += G[k] * by_metric;
  out.metric[i][i] -= by_metric * total;
  out.elastic[at] = strain;
}

/// HEXA8. In each plane i, j the strains e that vary along the third direction make w = l (A : e)^2 + 2 G A e : e A,
/// A = a^-1, l = 2 lambda G / (lambda + 2 G), a plate of plane stress; energy w / 6. The mode xi eta zeta bends its
/// three directions, E / 3 of each. Strains: four of each plane, then those of the lines.
template <class Number, class Real>
[[gnu::always_inline]] static inline void hexa8_modes(const ModeModuli& moduli, const Real G[3][3],
                                                      const Number a[3][3], const Number z[4][3], const Real p[15],
                                                      ModeForces<Number, 4, 15>& out) {
  constexpr int mode[3][3] = {{-1, 0, 2}, {0, -1, 1}, {2, 1, -1}};  // that of xi_i xi_j
  const double l = moduli.plate * moduli.nu, twice_G = 2.0 * moduli.G;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const int at_i = mode[i][k], at_j = mode[j][k];
    const Real *Gi = G[i], *Gj = G[j], *P = p + 4 * k;
    const Number *zi = z[at_i], *zj = z[at_j];
    const Number &a11 = a[i][i], &a12 = a[i][j], &a22 = a[j][j];
    const Number e11 = Gi[0] * zi[0] + Gi[1] * zi[1] + Gi[2] * zi[2] - (P[0] * a11 + P[2] * a12);
    const Number e22 = Gj[0] * zj[0] + Gj[1] * zj[1] + Gj[2] * zj[2] - (P[1] * a12 + P[3] * a22);
    const Number e12 =
        0.5 * (Gi[0] * zj[0] + Gi[1] * zj[1] + Gi[2] * zj[2] + (Gj[0] * zi[0] + Gj[1] * zi[1] + Gj[2] * zi[2]) -
               (P[1] * a11 + (P[3] + P[0]) * a12 + P[2] * a22));
    const Number inverse = 1.0 / (a11 * a22 - a12 * a12);
    const Number A11 = inverse * a22, A22 = inverse * a11, A12 = -1.0 * (inverse * a12);
    // the elastic mixed strains B = A e, of trace A : e
    const Number B11 = A11 * e11 + A12 * e12, B12 = A11 * e12 + A12 * e22;
    const Number B21 = A12 * e11 + A22 * e12, B22 = A12 * e12 + A22 * e22;
    const Number pressure = l * (B11 + B22);
    // n = l (A : e) A + 2 G B A, a third of it
    const Number n11 = (1.0 / 3.0) * (pressure * A11 + twice_G * (B11 * A11 + B12 * A12));
    const Number n12 = (1.0 / 3.0) * (pressure * A12 + twice_G * (B11 * A12 + B12 * A22));
    const Number n22 = (1.0 / 3.0) * (pressure * A22 + twice_G * (B21 * A12 + B22 * A22));
    const Number shear = n12 * e12;
    out.energy += 0.5 * (n11 * e11 + n22 * e22 + (shear + shear));
    for (int c = 0; c < 3; ++c) {
      out.T[at_i][c] += Gi[c] * n11 + Gj[c] * n12;
      out.T[at_j][c] += Gj[c] * n22 + Gi[c] * n12;
    }
    // -sym((B + p) n)
    const Number M11 = B11 + P[0], M12 = B12 + P[1], M21 = B21 + P[2], M22 = B22 + P[3];
    out.metric[i][i] -= M11 * n11 + M12 * n12;
    out.metric[j][j] -= M21 * n12 + M22 * n22;
    out.metric[i][j] -= 0.5 * (M11 * n12 + M12 * n22 + (M21 * n11 + M22 * n12));
    out.metric[j][i] = out.metric[i][j];
    out.elastic[4 * k] = B11, out.elastic[4 * k + 1] = B12, out.elastic[4 * k + 2] = B21, out.elastic[4 * k + 3] = B22;
  }
  for (int i = 0; i < 3; ++i) add_line(moduli.E / 3.0, G[i], i, a[i][i], 3, z[3], p[12 + i], 12 + i, out);
}

/// QUAD4: the mode xi eta bends its two directions.
template <class Number, class Real>
[[gnu::always_inline]] static inline void quad4_modes(const ModeModuli& moduli, const Real G[3][3],
                                                      const Number a[3][3], const Number z[1][3], const Real p[2],
                                                      ModeForces<Number, 1, 2>& out) {
  for (int i = 0; i < 2; ++i) add_line(moduli.plate, G[i], i, a[i][i], 0, z[0], p[i], i, out);
}

/// Axisymmetric QUAD4: what varies along one direction is the strain r along the other one, of the mode xi eta, and the
/// hoop strain t = z_h / a_h, of the modes 1 and 2 in the hoop's direction, whose half edge is the mean radius:
/// energy (E / (1 - nu^2)) (r^2 + t^2 + 2 nu r t) / 6. Without the hoop a plate of rings would bend too easily.
/// Strains: r and t of both directions.
template <class Number, class Real>
[[gnu::always_inline]] static inline void quad4_ring_modes(const ModeModuli& moduli, const Real G[3][3],
                                                           const Number a[3][3], const Number z[3][3], const Real p[4],
                                                           ModeForces<Number, 3, 4>& out) {
  const Number by_hoop = 1.0 / a[2][2];
  for (int along = 0; along < 2; ++along) {
    const int across = 1 - along;
    const Real* g = G[across];
    const Number inverse = 1.0 / a[across][across];
    const Number all_r = inverse * (g[0] * z[0][0] + g[1] * z[0][1]), all_t = by_hoop * (G[2][2] * z[1 + along][2]);
    const Number r = all_r - p[2 * along], t = all_t - p[2 * along + 1];
    const Number n_r = (moduli.plate / 3.0) * (r + moduli.nu * t), n_t = (moduli.plate / 3.0) * (t + moduli.nu * r);
    out.energy += 0.5 * (n_r * r + n_t * t);
    const Number by_r = n_r * inverse, by_t = n_t * by_hoop;
    for (int c = 0; c < 2; ++c) out.T[0][c] += g[c] * by_r;
    out.T[1 + along][2] += G[2][2] * by_t;
    out.metric[across][across] -= all_r * by_r;
    out.metric[2][2] -= all_t * by_t;
    out.elastic[2 * along] = r, out.elastic[2 * along + 1] = t;
  }
}

/// HEXA8 (element/hexa8_one_point.hpp) with its half edges.
struct Hexa8StabilisedCell : Hexa8OnePointCell {
  static constexpr int strains = 15;  ///< of its modes

  template <class Real>
  struct Geometry : Hexa8OnePointCell::Geometry<Real> {
    Real half_edge[3][3];
  };

  template <class Real>
  [[gnu::always_inline]] static inline void prepare(const Real x[3][8], double thickness, Geometry<Real>& out) {
    Hexa8OnePointCell::prepare(x, thickness, out);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        Real sum{};
        for (int a = 0; a < 8; ++a) sum += Hexa8::position[a][k] * x[i][a];
        out.half_edge[k][i] = 0.125 * sum;
      }
  }
  template <class Number, class Real>
  [[gnu::always_inline]] static inline void forces(const ModeModuli& moduli, const Real G[3][3], const Number a[3][3],
                                                   const Number z[4][3], const Real p[15],
                                                   ModeForces<Number, 4, 15>& out) {
    hexa8_modes(moduli, G, a, z, p, out);
  }
};

/// QUAD4 (MeanGradientCell) with its half edges. Rings have two modes more, the hoop's, in the third direction: how far
/// the radial displacement varies along each of the cell's directions beyond what the mean hoop strain makes,
/// sum_a (xi_ia / 4 - R_i hoop_a) u_ra.
template <class OnePoint>
struct Quad4Stabilised : OnePoint {
  static constexpr bool is_ring = OnePoint::is_ring;
  static constexpr int modes = is_ring ? 3 : 1, directions = is_ring ? 3 : 2, strains = is_ring ? 4 : 2;

  template <class Real>
  struct Geometry : OnePoint::template Geometry<Real> {
    Real half_edge[3][3];
    Real radial[2][is_ring ? 4 : 1];
  };

  template <class Real>
  [[gnu::always_inline]] static inline void prepare(const Real x[3][4], double thickness, Geometry<Real>& out) {
    OnePoint::prepare(x, thickness, out);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) out.half_edge[k][i] = Real{} + (k == 2 && i == 2 ? 1.0 : 0.0);
    for (int k = 0; k < 2; ++k)
      for (int i = 0; i < 2; ++i) out.half_edge[k][i] = 0.25 * along(k, x[i]);
    if constexpr (is_ring) {
      out.half_edge[2][2] = 0.25 * ((x[0][0] + x[0][1]) + (x[0][2] + x[0][3]));
      for (int k = 0; k < 2; ++k)
        for (int a = 0; a < 4; ++a) out.radial[k][a] = 0.25 * Quad4::position[a][k] - out.half_edge[k][0] * out.hoop[a];
    }
  }

  template <class Real>
  [[gnu::always_inline]] static inline void gradients(const Geometry<Real>& geometry, const Real u[3][4],
                                                      double* gradient, double* q) {
    OnePoint::gradients(geometry, u, gradient, q);
    if constexpr (is_ring) {
      store(q + 2 * lanes<Real>, Real{});
      for (int k = 0; k < 2; ++k) {
        Real sum{};
        for (int a = 0; a < 4; ++a) sum += geometry.radial[k][a] * u[0][a];
        for (int i = 0; i < 3; ++i) store(q + (3 * (k + 1) + i) * lanes<Real>, i == 2 ? sum : Real{});
      }
    }
  }
  template <class Real>
  [[gnu::always_inline]] static inline void integrate(const Geometry<Real>& geometry, const double* stress,
                                                      const double* Q, Real f[3][4]) {
    OnePoint::integrate(geometry, stress, Q, f);
    if constexpr (is_ring)
      for (int k = 0; k < 2; ++k) {
        const Real force = load<Real>(Q + (3 * (k + 1) + 2) * lanes<Real>);
        for (int a = 0; a < 4; ++a) f[0][a] += force * geometry.radial[k][a];
      }
  }
  template <class Number, class Real>
  [[gnu::always_inline]] static inline void forces(const ModeModuli& moduli, const Real G[3][3], const Number a[3][3],
                                                   const Number z[modes][3], const Real p[strains],
                                                   ModeForces<Number, modes, strains>& out) {
    if constexpr (is_ring)
      quad4_ring_modes(moduli, G, a, z, p, out);
    else
      quad4_modes(moduli, G, a, z, p, out);
  }

 private:
  template <class Real>
  [[gnu::always_inline]] static inline Real along(int k, const Real n[4]) {
    return k == 0 ? (n[1] - n[0]) + (n[2] - n[3]) : (n[3] - n[0]) + (n[2] - n[1]);
  }
};

}  // namespace carom
