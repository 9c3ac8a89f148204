// The kernels of HEXA8 under finite strain, total Lagrangian: P = F S(E) integrated with the reference gradients
// (Belytschko, Liu, Moran and Elkhodary, Nonlinear Finite Elements, 2nd ed., section 4.9).
#pragma once

#include "element/kinematics.hpp"
#include "kernels/hexa8_batch.hpp"
#include "material/discrete_gradient.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom::hexa8_finite {

/// What stands at the Gauss points of a batch, structure of arrays: component c of point p at [(count p + c) lanes].
template <class Real, int components>
struct PointValues {
  alignas(sizeof(Real)) double value[8 * components * lanes<Real>];

  double* data() { return value; }
};

template <class Real>
[[gnu::always_inline]] static inline void load_matrix(const PointValues<Real, 9>& values, int p, Real M[3][3]) {
  for (int c = 0; c < 9; ++c) M[c / 3][c % 3] = load<Real>(values.value + (9 * p + c) * lanes<Real>);
}
template <class Real>
[[gnu::always_inline]] static inline void store_matrix(const Real M[3][3], int p, PointValues<Real, 9>& values) {
  for (int c = 0; c < 9; ++c) store(values.value + (9 * p + c) * lanes<Real>, M[c / 3][c % 3]);
}
template <class Real>
[[gnu::always_inline]] static inline void load_voigt(const PointValues<Real, 6>& values, int p, Real s[6]) {
  for (int c = 0; c < 6; ++c) s[c] = load<Real>(values.value + (6 * p + c) * lanes<Real>);
}
template <class Real>
[[gnu::always_inline]] static inline void store_voigt(const Real s[6], int p, PointValues<Real, 6>& values) {
  for (int c = 0; c < 6; ++c) store(values.value + (6 * p + c) * lanes<Real>, s[c]);
}

/// Geometry of the cells of a batch.
template <class Real>
[[gnu::always_inline]] static inline void gather_geometry(const double* x, const Index* offset,
                                                          hexa8::PointGeometry<Real>& geometry) {
  Real x_cell[3][8];
  hexa8::ParentDerivatives<Real> dx[3];
  gather(x, offset, x_cell);
  for (int i = 0; i < 3; ++i) hexa8::differentiate(x_cell[i], dx[i]);
#pragma GCC unroll 8
  for (int p = 0; p < 8; ++p) hexa8::geometry_at_point(p, dx, geometry);
}

/// Calls body(p, H) with the gradient of the field u at each Gauss point.
template <class Real, class Body>
[[gnu::always_inline]] static inline void for_each_gradient(const double* u, const Index* offset,
                                                            const hexa8::PointGeometry<Real>& geometry,
                                                            const Body& body) {
  Real u_cell[3][8];
  hexa8::ParentDerivatives<Real> du[3];
  gather(u, offset, u_cell);
  for (int i = 0; i < 3; ++i) hexa8::differentiate(u_cell[i], du[i]);
#pragma GCC unroll 8
  for (int p = 0; p < 8; ++p) {
    Real H[3][3];
    hexa8::gradient_at_point(p, du, geometry, H);
    body(p, H);
  }
}

/// Green-Lagrange strain of F = 1 + H, which H becomes; not a number where det F is not positive.
template <class Real>
[[gnu::always_inline]] static inline void strain_and_gradient(Real H[3][3], Real E[6]) {
  small_strain(H, E);
  add_quadratic_strain(H, E);
  for (int i = 0; i < 3; ++i) H[i][i] += 1.0;
  refuse_inversion(determinant(H), E);
}

/// Deformation gradients, strains and stresses of a batch, with the geometry they were taken on.
template <class Real>
struct BatchState {
  hexa8::PointGeometry<Real> geometry;
  PointValues<Real, 9> F;
  PointValues<Real, 6> strain, stress;
  PointValues<Real, 1> energy;
};

/// Geometry, F, strain, stress, and the stored energy density if it is wanted.
template <class Real>
[[gnu::always_inline]] static inline void evaluate(const double* x, const Index* offset, const BatchLaw& law,
                                                   const double* u, BatchState<Real>& state, bool with_energy) {
  gather_geometry(x, offset, state.geometry);
  for_each_gradient(
      u, offset, state.geometry, [&](int p, Real H[3][3]) __attribute__((always_inline)) {
        Real E[6];
        strain_and_gradient(H, E);
        store_matrix(H, p, state.F);
        store_voigt(E, p, state.strain);
      });
  law.update(law.parameters,
             {8, state.strain.data(), state.stress.data(), with_energy ? state.energy.data() : nullptr});
}

/// Integrates P = F S and adds it to the nodes.
template <class Real>
[[gnu::always_inline]] static inline void add_force(const BatchState<Real>& state, const Index* offset, int count,
                                                    double* f) {
  Real f_cell[3][8];
  hexa8::integrate(
      state.geometry,
      [&](int p, Real P[3][3]) __attribute__((always_inline)) {
        Real F[3][3], S[6];
        load_matrix(state.F, p, F);
        load_voigt(state.stress, p, S);
        first_piola(F, S, P);
      },
      f_cell);
  scatter_batch(f_cell, offset, count, f);
}

