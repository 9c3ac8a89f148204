// Von Mises plasticity at finite strain over a number type: multiplicative, with logarithmic elastic strains.
#pragma once

#include "material/johnson_cook.hpp"
#include "material/plastic_update.hpp"
#include "material/symmetric.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// C = 1 + 2 E = L L^T (Cholesky), L lower triangular. Every F with F^T F = C gives the same S; here it is L^T. Not a
/// number where C is not positive definite.
template <class Real>
struct CholeskyStretch {
  Real L[3][3], inverse[3][3];
  Real excess[6];  ///< L^T L - 1, without cancellation at small strains
};

template <class Real>
[[gnu::always_inline]] static inline CholeskyStretch<Real> cholesky_stretch(const Real e[6]) {
  CholeskyStretch<Real> s{};
  const Real l11 = square_root(Real(1.0 + 2.0 * e[0])), i11 = 1.0 / l11;
  const Real l21 = e[3] * i11, l31 = e[5] * i11;
  const Real q22 = 2.0 * e[1] - l21 * l21, l22 = square_root(Real(1.0 + q22)), i22 = 1.0 / l22;
  const Real l32 = (e[4] - l31 * l21) * i22;
  const Real q33 = 2.0 * e[2] - l31 * l31 - l32 * l32, l33 = square_root(Real(1.0 + q33)), i33 = 1.0 / l33;
  s.L[0][0] = l11;
  s.L[1][0] = l21;
  s.L[1][1] = l22;
  s.L[2][0] = l31;
  s.L[2][1] = l32;
  s.L[2][2] = l33;
  s.inverse[0][0] = i11;
  s.inverse[1][1] = i22;
  s.inverse[2][2] = i33;
  s.inverse[1][0] = -l21 * i11 * i22;
  s.inverse[2][1] = -l32 * i22 * i33;
  s.inverse[2][0] = (l21 * l32 - l31 * l22) * i11 * i22 * i33;
  s.excess[0] = 2.0 * e[0] + l21 * l21 + l31 * l31;
  s.excess[1] = q22 + l32 * l32;
  s.excess[2] = q33;
  s.excess[3] = l21 * l22 + l31 * l32;
  s.excess[4] = l32 * l33;
  s.excess[5] = l31 * l33;
  return s;
}

/// A^T B A of a symmetric B and a lower triangular A.
template <class Real>
[[gnu::always_inline]] static inline void sandwich_lower(const Real A[3][3], const Real B[6], Real result[6]) {
  Real BA[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      BA[i][j] = B[voigt_place[i][j]] * A[j][j];
      for (int k = j + 1; k < 3; ++k) BA[i][j] += B[voigt_place[i][k]] * A[k][j];
    }
  for (int c = 0; c < 6; ++c) {
    const int i = voigt_row[c], j = voigt_column[c];
    result[c] = A[i][i] * BA[i][j];
    for (int k = i + 1; k < 3; ++k) result[c] += A[k][i] * BA[k][j];
  }
}

/// Of one point: F = L^T, and the excess over 1 of the elastic trial tensor b = F Cp^-1 F^T with the plastic
/// deformation of the beginning of the step. history: Cp^-1 - 1 (6, the tensor's components), or null.
template <class Real>
[[gnu::always_inline]] static inline CholeskyStretch<Real> trial_stretch(const double* strain, const double* history,
                                                                         Real excess[6]) {
  constexpr int n = lanes<Real>;
  Real e[6], X[6];
  for (int c = 0; c < 6; ++c) e[c] = load<Real>(strain + c * n);
  const CholeskyStretch<Real> stretch = cholesky_stretch(e);
  for (int c = 0; c < 6; ++c) excess[c] = stretch.excess[c];
  if (history == nullptr) return stretch;
  for (int c = 0; c < 6; ++c) X[c] = load<Real>(history + c * n);
  Real plastic[6];
  sandwich_lower(stretch.L, X, plastic);
  for (int c = 0; c < 6; ++c) excess[c] += plastic[c];
  return stretch;
}

/// Cp^-1 - 1 at the end: F^-1 b F^-T changes with b, from the trial one to it times exp(-2 (1 - share) dev(eps)).
template <class Real>
[[gnu::always_inline]] static inline void store_plastic_deformation(const CholeskyStretch<Real>& stretch,
                                                                    const Real excess[6], const Real deviator[6],
                                                                    const Real& share, const double* history,
                                                                    double* new_history) {
  constexpr int n = lanes<Real>;
  double yielding[n];
  store(yielding, share);
  bool any = false;
  for (int l = 0; l < n; ++l) any = any || yielding[l] < 1.0;
  Real exponent[6], factor[6], spatial[6], change[6]{};
  if (any) {
    for (int c = 0; c < 6; ++c) exponent[c] = -2.0 * (1.0 - share) * deviator[c];
    matrix_exponential_less_one(exponent, factor);
    commuting_product(excess, factor, spatial);
    for (int c = 0; c < 6; ++c) spatial[c] += factor[c];
    sandwich_lower(stretch.inverse, spatial, change);
  }
  for (int c = 0; c < 6; ++c) {
    const Real before = history == nullptr ? Real{} : load<Real>(history + c * n);
    const Real after = before + change[c];
    store(new_history + c * n, share < 1.0 ? after : before);
  }
}

