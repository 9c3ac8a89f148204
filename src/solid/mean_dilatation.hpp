// Mean dilatation over a number type: the volume change of every point of a cell becomes the cell's mean.
#pragma once

#include "material/neo_hookean_update.hpp"
#include "solid/point_stages.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// Small strain (Hughes, The Finite Element Method, section 4.5.2, "B-bar"): e_bar = e + (mean tr e - tr e) / 3 1,
/// and the same of the stress, which makes of its pressure the mean pressure.
namespace small_dilatation {

/// values_c += (mean over the cell of their trace - their trace) / 3 for c < 3.
template <class Real>
static void average(int points, const double* weight, double* values) {
  constexpr int n = lanes<Real>;
  Real sum{}, volume{};
  for (int p = 0; p < points; ++p) {
    const Real w = scalar<Real>(weight, p);
    const double* v = values + 6 * p * n;
    volume += w;
    sum += w * (load<Real>(v) + load<Real>(v + n) + load<Real>(v + 2 * n));
  }
  const Real mean = sum / volume;
  for (int p = 0; p < points; ++p) {
    double* v = values + 6 * p * n;
    const Real third = (1.0 / 3.0) * (mean - (load<Real>(v) + load<Real>(v + n) + load<Real>(v + 2 * n)));
    for (int c = 0; c < 3; ++c) store(v + c * n, Real(load<Real>(v + c * n) + third));
  }
}

template <class Real>
static void strain(int points, const double* weight, double* e, double*) {
  average<Real>(points, weight, e);
}
template <class Real>
static void stress(int points, const double* weight, double*, const double*, double* s) {
  average<Real>(points, weight, s);
}
template <class Real>
static void strain_change(int points, const double* weight, double*, const double*, double* de) {
  average<Real>(points, weight, de);
}
template <class Real>
static void stress_change(int points, const double* weight, const double*, const double*, const double*, double* ds) {
  average<Real>(points, weight, ds);
}
static inline void cauchy(int, const double*, double*) {}

template <class Real>
static constexpr DilatationStages stages() {
  return {strain<Real>, stress<Real>, strain_change<Real>, stress_change<Real>, cauchy};
}

}  // namespace small_dilatation