template <class Real>
static void add_internal_force(const CellBatches& batches, const BatchLaw& law, const double* u, double* f,
                               SolidEnergies* energies) {
  double sum = 0.0;
  for_each_batch<Real>(
      batches, [&](const Index* offset, int count, Index) __attribute__((always_inline)) {
        BatchState<Real> state;
        evaluate(batches.x, offset, law, u, state, energies != nullptr);
        add_force(state, offset, count, f);
        if (energies != nullptr) add_integral(state.energy.data(), state.geometry, count, sum);
      });
  if (energies != nullptr) energies->strain += sum / 512.0;
}

/// dP = dH S + F dS, dS = D : sym(F^T dH).
template <class Real>
static void add_tangent_action(const CellBatches& batches, const BatchLaw& law, const double* u, const double* x,
                               double* y) {
  for_each_batch<Real>(
      batches, [&](const Index* offset, int count, Index) __attribute__((always_inline)) {
        BatchState<Real> state;
        PointValues<Real, 9> gradient;
        PointValues<Real, 6> strain_change, stress_change;
        evaluate(batches.x, offset, law, u, state, false);
        for_each_gradient(
            x, offset, state.geometry, [&](int p, Real dH[3][3]) __attribute__((always_inline)) {
              Real F[3][3], dE[6];
              load_matrix(state.F, p, F);
              symmetric_product(F, dH, dE);
              store_matrix(dH, p, gradient);
              store_voigt(dE, p, strain_change);
            });
        law.tangent(law.parameters, {8, state.strain.data(), strain_change.data(), stress_change.data()});
        Real y_cell[3][8];
        hexa8::integrate(
            state.geometry,
            [&](int p, Real P[3][3]) __attribute__((always_inline)) {
              Real F[3][3], dH[3][3], S[6], dS[6], by_gradient[3][3];
              load_matrix(state.F, p, F);
              load_matrix(gradient, p, dH);
              load_voigt(state.stress, p, S);
              load_voigt(stress_change, p, dS);
              first_piola(dH, S, by_gradient);
              first_piola(F, dS, P);
              for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) P[i][j] += by_gradient[i][j];
            },
            y_cell);
        scatter_batch(y_cell, offset, count, y);
      });
}

/// 8 dN_a/dxi_k at Gauss point p.
static constexpr double parent_derivative(int p, int a, int k) {
  const int way[3] = {((a + 1) >> 1) & 1, (a >> 1) & 1, a >> 2};  // of node a along xi, eta, zeta: 0 or 1
  double value = way[k] != 0 ? 1.0 : -1.0;
  for (int m = 0; m < 3; ++m)
    if (m != k) value *= 1.0 + (way[m] == ((p >> m) & 1) ? 1.0 : -1.0) * hexa8::gauss_abscissa;
  return value;
}

struct ParentTable {
  double value[8][8][3];  ///< [point][node][direction]
};
static constexpr ParentTable make_parent_table() {
  ParentTable table{};
  for (int p = 0; p < 8; ++p)
    for (int a = 0; a < 8; ++a)
      for (int k = 0; k < 3; ++k) table.value[p][a][k] = parent_derivative(p, a, k);
  return table;
}