/// tau = K tr(eps) 1 + 2 G dev(eps) of the elastic logarithmic strain eps = ln(b) / 2, b = F Cp^-1 F^T, returned
/// radially to the yield surface; S = F^-1 tau F^-T; stored energy K/2 tr^2 + G |dev|^2. The flow rule is integrated by
/// the exponential map, so that plastic deformation keeps the volume (Simo, Comput. Methods Appl. Mech. Eng. 99, 1992;
/// de Souza Neto, Peric and Owen, Computational Methods for Plasticity, box 14.3). rho c^2 along a principal direction
/// of elastic steps is lambda + 2 G - tau_i. History: Cp^-1 - 1 (6, the tensor's components), then the law's variables.
/// parameters: const PlasticLaw<Yield>*.
template <class Real, class Yield>
static void finite_plastic_update(const void* parameters, const PointBatch& batch) {
  const auto& law = *static_cast<const PlasticLaw<Yield>*>(parameters);
  const double G = law.lame.G, K = law.lame.lambda + 2.0 / 3.0 * G;
  constexpr int n = lanes<Real>;
  const int H = (6 + Yield::variables) * n;
  for (int p = 0; p < batch.points; ++p) {
    const double* history = batch.history == nullptr ? nullptr : batch.history + H * p;
    double* new_history = batch.new_history == nullptr ? nullptr : batch.new_history + H * p;
    Real excess[6], eps[6], tau[6], S[6];
    const CholeskyStretch<Real> stretch = trial_stretch(batch.strain + 6 * p * n, history, excess);
    matrix_logarithm(excess, eps);
    for (Real& component : eps) component *= 0.5;
    const Real trace = eps[0] + eps[1] + eps[2];
    make_deviator(eps);
    const Real square = norm_square(eps), trial = G * square_root(Real(6.0 * square));
    double* yield_stress = batch.yield_stress == nullptr ? nullptr : batch.yield_stress + p * n;
    const RadialReturn<Real> at_end =
        radial_return(law, with_modes(trial, batch.mode_square, p), history == nullptr ? nullptr : history + 6 * n,
                      batch.dt, batch.is_over, yield_stress);
    if (batch.share != nullptr) store(batch.share + p * n, at_end.share);
    const Real pressure_part = K * trace, modulus = 2.0 * G * at_end.share;
    for (int c = 0; c < 6; ++c) tau[c] = c < 3 ? pressure_part + modulus * eps[c] : modulus * eps[c];
    sandwich_lower(stretch.inverse, tau, S);
    for (int c = 0; c < 6; ++c) store(batch.stress + (6 * p + c) * n, S[c]);
    if (batch.energy != nullptr)
      store(batch.energy + p * n, Real(0.5 * pressure_part * trace + G * at_end.share * at_end.share * square));
    if (new_history != nullptr) store_plastic_deformation(stretch, excess, eps, at_end.share, history, new_history);
    store_variables(law, at_end, new_history == nullptr ? nullptr : new_history + 6 * n,
                    batch.dissipation == nullptr ? nullptr : batch.dissipation + p * n);
    if (batch.wave_modulus != nullptr) {
      // -tau_i is at most -K tr + 2/3 of the equivalent stress
      const Real compression = 2.0 / 3.0 * at_end.share * trial - pressure_part, zero = Real{};
      store(batch.wave_modulus + p * n, Real((compression > 0.0 ? compression : zero) + (law.lame.lambda + 2.0 * G)));
    }
  }
}

/// artanh(r) / r of r = (b_i - b_j) / (b_i + b_j), given half of ln(b_i / b_j): the ratio that turns differences of
/// b into those of eps; 1 where they coincide.
template <class Real>
[[gnu::always_inline]] static inline Real logarithmic_ratio(const Real& r, const Real& difference) {
  constexpr double largest_square = 0.04;  // ten terms leave 1e-17
  const Real t = r * r, one = Real{} + 1.0;
  Real sum = Real{} + 1.0 / 21.0;
  for (int k = 19; k >= 1; k -= 2) sum = sum * t + 1.0 / k;
  return t > largest_square ? difference / (t > largest_square ? r : one) : sum;
}