/// Finite strain: F_bar = r F with r^3 = J_bar / J and J_bar the mean of J over the reference volume (de Souza Neto,
/// Peric, Dutko and Owen, Int. J. Solids Struct. 33, 1996, with the cell's mean as in Simo, Taylor and Pister, Comput.
/// Methods Appl. Mech. Eng. 51, 1985), E_bar = (r^2 C - 1) / 2. With S_bar = dW/dE_bar, 3 p = S_bar : C_bar and
/// p_hat = (1/V) integral of p, the derivative of the integral of W(E_bar) by E is
///   S = r^2 S_bar + (p_hat J / J_bar - p) C^-1.
namespace finite_dilatation {

/// Numbers of a point.
enum : int { inverse_c = 0, square_ratio = 6, volume_ratio = 7, pressure = 8, law_stress = 9, change = 15, theta = 21 };
inline constexpr int memory_size = dilatation_memory;

template <class Real>
[[gnu::always_inline]] static inline Real get(const double* memory, int p, int component) {
  return load<Real>(memory + (memory_size * p + component) * lanes<Real>);
}
template <class Real>
[[gnu::always_inline]] static inline void put(double* memory, int p, int component, const Real& value) {
  store(memory + (memory_size * p + component) * lanes<Real>, value);
}

/// S : C = tr S + 2 S : E
template <class Real>
[[gnu::always_inline]] static inline Real three_pressures(const Real S[6], const Real E[6]) {
  Real sum = S[0] + S[1] + S[2];
  for (int c = 0; c < 6; ++c) sum += 2.0 * S[c] * E[c];
  return sum;
}

/// Of each lane x near 1 or not: cube_root(1 + z) by Halley's iteration.
template <class Real>
[[gnu::always_inline]] static inline Real cube_root(const Real& x) {
  constexpr int n = lanes<Real>;
  Real y = (1.0 / 3.0) * x + 2.0 / 3.0;
  constexpr int most = 60;
  for (int i = 0; i < most; ++i) {
    const Real cube = y * y * y;
    y = y * (cube + 2.0 * x) / (2.0 * cube + x);
    double error[n];
    store(error, Real((cube - x) / x));
    bool is_near = true;
    for (int l = 0; l < n; ++l) is_near = is_near && !(error[l] * error[l] > 1e-8);  // NaN ends it too
    if (is_near) break;  // the step just made has cubed an error of 3e-5
  }
  const Real cube = y * y * y;
  return y * (cube + 2.0 * x) / (2.0 * cube + x);
}

template <class Real>
static void strain(int points, const double* weight, double* E, double* memory) {
  Real sum{}, volume{};
  for (int p = 0; p < points; ++p) {
    Real e[6];
    load_voigt(E, p, e);
    const auto C = right_cauchy_green(e);
    const Real inverse = 1.0 / (1.0 + C.q);
    for (int c = 0; c < 6; ++c) put(memory, p, inverse_c + c, Real(C.adjugate[c] * inverse));
    const Real change_of_volume = C.q / (1.0 + square_root(Real(1.0 + C.q)));  // J - 1
    put(memory, p, volume_ratio, change_of_volume);
    const Real w = scalar<Real>(weight, p);
    volume += w;
    sum += w * change_of_volume;
  }
  const Real mean = sum / volume;
  for (int p = 0; p < points; ++p) {
    Real e[6];
    load_voigt(E, p, e);
    const Real J_1 = get<Real>(memory, p, volume_ratio), J = 1.0 + J_1;
    const Real z = (mean - J_1) / J, r = cube_root(Real(1.0 + z));
    const Real r_1 = z / (r * r + r + 1.0), square_1 = r_1 * (2.0 + r_1);  // r - 1 and r^2 - 1
    put(memory, p, square_ratio, Real(1.0 + square_1));
    put(memory, p, volume_ratio, Real(J / (1.0 + mean)));
    for (int c = 0; c < 6; ++c) e[c] += square_1 * ((c < 3 ? 0.5 : 0.0) + e[c]);
    store_voigt(E, p, e);
  }
}

template <class Real>
[[gnu::always_inline]] static inline Real mean_pressure(int points, const double* weight, const double* memory) {
  Real sum{}, volume{};
  for (int p = 0; p < points; ++p) {
    const Real w = scalar<Real>(weight, p);
    sum += w * get<Real>(memory, p, pressure);
    volume += w;
  }
  return sum / volume;
}

template <class Real>
static void stress(int points, const double* weight, double* memory, const double* E_bar, double* S) {
  for (int p = 0; p < points; ++p) {
    Real s[6], e[6];
    load_voigt(S, p, s);
    load_voigt(E_bar, p, e);
    for (int c = 0; c < 6; ++c) put(memory, p, law_stress + c, s[c]);
    put(memory, p, pressure, Real((1.0 / 3.0) * three_pressures(s, e)));
  }
  const Real p_hat = mean_pressure<Real>(points, weight, memory);
  for (int p = 0; p < points; ++p) {
    Real s[6];
    load_voigt(S, p, s);
    const Real along = p_hat * get<Real>(memory, p, volume_ratio) - get<Real>(memory, p, pressure);
    const Real square = get<Real>(memory, p, square_ratio);
    for (int c = 0; c < 6; ++c) s[c] = square * s[c] + along * get<Real>(memory, p, inverse_c + c);
    store_voigt(S, p, s);
  }
}

/// With d ln J = C^-1 : dE and theta = (d ln J_bar - d ln J) / 3: dE_bar = r^2 dE + theta C_bar.
template <class Real>
static void strain_change(int points, const double* weight, double* memory, const double* E_bar, double* dE) {
  Real sum{}, volume{};
  for (int p = 0; p < points; ++p) {
    Real de[6], log_J{};
    load_voigt(dE, p, de);
    for (int c = 0; c < 6; ++c) {
      put(memory, p, change + c, de[c]);
      log_J += get<Real>(memory, p, inverse_c + c) * de[c];
    }
    put(memory, p, theta, log_J);
    const Real w = scalar<Real>(weight, p);
    volume += w;
    sum += w * get<Real>(memory, p, volume_ratio) * log_J;
  }
  const Real mean = sum / volume;
  for (int p = 0; p < points; ++p) {
    Real de[6], e[6];
    load_voigt(dE, p, de);
    load_voigt(E_bar, p, e);
    const Real square = get<Real>(memory, p, square_ratio);
    const Real third = (1.0 / 3.0) * (mean - get<Real>(memory, p, theta));
    put(memory, p, theta, third);
    for (int c = 0; c < 6; ++c) de[c] = square * de[c] + third * ((c < 3 ? 1.0 : 0.0) + 2.0 * e[c]);
    store_voigt(dE, p, de);
  }
}

/// The change of `stress`: dS = r^2 (2 theta S_bar + dS_bar) + (J / J_bar (dp_hat - 3 theta p_hat) - dp) C^-1
/// - 2 (p_hat J / J_bar - p) C^-1 dE C^-1.
template <class Real>
static void stress_change(int points, const double* weight, const double* memory, const double* E_bar,
                          const double* dE_bar, double* dS) {
  constexpr int n = lanes<Real>;
  const Real p_hat = mean_pressure<Real>(points, weight, memory);
  double pressure_change[most_points * n];
  Real sum{}, volume{};
  for (int p = 0; p < points; ++p) {
    Real ds[6], e[6], de[6], s[6];
    load_voigt(dS, p, ds);
    load_voigt(E_bar, p, e);
    load_voigt(dE_bar, p, de);
    Real dp = three_pressures(ds, e);
    for (int c = 0; c < 6; ++c) {
      s[c] = get<Real>(memory, p, law_stress + c);
      dp += 2.0 * s[c] * de[c];
    }
    dp *= 1.0 / 3.0;
    store(pressure_change + p * n, dp);
    const Real w = scalar<Real>(weight, p);
    sum += w * dp;
    volume += w;
  }
  const Real dp_hat = sum / volume;
  for (int p = 0; p < points; ++p) {
    Real ds[6], C[6], de[6], sandwich[6];
    load_voigt(dS, p, ds);
    for (int c = 0; c < 6; ++c) {
      C[c] = get<Real>(memory, p, inverse_c + c);
      de[c] = get<Real>(memory, p, change + c);
    }
    double_product(C, de, sandwich);
    const Real square = get<Real>(memory, p, square_ratio), ratio = get<Real>(memory, p, volume_ratio);
    const Real turn = get<Real>(memory, p, theta);
    const Real along = ratio * (dp_hat - 3.0 * turn * p_hat) - scalar<Real>(pressure_change, p);
    const Real twice = 2.0 * (p_hat * ratio - get<Real>(memory, p, pressure));
    for (int c = 0; c < 6; ++c)
      ds[c] = square * (2.0 * turn * get<Real>(memory, p, law_stress + c) + ds[c]) + along * C[c] - twice * sandwich[c];
    store_voigt(dS, p, ds);
  }
}

template <class Real>
static void cauchy(int points, const double* memory, double* sigma) {
  for (int p = 0; p < points; ++p) {
    Real s[6];
    load_voigt(sigma, p, s);
    for (Real& component : s) component *= get<Real>(memory, p, square_ratio);
    store_voigt(sigma, p, s);
  }
}

template <class Real>
static constexpr DilatationStages stages() {
  return {strain<Real>, stress<Real>, strain_change<Real>, stress_change<Real>, cauchy<Real>};
}

}  // namespace finite_dilatation

}  // namespace carom
