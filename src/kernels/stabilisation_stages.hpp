// The stages of stabilised cells (element/stabilised.hpp) over a number type.
#pragma once

#include "element/kinematics.hpp"
#include "kernels/point_stages.hpp"
#include "kernels/stages.hpp"
#include "math/directional.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// Cells whose modes have the closed form of enhanced strains.
template <class Cell>
concept IsStabilised = requires(typename Cell::template Geometry<double> g) {
  g.half_edge;
};

namespace stabilisation {

template <class Real, class Cell>
[[gnu::always_inline]] static inline void load_modes(const double* values, Real (&z)[Cell::modes][3]) {
  for (int m = 0; m < Cell::modes; ++m)
    for (int i = 0; i < 3; ++i)
      z[m][i] = values == nullptr || i >= Cell::directions
                    ? Real{}
                    : load<Real>(values + (Cell::directions * m + i) * lanes<Real>);
}
template <class Real, class Cell>
[[gnu::always_inline]] static inline void store_modes(double* values, const Real (&z)[Cell::modes][3]) {
  for (int m = 0; m < Cell::modes; ++m)
    for (int i = 0; i < Cell::directions; ++i) store(values + (Cell::directions * m + i) * lanes<Real>, z[m][i]);
}
/// out += A^T z, or A z
template <class Real>
[[gnu::always_inline]] static inline void add_transposed(const Real A[3][3], const Real z[3], Real out[3]) {
  for (int i = 0; i < 3; ++i) out[i] += A[0][i] * z[0] + A[1][i] * z[1] + A[2][i] * z[2];
}
template <class Real>
[[gnu::always_inline]] static inline void add_product(const Real A[3][3], const Real z[3], Real out[3]) {
  for (int i = 0; i < 3; ++i) out[i] += A[i][0] * z[0] + A[i][1] * z[1] + A[i][2] * z[2];
}

/// A Number of the value and, of directional numbers, the change.
template <class Real>
[[gnu::always_inline]] static inline Real number(const Real& value, const Real&, Real*) {
  return value;
}
template <class Real>
[[gnu::always_inline]] static inline Directional<Real> number(const Real& value, const Real& change,
                                                              Directional<Real>*) {
  return {value, change};
}
template <class Real>
[[gnu::always_inline]] static inline const Real& last(const Real& value) {
  return value;
}
template <class Real>
[[gnu::always_inline]] static inline const Real& last(const Directional<Real>& value) {
  return value.change;
}

template <class Real, class Cell>
static void pull(const double*, const double* F, const double* q, double* z) {
  Real of_mode[Cell::modes][3], pulled[Cell::modes][3] = {}, f[3][3];
  load_modes<Real, Cell>(q, of_mode);
  load_frame(F, f);
  for (int m = 0; m < Cell::modes; ++m) add_transposed(f, of_mode[m], pulled[m]);
  store_modes<Real, Cell>(z, pulled);
}

/// The energy and its derivatives, or of directional numbers their changes.
template <class Number, class Real, class Cell>
[[gnu::always_inline]] static inline void forces(const double* geometry, const ModeModuli& moduli, const double* E,
                                                 const double* dE, const double* z, const double* dz,
                                                 const double* plastic, double* energy, double* T, double* S) {
  constexpr Number* kind = nullptr;
  const auto& of_cell = *reinterpret_cast<const typename Cell::template Geometry<Real>*>(geometry);
  Real p[Cell::modes][3], value[Cell::modes][3], change[Cell::modes][3];
  load_modes<Real, Cell>(plastic, p);
  load_modes<Real, Cell>(z, value);
  load_modes<Real, Cell>(dz, change);
  Number elastic[Cell::modes][3], C[6], a[3][3] = {};
  for (int m = 0; m < Cell::modes; ++m)
    for (int i = 0; i < 3; ++i) elastic[m][i] = number(value[m][i], change[m][i], kind);
  for (int c = 0; c < 6; ++c) {  // C = 1 + 2 E; the metric of small strain is that at rest
    const double unit = c < 3 ? 1.0 : 0.0, times = c < 3 ? 2.0 : 1.0;
    C[c] = number(E == nullptr ? Real(Real{} + unit) : Real(unit + times * load<Real>(E + c * lanes<Real>)),
                  dE == nullptr ? Real{} : Real(times * load<Real>(dE + c * lanes<Real>)), kind);
  }
  const Real(&G)[3][3] = of_cell.half_edge;
  constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  for (int i = 0; i < 3; ++i) {
    Number along[3];
    for (int r = 0; r < 3; ++r)
      along[r] = G[i][0] * C[voigt[r][0]] + G[i][1] * C[voigt[r][1]] + G[i][2] * C[voigt[r][2]];
    for (int j = 0; j <= i; ++j) a[i][j] = a[j][i] = G[j][0] * along[0] + G[j][1] * along[1] + G[j][2] * along[2];
  }
  if (plastic != nullptr)
    for (int m = 0; m < Cell::modes; ++m)
      for (int r = 0; r < 3; ++r)
        elastic[m][r] -= p[m][0] * C[voigt[r][0]] + p[m][1] * C[voigt[r][1]] + p[m][2] * C[voigt[r][2]];
  ModeForces<Number, Cell::modes> out;
  Cell::forces(moduli, G, a, elastic, out);
  store<Real>(energy, last(out.energy));
  Real force[Cell::modes][3];
  for (int m = 0; m < Cell::modes; ++m)
    for (int i = 0; i < 3; ++i) force[m][i] = last(out.T[m][i]);
  store_modes<Real, Cell>(T, force);
  Real M[3][3], MG[3][3] = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) M[i][j] = last(out.metric[i][j]);
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) MG[i][c] = M[i][0] * G[0][c] + M[i][1] * G[1][c] + M[i][2] * G[2][c];
  for (int c = 0; c < 6; ++c) {  // S = 2 dW/dC
    const int r = c % 3, s = c < 3 ? r : (r + 1) % 3;
    Real sum = 2.0 * (G[0][r] * MG[0][s] + G[1][r] * MG[1][s] + G[2][r] * MG[2][s]);
    if (plastic != nullptr)
      for (int m = 0; m < Cell::modes; ++m) sum -= force[m][r] * p[m][s] + force[m][s] * p[m][r];
    store(S + c * lanes<Real>, sum);
  }
}

