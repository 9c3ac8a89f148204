// Mean dilatation over a number type: the volume change of the points of a cell becomes what a few modes of the cell
// can tell of it: its mean, or a linear function.
#pragma once

#include "element/shape_table.hpp"
#include "kernels/point_stages.hpp"
#include "material/neo_hookean_update.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// The modes of the volume in a cell, functions of the point. One, the constant: the cell's mean.
struct MeanVolume {
  static constexpr int modes = 1;
  [[gnu::always_inline]] static constexpr double at(int, int) { return 1.0; }
};

/// 1 and the parent coordinates, for cells of second order at the points of their stiffness.
template <class Shape>
struct LinearVolume {
  static constexpr int modes = 1 + Shape::dimension;
  static constexpr auto rule = Shape::stiffness_rule();
  [[gnu::always_inline]] static constexpr double at(int p, int mode) { return mode == 0 ? 1.0 : rule.xi[p][mode - 1]; }
};

/// The function of the modes that is nearest to the values of a cell's points, which are weighted by their volume: the
/// least squares over the reference cell. A symmetric operator on weighted values that keeps constants.
template <class Real, class Volume>
class VolumeProjection {
 public:
  static constexpr int modes = Volume::modes;

  [[gnu::always_inline]] inline VolumeProjection(int points, const double* weight) {
    for (int p = 0; p < points; ++p) {
      const Real w = scalar<Real>(weight, p);
      for (int k = 0; k < modes; ++k)
        for (int j = 0; j <= k; ++j) factor_[k][j] += (Volume::at(p, k) * Volume::at(p, j)) * w;
    }
    for (int k = 0; k < modes; ++k)  // L D L^T
      for (int j = 0; j <= k; ++j) {
        for (int i = 0; i < j; ++i) factor_[k][j] -= factor_[k][i] * factor_[j][i] * factor_[i][i];
        if (j < k) factor_[k][j] = factor_[k][j] / factor_[j][j];
      }
  }
  /// Adds the value of a point times its weight.
  [[gnu::always_inline]] inline void add(int p, const Real& weighted) {
    for (int k = 0; k < modes; ++k) value_[k] += Volume::at(p, k) * weighted;
  }
  /// After the last point.
  [[gnu::always_inline]] inline void solve() {
    for (int k = 0; k < modes; ++k)
      for (int j = 0; j < k; ++j) value_[k] -= factor_[k][j] * value_[j];
    for (int k = 0; k < modes; ++k) value_[k] = value_[k] / factor_[k][k];
    for (int k = modes - 1; k >= 0; --k)
      for (int i = k + 1; i < modes; ++i) value_[k] -= factor_[i][k] * value_[i];
  }
  [[gnu::always_inline]] inline Real at(int p) const {
    Real sum = value_[0];
    for (int k = 1; k < modes; ++k) sum += Volume::at(p, k) * value_[k];
    return sum;
  }

 private:
  Real factor_[modes][modes] = {}, value_[modes] = {};  ///< L below its diagonal, which is that of D
};

/// Small strain (Hughes, The Finite Element Method, section 4.5.2, "B-bar"): e_bar = e + (theta - tr e) / 3 1 with the
/// projection theta of tr e, and the same of the stress.
namespace small_dilatation {

/// values_c += (projection of their trace - their trace) / 3 for c < 3.
template <class Real, class Volume>
static void average(int points, const double* weight, double* values) {
  constexpr int n = lanes<Real>;
  VolumeProjection<Real, Volume> mean(points, weight);
  for (int p = 0; p < points; ++p) {
    const double* v = values + 6 * p * n;
    mean.add(p, scalar<Real>(weight, p) * (load<Real>(v) + load<Real>(v + n) + load<Real>(v + 2 * n)));
  }
  mean.solve();
  for (int p = 0; p < points; ++p) {
    double* v = values + 6 * p * n;
    const Real third = (1.0 / 3.0) * (mean.at(p) - (load<Real>(v) + load<Real>(v + n) + load<Real>(v + 2 * n)));
    for (int c = 0; c < 3; ++c) store(v + c * n, Real(load<Real>(v + c * n) + third));
  }
}

template <class Real, class Volume>
static void strain(int points, const double* weight, double* e, double*) {
  average<Real, Volume>(points, weight, e);
}
template <class Real, class Volume>
static void stress(int points, const double* weight, double*, const double*, double* s) {
  average<Real, Volume>(points, weight, s);
}
template <class Real, class Volume>
static void strain_change(int points, const double* weight, double*, const double*, double* de) {
  average<Real, Volume>(points, weight, de);
}
template <class Real, class Volume>
static void stress_change(int points, const double* weight, const double*, const double*, const double*, double* ds) {
  average<Real, Volume>(points, weight, ds);
}
static inline void cauchy(int, const double*, double*) {}

template <class Real, class Volume>
static constexpr DilatationStages stages() {
  return {strain<Real, Volume>, stress<Real, Volume>, strain_change<Real, Volume>, stress_change<Real, Volume>, cauchy};
}

}  // namespace small_dilatation

