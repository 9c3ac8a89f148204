// HEXA8 and QUAD4 with one point whose hourglass modes are held by the closed form of enhanced assumed strains.
#pragma once

#include "element/cell_operators.hpp"
#include "element/hexa8_one_point.hpp"
#include "element/mode_moduli.hpp"

// Everything is inlined into functions of internal linkage: see math/pack.hpp.
namespace carom {

/// What the modes of a cell store, and its derivatives. A cell has the half edges G_i = dX/dxi_i in the mean, and its
/// modes z_m = F^T q_m, q_m = gamma_ma u_a less their plastic part, are part of the covariant strains that vary over
/// it: the mode xi_i xi_k gives de_ii/dxi_k = G_i . z and the shears that go with it. All strains that are not in a
/// plane across the direction in which they vary are relaxed, as enhanced assumed strains do (Simo and Rifai, Int. J.
/// Numer. Methods Eng. 29, 1990): on parallelepipeds the stiffness is that of their nine modes, without parameters to
/// eliminate, and positive whatever the deformation. The metric is the current one, a_ij = G_i . C G_j, so that a
/// stretched cell keeps its stiffness.
template <class Number, int modes>
struct ModeForces {
  Number energy{};        ///< per reference volume
  Number T[modes][3]{};   ///< its derivatives by z
  Number metric[3][3]{};  ///< and by a_ij, symmetric
};

/// One direction of a cell that bends in itself: adds the energy (modulus / 6) (z . G_i / a_ii)^2.
template <class Number, class Real, int modes>
[[gnu::always_inline]] static inline void add_line(double modulus, const Real G[3], int i, const Number& a, int m,
                                                   const Number z[3], ModeForces<Number, modes>& out) {
  const Number inverse = 1.0 / a, strain = inverse * (G[0] * z[0] + G[1] * z[1] + G[2] * z[2]);
  const Number force = (modulus / 3.0) * (strain * inverse), twice = strain * force;
  out.energy += 0.5 * (a * twice);
  for (int k = 0; k < 3; ++k) out.T[m][k] += G[k] * force;
  out.metric[i][i] -= twice;
}

/// HEXA8. In each plane i, j the strains e that vary along the third direction make w = l (A : e)^2 + 2 G A e : e A,
/// A = a^-1, l = 2 lambda G / (lambda + 2 G), a plate of plane stress; energy w / 6. The mode xi eta zeta bends its
/// three directions, E / 3 of each.
template <class Number, class Real>
[[gnu::always_inline]] static inline void hexa8_modes(const ModeModuli& moduli, const Real G[3][3],
                                                      const Number a[3][3], const Number z[4][3],
                                                      ModeForces<Number, 4>& out) {
  constexpr int mode[3][3] = {{-1, 0, 2}, {0, -1, 1}, {2, 1, -1}};  // that of xi_i xi_j
  const double l = moduli.plate * moduli.nu, twice_G = 2.0 * moduli.G;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const int at_i = mode[i][k], at_j = mode[j][k];
    const Real *Gi = G[i], *Gj = G[j];
    const Number *zi = z[at_i], *zj = z[at_j];
    const Number e11 = Gi[0] * zi[0] + Gi[1] * zi[1] + Gi[2] * zi[2];
    const Number e22 = Gj[0] * zj[0] + Gj[1] * zj[1] + Gj[2] * zj[2];
    const Number e12 =
        0.5 * (Gi[0] * zj[0] + Gi[1] * zj[1] + Gi[2] * zj[2] + (Gj[0] * zi[0] + Gj[1] * zi[1] + Gj[2] * zi[2]));
    const Number inverse = 1.0 / (a[i][i] * a[j][j] - a[i][j] * a[i][j]);
    const Number A11 = inverse * a[j][j], A22 = inverse * a[i][i], A12 = -1.0 * (inverse * a[i][j]);
    // the mixed strains B = e A, of trace A : e
    const Number B11 = e11 * A11 + e12 * A12, B12 = e11 * A12 + e12 * A22;
    const Number B21 = e12 * A11 + e22 * A12, B22 = e12 * A12 + e22 * A22;
    const Number pressure = l * (B11 + B22);
    // n = l (A : e) A + 2 G A B, a third of it
    const Number n11 = (1.0 / 3.0) * (pressure * A11 + twice_G * (A11 * B11 + A12 * B21));
    const Number n12 = (1.0 / 3.0) * (pressure * A12 + twice_G * (A11 * B12 + A12 * B22));
    const Number n22 = (1.0 / 3.0) * (pressure * A22 + twice_G * (A12 * B12 + A22 * B22));
    const Number shear = n12 * e12;
    out.energy += 0.5 * (n11 * e11 + n22 * e22 + (shear + shear));
    for (int c = 0; c < 3; ++c) {
      out.T[at_i][c] += Gi[c] * n11 + Gj[c] * n12;
      out.T[at_j][c] += Gj[c] * n22 + Gi[c] * n12;
    }
    out.metric[i][i] -= n11 * B11 + n12 * B21;  // n B
    out.metric[j][j] -= n12 * B12 + n22 * B22;
    out.metric[i][j] -= n11 * B12 + n12 * B22;
    out.metric[j][i] = out.metric[i][j];
  }
  for (int i = 0; i < 3; ++i) add_line(moduli.E / 3.0, G[i], i, a[i][i], 3, z[3], out);
}