template <class Real, class Cell>
static void trial(const double* geometry, const ModeModuli& moduli, const double* E, const double* z,
                  const double* plastic, double* energy, double* T, double* S) {
  forces<Real, Real, Cell>(geometry, moduli, E, nullptr, z, nullptr, plastic, energy, T, S);
}

template <class Real, class Cell>
static void change(const double* geometry, const ModeModuli& moduli, const double* E, const double* dE, const double* z,
                   const double* dz, const double* plastic, double* energy, double* T, double* S) {
  forces<Directional<Real>, Real, Cell>(geometry, moduli, E, dE, z, dz, plastic, energy, T, S);
}

template <class Real, class Cell>
static void push(const double* geometry, const double* F, const double* q, const double* T, const double* share,
                 double* Q, double* P) {
  Real f[3][3], of_mode[Cell::modes][3], force[Cell::modes][3], spatial[Cell::modes][3] = {}, stress[3][3];
  load_frame(F, f);
  load_modes<Real, Cell>(q, of_mode);
  load_modes<Real, Cell>(T, force);
  const Real volume = load<Real>(geometry);
  if (share != nullptr)
    for (int m = 0; m < Cell::modes; ++m)
      for (int i = 0; i < 3; ++i) force[m][i] *= load<Real>(share);
  for (int m = 0; m < Cell::modes; ++m) {
    add_product(f, force[m], spatial[m]);
    for (int i = 0; i < 3; ++i) spatial[m][i] *= volume;
  }
  store_modes<Real, Cell>(Q, spatial);
  if (F == nullptr) return;
  load_point(P, 0, stress);
  for (int m = 0; m < Cell::modes; ++m)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) stress[i][j] += of_mode[m][i] * force[m][j];
  store_point(P, 0, stress);
}

template <class Real, class Cell>
static void pull_change(const double* geometry, const double* F, const double* dH, const double* q, const double* dq,
                        double* dz) {
  pull<Real, Cell>(geometry, F, dq, dz);
  if (F == nullptr) return;
  Real h[3][3], of_mode[Cell::modes][3], pulled[Cell::modes][3];
  load_point(dH, 0, h);
  load_modes<Real, Cell>(q, of_mode);
  load_modes<Real, Cell>(dz, pulled);
  for (int m = 0; m < Cell::modes; ++m) add_transposed(h, of_mode[m], pulled[m]);
  store_modes<Real, Cell>(dz, pulled);
}