/// Finite strain: F_bar = r F with r^3 = J_bar / J and J_bar the projection of J (de Souza Neto, Peric, Dutko and Owen,
/// Int. J. Solids Struct. 33, 1996, with means over the reference cell as in Simo, Taylor and Pister, Comput. Methods
/// Appl. Mech. Eng. 51, 1985), E_bar = (r^2 C - 1) / 2. With S_bar = dW/dE_bar, 3 p = S_bar : C_bar and the projection
/// p_hat of p / J_bar, the derivative of the integral of W(E_bar) by E is
///   S = r^2 S_bar + (p_hat J - p) C^-1.
namespace finite_dilatation {

/// Numbers of a point.
enum : int {
  inverse_c = 0,
  square_ratio = 6,
  jacobian = 7,
  inverse_mean = 8,  ///< 1 / J_bar
  pressure = 9,
  law_stress = 10,
  change = 16,
  log_change = 22,  ///< d ln J
  theta = 23        ///< (d ln J_bar - d ln J) / 3
};
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

template <class Real, class Volume>
static void strain(int points, const double* weight, double* E, double* memory) {
  VolumeProjection<Real, Volume> mean(points, weight);
  for (int p = 0; p < points; ++p) {
    Real e[6];
    load_voigt(E, p, e);
    const auto C = right_cauchy_green(e);
    const Real inverse = 1.0 / (1.0 + C.q);
    for (int c = 0; c < 6; ++c) put(memory, p, inverse_c + c, Real(C.adjugate[c] * inverse));
    const Real change_of_volume = C.q / (1.0 + square_root(Real(1.0 + C.q)));  // J - 1
    put(memory, p, jacobian, change_of_volume);
    mean.add(p, scalar<Real>(weight, p) * change_of_volume);
  }
  mean.solve();
  for (int p = 0; p < points; ++p) {
    Real e[6];
    load_voigt(E, p, e);
    const Real J_1 = get<Real>(memory, p, jacobian), J = 1.0 + J_1, mean_1 = mean.at(p);
    const Real z = (mean_1 - J_1) / J, r = cube_root(Real(1.0 + z));
    const Real r_1 = z / (r * r + r + 1.0), square_1 = r_1 * (2.0 + r_1);  // r - 1 and r^2 - 1
    put(memory, p, square_ratio, Real(1.0 + square_1));
    put(memory, p, jacobian, J);
    put(memory, p, inverse_mean, Real(1.0 / (1.0 + mean_1)));
    for (int c = 0; c < 6; ++c) e[c] += square_1 * ((c < 3 ? 0.5 : 0.0) + e[c]);
    if constexpr (Volume::modes > 1) refuse_inversion(Real(1.0 + mean_1), e);
    store_voigt(E, p, e);
  }
}

/// p_hat
template <class Real, class Volume>
[[gnu::always_inline]] static inline VolumeProjection<Real, Volume> mean_pressure(int points, const double* weight,
                                                                                  const double* memory) {
  VolumeProjection<Real, Volume> mean(points, weight);
  for (int p = 0; p < points; ++p)
    mean.add(p, scalar<Real>(weight, p) * get<Real>(memory, p, pressure) * get<Real>(memory, p, inverse_mean));
  mean.solve();
  return mean;
}

template <class Real, class Volume>
static void stress(int points, const double* weight, double* memory, const double* E_bar, double* S) {
  for (int p = 0; p < points; ++p) {
    Real s[6], e[6];
    load_voigt(S, p, s);
    load_voigt(E_bar, p, e);
    for (int c = 0; c < 6; ++c) put(memory, p, law_stress + c, s[c]);
    put(memory, p, pressure, Real((1.0 / 3.0) * three_pressures(s, e)));
  }
  const auto p_hat = mean_pressure<Real, Volume>(points, weight, memory);
  for (int p = 0; p < points; ++p) {
    Real s[6];
    load_voigt(S, p, s);
    const Real along = p_hat.at(p) * get<Real>(memory, p, jacobian) - get<Real>(memory, p, pressure);
    const Real square = get<Real>(memory, p, square_ratio);
    for (int c = 0; c < 6; ++c) s[c] = square * s[c] + along * get<Real>(memory, p, inverse_c + c);
    store_voigt(S, p, s);
  }
}

/// With d ln J = C^-1 : dE, the projection J_bar d ln J_bar of J d ln J and theta: dE_bar = r^2 dE + theta C_bar.
template <class Real, class Volume>
static void strain_change(int points, const double* weight, double* memory, const double* E_bar, double* dE) {
  VolumeProjection<Real, Volume> mean(points, weight);
  for (int p = 0; p < points; ++p) {
    Real de[6], log_J{};
    load_voigt(dE, p, de);
    for (int c = 0; c < 6; ++c) {
      put(memory, p, change + c, de[c]);
      log_J += get<Real>(memory, p, inverse_c + c) * de[c];
    }
    put(memory, p, log_change, log_J);
    mean.add(p, scalar<Real>(weight, p) * get<Real>(memory, p, jacobian) * log_J);
  }
  mean.solve();
  for (int p = 0; p < points; ++p) {
    Real de[6], e[6];
    load_voigt(dE, p, de);
    load_voigt(E_bar, p, e);
    const Real square = get<Real>(memory, p, square_ratio);
    const Real log_mean = mean.at(p) * get<Real>(memory, p, inverse_mean);
    const Real third = (1.0 / 3.0) * (log_mean - get<Real>(memory, p, log_change));
    put(memory, p, theta, third);
    for (int c = 0; c < 6; ++c) de[c] = square * de[c] + third * ((c < 3 ? 1.0 : 0.0) + 2.0 * e[c]);
    store_voigt(dE, p, de);
  }
}

/// The change of `stress`: dS = r^2 (2 theta S_bar + dS_bar) + (d(p_hat J) - dp) C^-1 - 2 (p_hat J - p) C^-1 dE C^-1,
/// where d p_hat is the projection of (dp - p d ln J_bar) / J_bar.
template <class Real, class Volume>
static void stress_change(int points, const double* weight, const double* memory, const double* E_bar,
                          const double* dE_bar, double* dS) {
  constexpr int n = lanes<Real>;
  const auto p_hat = mean_pressure<Real, Volume>(points, weight, memory);
  double pressure_change[most_points * n];
  VolumeProjection<Real, Volume> change_of_mean(points, weight);
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
    const Real log_mean = get<Real>(memory, p, log_change) + 3.0 * get<Real>(memory, p, theta);
    change_of_mean.add(p, scalar<Real>(weight, p) * (dp - get<Real>(memory, p, pressure) * log_mean) *
                              get<Real>(memory, p, inverse_mean));
  }
  change_of_mean.solve();
  for (int p = 0; p < points; ++p) {
    Real ds[6], C[6], de[6], sandwich[6];
    load_voigt(dS, p, ds);
    for (int c = 0; c < 6; ++c) {
      C[c] = get<Real>(memory, p, inverse_c + c);
      de[c] = get<Real>(memory, p, change + c);
    }
    double_product(C, de, sandwich);
    const Real square = get<Real>(memory, p, square_ratio), J = get<Real>(memory, p, jacobian);
    const Real turn = get<Real>(memory, p, theta), mean = p_hat.at(p);
    const Real along =
        J * (change_of_mean.at(p) + get<Real>(memory, p, log_change) * mean) - scalar<Real>(pressure_change, p);
    const Real twice = 2.0 * (mean * J - get<Real>(memory, p, pressure));
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

template <class Real, class Volume>
static constexpr DilatationStages stages() {
  return {strain<Real, Volume>, stress<Real, Volume>, strain_change<Real, Volume>, stress_change<Real, Volume>,
          cauchy<Real>};
}

}  // namespace finite_dilatation

}  // namespace carom