/// K_ab = sum over points of w (B_a^T D B_b + (g_a . S g_b) 1), g_a = dN_a/dX, B_a the change of E by the motion of
/// node a, D what the law answers to each component of E, w = det J (Belytschko et al., section 6.4).
template <class Real>
static void stiffness(const CellBatches& batch, const BatchLaw& law, const double* u, double* K) {
  static constexpr ParentTable table = make_parent_table();
  constexpr int n = lanes<Real>, dofs = 24;
  constexpr int pair[3][2] = {{0, 1}, {1, 2}, {2, 0}};
  BatchState<Real> state;
  PointValues<Real, 6> unit, answer[6];
  evaluate(batch.x, batch.offset, law, u, state, false);
  for (int c = 0; c < 6; ++c) {
    for (int p = 0; p < 8; ++p)
      for (int d = 0; d < 6; ++d) store(unit.value + (6 * p + d) * n, Real(Real{} + (c == d ? 1.0 : 0.0)));
    law.tangent(law.parameters, {8, state.strain.data(), unit.data(), answer[c].data()});
  }
  for (int k = 0; k < dofs * dofs * n; ++k) K[k] = 0.0;
  for (int p = 0; p < 8; ++p) {
    Real F[3][3], S[6], D[6][6], g[8][3], B[8][6][3];
    load_matrix(state.F, p, F);
    load_voigt(state.stress, p, S);
    for (int c = 0; c < 6; ++c) load_voigt(answer[c], p, D[c]);
    const Real(&cofactor)[3][3] = state.geometry.cofactor[p];
    const Real inverse = 1.0 / state.geometry.det[p], weight = state.geometry.det[p] * (1.0 / 512.0);
    for (int a = 0; a < 8; ++a) {
      const double* h = table.value[p][a];
      for (int j = 0; j < 3; ++j)
        g[a][j] = inverse * (h[0] * cofactor[0][j] + h[1] * cofactor[1][j] + h[2] * cofactor[2][j]);
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) {
          const int r = pair[c][0], s = pair[c][1];
          B[a][c][i] = F[i][c] * g[a][c];
          B[a][3 + c][i] = F[i][r] * g[a][s] + F[i][s] * g[a][r];
        }
    }
    for (int b = 0; b < 8; ++b) {
      Real DB[6][3], Sg[3];
      for (int c = 0; c < 6; ++c)
        for (int j = 0; j < 3; ++j) {
          Real sum = D[0][c] * B[b][0][j];
          for (int d = 1; d < 6; ++d) sum += D[d][c] * B[b][d][j];
          DB[c][j] = weight * sum;
        }
      Sg[0] = weight * (S[0] * g[b][0] + S[3] * g[b][1] + S[5] * g[b][2]);
      Sg[1] = weight * (S[3] * g[b][0] + S[1] * g[b][1] + S[4] * g[b][2]);
      Sg[2] = weight * (S[5] * g[b][0] + S[4] * g[b][1] + S[2] * g[b][2]);
      for (int a = 0; a <= b; ++a) {
        const Real by_stress = g[a][0] * Sg[0] + g[a][1] * Sg[1] + g[a][2] * Sg[2];
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) {
            double* entry = K + (dofs * (3 * a + i) + 3 * b + j) * n;
            Real sum = load<Real>(entry);
            for (int c = 0; c < 6; ++c) sum += B[a][c][i] * DB[c][j];
            if (i == j) sum += by_stress;
            store(entry, sum);
          }
      }
    }
  }
}

/// P = F_mid S_alg, F_mid = (F_0 + F_1) / 2, S_alg by discrete_gradient_stress.
template <class Real>
static void add_discrete_gradient_force(const CellBatches& batches, const BatchLaw& law, const double* u_0,
                                        const double* u_1, double* f) {
  for_each_batch<Real>(
      batches, [&](const Index* offset, int count, Index) __attribute__((always_inline)) {
        BatchState<Real> state;
        PointValues<Real, 6> start, end;
        PointValues<Real, 1> end_energy;
        evaluate(batches.x, offset, law, u_0, state, true);
        start = state.strain;
        for_each_gradient(
            u_1, offset, state.geometry, [&](int p, Real F_1[3][3]) __attribute__((always_inline)) {
              Real E_0[6], E_1[6], E_mid[6], F[3][3];
              strain_and_gradient(F_1, E_1);
              load_voigt(start, p, E_0);
              load_matrix(state.F, p, F);
              for (int c = 0; c < 9; ++c) F[c / 3][c % 3] = 0.5 * (F[c / 3][c % 3] + F_1[c / 3][c % 3]);
              for (int c = 0; c < 6; ++c) E_mid[c] = 0.5 * (E_0[c] + E_1[c]);
              store_voigt(E_1, p, end);
              store_voigt(E_mid, p, state.strain);
              store_matrix(F, p, state.F);
            });
        law.update(law.parameters, {8, end.data(), state.stress.data(), end_energy.data()});
        law.update(law.parameters, {8, state.strain.data(), state.stress.data(), nullptr});
        for (int p = 0; p < 8; ++p) {
          Real E_0[6], E_1[6], S[6];
          load_voigt(start, p, E_0);
          load_voigt(end, p, E_1);
          load_voigt(state.stress, p, S);
          discrete_gradient_stress(E_0, E_1, S, load<Real>(state.energy.value + p * lanes<Real>),
                                   load<Real>(end_energy.value + p * lanes<Real>), S);
          store_voigt(S, p, state.stress);
        }
        add_force(state, offset, count, f);
      });
}

template <class Real>
static void mean_stress(const CellBatches& batches, const BatchLaw& law, const double* u, double* stress) {
  for_each_batch<Real>(
      batches, [&](const Index* offset, int count, Index first) __attribute__((always_inline)) {
        BatchState<Real> state;
        evaluate(batches.x, offset, law, u, state, false);
        for (int p = 0; p < 8; ++p) {
          Real F[3][3], P[3][3], S[6];
          load_matrix(state.F, p, F);
          load_voigt(state.stress, p, S);
          first_piola(F, S, P);
          cauchy(P, F, determinant(F), S);
          store_voigt(S, p, state.stress);
        }
        store_mean(state.stress.data(), state.geometry, count, stress + 6 * first);
      });
}

template <class Real>
static constexpr CellKernels kernels() {
  return {add_internal_force<Real>, add_tangent_action<Real>, stiffness<Real>, add_discrete_gradient_force<Real>,
          mean_stress<Real>};
}

}  // namespace carom::hexa8_finite