template <class Real, class Cell>
static void push_change(const double* geometry, const double* F, const double* dH, const double* q, const double* dq,
                        const double* T, const double* dT, double* Q, double* P) {
  push<Real, Cell>(geometry, F, q, dT, nullptr, Q, P);
  if (F == nullptr) return;
  Real h[3][3], of_mode[Cell::modes][3], force[Cell::modes][3], spatial[Cell::modes][3], stress[3][3];
  load_point(dH, 0, h);
  load_modes<Real, Cell>(dq, of_mode);
  load_modes<Real, Cell>(T, force);
  load_modes<Real, Cell>(Q, spatial);
  load_point(P, 0, stress);
  const Real volume = load<Real>(geometry);
  for (int m = 0; m < Cell::modes; ++m) {
    Real by_gradient[3] = {};
    add_product(h, force[m], by_gradient);
    for (int i = 0; i < 3; ++i) {
      spatial[m][i] += volume * by_gradient[i];
      for (int j = 0; j < 3; ++j) stress[i][j] += of_mode[m][i] * force[m][j];
    }
  }
  store_modes<Real, Cell>(Q, spatial);
  store_point(P, 0, stress);
}

/// C^-1 z of every mode.
template <class Real, class Cell>
[[gnu::always_inline]] static inline void material_modes(const double* E, const double* z,
                                                         Real (&out)[Cell::modes][3]) {
  Real value[Cell::modes][3], C[3][3], cofactor[3][3];
  load_modes<Real, Cell>(z, value);
  constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Real one = Real{} + (i == j ? 1.0 : 0.0);
      C[i][j] = E == nullptr ? one : Real(one + (i == j ? 2.0 : 1.0) * load<Real>(E + voigt[i][j] * lanes<Real>));
    }
  const Real inverse = 1.0 / invert(C, cofactor);
  for (int m = 0; m < Cell::modes; ++m) {
    for (int i = 0; i < 3; ++i) out[m][i] = Real{};
    add_product(cofactor, value[m], out[m]);
    for (int i = 0; i < 3; ++i) out[m][i] *= inverse;
  }
}

/// From q_p at the end, q_p + (1 - share) (C^-1 z - q_p), back to q_p. Where nothing is left of the elastic modes
/// nothing is known of q_p, and nothing depends on it.
template <class Real, class Cell>
static void begin(const double*, const double* E, const double* z, const double* history, bool is_over, double* plastic,
                  double* share) {
  Real p[Cell::modes][3], material[Cell::modes][3];
  load_modes<Real, Cell>(history, p);
  const Real one = Real{} + 1.0;
  if (is_over && history != nullptr) {
    const Real lost = load<Real>(history + Cell::modes * Cell::directions * lanes<Real>), left = one - lost;
    const Real inverse = 1.0 / (left > 0.0 ? left : one);
    material_modes<Real, Cell>(E, z, material);
    for (int m = 0; m < Cell::modes; ++m)
      for (int i = 0; i < 3; ++i) p[m][i] = inverse * (p[m][i] - lost * material[m][i]);
    store(share, left);
  } else {
    store(share, one);
  }
  store_modes<Real, Cell>(plastic, p);
}

template <class Real, class Cell>
static void flow(const double*, const double* E, const double* z, const double* plastic, const double* share,
                 double* history) {
  Real p[Cell::modes][3], material[Cell::modes][3];
  load_modes<Real, Cell>(plastic, p);
  material_modes<Real, Cell>(E, z, material);
  const Real lost = 1.0 - load<Real>(share);
  for (int m = 0; m < Cell::modes; ++m)
    for (int i = 0; i < 3; ++i) p[m][i] += lost * (material[m][i] - p[m][i]);
  store_modes<Real, Cell>(history, p);
  store(history + Cell::modes * Cell::directions * lanes<Real>, lost);
}

/// Of modes that are not stabilised.
template <class Real, class Cell>
static constexpr ModeStages places() {
  return {.pull = pull<Real, Cell>,
          .push = push<Real, Cell>,
          .pull_change = pull_change<Real, Cell>,
          .push_change = push_change<Real, Cell>};
}

template <class Real, class Cell>
static constexpr ModeStages stages() {
  return {pull<Real, Cell>,   trial<Real, Cell>,       push<Real, Cell>,  pull_change<Real, Cell>,
          change<Real, Cell>, push_change<Real, Cell>, begin<Real, Cell>, flow<Real, Cell>};
}

}  // namespace stabilisation

}  // namespace carom