/// N^T A N
template <class Real>
[[gnu::always_inline]] static inline void turned(const Real N[3][3], const Real A[6], Real result[6]) {
  for (int c = 0; c < 6; ++c) {
    const int i = voigt_row[c], j = voigt_column[c];
    Real sum = Real{};
    for (int k = 0; k < 3; ++k)
      for (int m = 0; m < 3; ++m) sum += N[k][i] * A[voigt_place[k][m]] * N[m][j];
    result[c] = sum;
  }
}

/// dS = F^-1 (d tau - d tau - tau d) F^-T, d = F^-T dE F^-1, in the principal directions of b: d eps_ii = d_ii, and
/// across, d tau_ij = (tau_i - tau_j) / (b_i - b_j) (b_i + b_j) d_ij, where tau_i - tau_j = 2 G share (eps_i - eps_j).
/// Exact for the update above, and symmetric. parameters: const PlasticLaw<Yield>*.
template <class Real, class Yield>
static void finite_plastic_tangent(const void* parameters, const TangentBatch& batch) {
  const auto& law = *static_cast<const PlasticLaw<Yield>*>(parameters);
  const double G = law.lame.G, K = law.lame.lambda + 2.0 / 3.0 * G;
  constexpr int n = lanes<Real>;
  const int H = (6 + Yield::variables) * n;
  for (int p = 0; p < batch.points; ++p) {
    const double* history = batch.history == nullptr ? nullptr : batch.history + H * p;
    Real excess[6], value[3], N[3][3], eps[3], rest, dE[6], spatial[6], d[6], change[6], S[6];
    const CholeskyStretch<Real> stretch = trial_stretch(batch.strain + 6 * p * n, history, excess);
    principal(excess, value, N);
    for (int i = 0; i < 3; ++i) {
      logarithm(value[i], eps[i], rest);
      eps[i] *= 0.5;
    }
    const Real eps_trace = eps[0] + eps[1] + eps[2];
    make_deviator(eps);
    const Real square = eps[0] * eps[0] + eps[1] * eps[1] + eps[2] * eps[2];
    const RadialReturn<Real> at_end =
        radial_return(law, with_modes(Real(G * square_root(Real(6.0 * square))), batch.mode_square, p),
                      history == nullptr ? nullptr : history + 6 * n, batch.dt);
    for (int c = 0; c < 6; ++c) dE[c] = (c < 3 ? 1.0 : 0.5) * load<Real>(batch.strain_change + (6 * p + c) * n);
    for (int c = 0; c < 6; ++c) {  // L^-1 dE L^-T
      const int i = voigt_row[c], j = voigt_column[c];
      spatial[c] = Real{};
      for (int k = 0; k <= i; ++k)
        for (int m = 0; m <= j; ++m)
          spatial[c] += stretch.inverse[i][k] * dE[voigt_place[k][m]] * stretch.inverse[j][m];
    }
    turned(N, spatial, d);
    const Real trace = d[0] + d[1] + d[2], modulus = 2.0 * G * at_end.share;
    const Real along = along_trial(G, at_end, Real(eps[0] * d[0] + eps[1] * d[1] + eps[2] * d[2]), square, batch, p);
    Real tau[3];
    for (int i = 0; i < 3; ++i) tau[i] = K * eps_trace + modulus * eps[i];
    for (int i = 0; i < 3; ++i)
      change[i] = K * trace + modulus * (d[i] - trace * (1.0 / 3.0)) + 2.0 * G * along * eps[i] - 2.0 * tau[i] * d[i];
    for (int c = 3; c < 6; ++c) {
      const int i = voigt_row[c], j = voigt_column[c];
      const Real r = (value[i] - value[j]) / (2.0 + value[i] + value[j]);
      change[c] = (modulus * logarithmic_ratio(r, Real(eps[i] - eps[j])) - tau[i] - tau[j]) * d[c];
    }
    Real back[3][3];
    for (int i = 0; i < 9; ++i) back[i / 3][i % 3] = N[i % 3][i / 3];
    turned(back, change, spatial);
    sandwich_lower(stretch.inverse, spatial, S);
    for (int c = 0; c < 6; ++c) store(batch.stress_change + (6 * p + c) * n, S[c]);
  }
}

template <class Real>
static constexpr LawKernels j2_kernels() {
  return {finite_plastic_update<Real, Hardening>, finite_plastic_tangent<Real, Hardening>};
}
template <class Real>
static constexpr LawKernels j2_rate_kernels() {
  return {finite_plastic_update<Real, RateHardening>, finite_plastic_tangent<Real, RateHardening>};
}
template <class Real>
static constexpr LawKernels johnson_cook_kernels() {
  return {finite_plastic_update<Real, JohnsonCook>, finite_plastic_tangent<Real, JohnsonCook>};
}

}  // namespace carom