/// QUAD4: the mode xi eta bends its two directions.
template <class Number, class Real>
[[gnu::always_inline]] static inline void quad4_modes(const ModeModuli& moduli, const Real G[3][3],
                                                      const Number a[3][3], const Number z[1][3],
                                                      ModeForces<Number, 1>& out) {
  for (int i = 0; i < 2; ++i) add_line(moduli.plate, G[i], i, a[i][i], 0, z[0], out);
}

/// Axisymmetric QUAD4: what varies along one direction is the strain r along the other one, of the mode xi eta, and the
/// hoop strain t = z_h / a_h, of the modes 1 and 2 in the hoop's direction, whose half edge is the mean radius:
/// energy (E / (1 - nu^2)) (r^2 + t^2 + 2 nu r t) / 6. Without the hoop a plate of rings would bend too easily.
template <class Number, class Real>
[[gnu::always_inline]] static inline void quad4_ring_modes(const ModeModuli& moduli, const Real G[3][3],
                                                           const Number a[3][3], const Number z[3][3],
                                                           ModeForces<Number, 3>& out) {
  const Number by_hoop = 1.0 / a[2][2];
  for (int along = 0; along < 2; ++along) {
    const Real* g = G[1 - along];
    const Number inverse = 1.0 / a[1 - along][1 - along];
    const Number r = inverse * (g[0] * z[0][0] + g[1] * z[0][1]), t = by_hoop * (G[2][2] * z[1 + along][2]);
    const Number n_r = (moduli.plate / 3.0) * (r + moduli.nu * t), n_t = (moduli.plate / 3.0) * (t + moduli.nu * r);
    out.energy += 0.5 * (n_r * r + n_t * t);
    const Number by_r = n_r * inverse, by_t = n_t * by_hoop;
    for (int c = 0; c < 2; ++c) out.T[0][c] += g[c] * by_r;
    out.T[1 + along][2] += G[2][2] * by_t;
    out.metric[1 - along][1 - along] -= r * by_r;
    out.metric[2][2] -= t * by_t;
  }
}

/// HEXA8 (element/hexa8_one_point.hpp) with its half edges.
struct Hexa8StabilisedCell : Hexa8OnePointCell {
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
                                                   const Number z[4][3], ModeForces<Number, 4>& out) {
    hexa8_modes(moduli, G, a, z, out);
  }
};

/// QUAD4 (MeanGradientCell) with its half edges. Rings have two modes more, the hoop's, in the third direction: how far
/// the radial displacement varies along each of the cell's directions beyond what the mean hoop strain makes,
/// sum_a (xi_ia / 4 - R_i hoop_a) u_ra.
template <class OnePoint>
struct Quad4Stabilised : OnePoint {
  static constexpr bool is_ring = OnePoint::is_ring;
  static constexpr int modes = is_ring ? 3 : 1, directions = is_ring ? 3 : 2;

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
                                                   const Number z[modes][3], ModeForces<Number, modes>& out) {
    if constexpr (is_ring)
      quad4_ring_modes(moduli, G, a, z, out);
    else
      quad4_modes(moduli, G, a, z, out);
  }

 private:
  template <class Real>
  [[gnu::always_inline]] static inline Real along(int k, const Real n[4]) {
    return k == 0 ? (n[1] - n[0]) + (n[2] - n[3]) : (n[3] - n[0]) + (n[2] - n[1]);
  }
};

}  // namespace carom
