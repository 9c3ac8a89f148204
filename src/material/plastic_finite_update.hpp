// Von Mises plasticity at finite strain over a number type: multiplicative, with logarithmic elastic strains.
#pragma once

#include "material/plastic_update.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// C = 1 + 2 E = L L^T (Cholesky), L lower triangular. Every F with F^T F = C gives the same S; here it is L^T. Not a
/// number where C is not positive definite.
template <class Real>
struct CholeskyStretch {
  Real L[3][3], inverse[3][3];
  Real excess[3][3];  ///< L^T L - 1, without cancellation at small strains
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
  s.excess[0][0] = 2.0 * e[0] + l21 * l21 + l31 * l31;
  s.excess[1][1] = q22 + l32 * l32;
  s.excess[2][2] = q33;
  s.excess[0][1] = l21 * l22 + l31 * l32;
  s.excess[0][2] = l31 * l33;
  s.excess[1][2] = l32 * l33;
  s.excess[1][0] = s.excess[0][1];
  s.excess[2][0] = s.excess[0][2];
  s.excess[2][1] = s.excess[1][2];
  return s;
}

/// A^T B A of a symmetric B and a lower triangular A.
template <class Real>
[[gnu::always_inline]] static inline void sandwich_lower(const Real A[3][3], const Real B[3][3], Real result[3][3]) {
  Real BA[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      BA[i][j] = B[i][j] * A[j][j];
      for (int k = j + 1; k < 3; ++k) BA[i][j] += B[i][k] * A[k][j];
    }
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      Real sum = A[i][i] * BA[i][j];
      for (int k = i + 1; k < 3; ++k) sum += A[k][i] * BA[k][j];
      result[i][j] = sum;
      result[j][i] = sum;
    }
}

/// N diag(value) N^T and N B N^T.
template <class Real>
[[gnu::always_inline]] static inline void from_principal(const Real N[3][3], const Real B[3][3], Real result[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      Real sum = Real{};
      for (int k = 0; k < 3; ++k)
        for (int m = 0; m < 3; ++m) sum += N[i][k] * B[k][m] * N[j][m];
      result[i][j] = sum;
      result[j][i] = sum;
    }
}

inline constexpr int voigt_row[6] = {0, 1, 2, 0, 1, 2}, voigt_column[6] = {0, 1, 2, 1, 2, 0};

template <class Real>
[[gnu::always_inline]] static inline void load_symmetric(const double* voigt, double shear, Real A[3][3]) {
  for (int c = 0; c < 6; ++c) {
    const Real value = (c < 3 ? 1.0 : shear) * load<Real>(voigt + c * lanes<Real>);
    A[voigt_row[c]][voigt_column[c]] = value;
    A[voigt_column[c]][voigt_row[c]] = value;
  }
}

/// The elastic trial state of one point: b = F Cp^-1 F^T with the plastic deformation of the beginning of the step.
template <class Real>
struct FiniteTrial {
  CholeskyStretch<Real> stretch;
  Real excess[3], N[3][3];  ///< eigenvalues of b - 1, and eigenvectors
  Real trace, deviator[3];  ///< of the logarithmic strain ln(b) / 2, principal
  Real square, stress;      ///< |deviator|^2, equivalent trial stress
};

/// history: Cp^-1 - 1 (6, the tensor's components), or null.
template <class Real>
[[gnu::always_inline]] static inline FiniteTrial<Real> finite_trial(const PlasticLaw& law, const double* strain,
                                                                    const double* history) {
  FiniteTrial<Real> trial;
  Real e[6], A[3][3];
  for (int c = 0; c < 6; ++c) e[c] = load<Real>(strain + c * lanes<Real>);
  trial.stretch = cholesky_stretch(e);
  if (history == nullptr) {
    for (int i = 0; i < 9; ++i) A[i / 3][i % 3] = trial.stretch.excess[i / 3][i % 3];
  } else {
    Real X[3][3];
    load_symmetric(history, 1.0, X);
    sandwich_lower(trial.stretch.L, X, A);
    for (int i = 0; i < 9; ++i) A[i / 3][i % 3] += trial.stretch.excess[i / 3][i % 3];
  }
  principal(A, trial.excess, trial.N);
  Real log[3], rest;
  for (int i = 0; i < 3; ++i) logarithm(trial.excess[i], log[i], rest);
  trial.trace = 0.5 * (log[0] + log[1] + log[2]);
  for (int i = 0; i < 3; ++i)
    trial.deviator[i] = ((log[i] - log[(i + 1) % 3]) + (log[i] - log[(i + 2) % 3])) * (1.0 / 6.0);
  trial.square = trial.deviator[0] * trial.deviator[0] + trial.deviator[1] * trial.deviator[1] +
                 trial.deviator[2] * trial.deviator[2];
  trial.stress = law.lame.G * square_root(Real(6.0 * trial.square));
  return trial;
}

/// Cp^-1 - 1 at the end: F^-1 b F^-T changes with b along the trial's directions, b_i = exp(2 eps_i).
template <class Real>
[[gnu::always_inline]] static inline void store_plastic_deformation(const FiniteTrial<Real>& trial, const Real& share,
                                                                    const double* history, double* new_history) {
  constexpr int n = lanes<Real>;
  Real change[3][3]{}, spatial[3][3], reference[3][3];
  for (int i = 0; i < 3; ++i)
    change[i][i] = (1.0 + trial.excess[i]) * exponential_less_one(Real(-2.0 * (1.0 - share) * trial.deviator[i]));
  from_principal(trial.N, change, spatial);
  sandwich_lower(trial.stretch.inverse, spatial, reference);
  for (int c = 0; c < 6; ++c) {
    const Real before = history == nullptr ? Real{} : load<Real>(history + c * n);
    const Real after = before + reference[voigt_row[c]][voigt_column[c]];
    store(new_history + c * n, share < 1.0 ? after : before);
  }
}

/// tau = K tr(eps) 1 + 2 G dev(eps) of the elastic logarithmic strain eps = ln(b) / 2, b = F Cp^-1 F^T, returned
/// radially to the yield surface; S = F^-1 tau F^-T; stored energy K/2 tr^2 + G |dev|^2. The flow rule is integrated by
/// the exponential map, so that plastic deformation keeps the volume (Simo, Comput. Methods Appl. Mech. Eng. 99, 1992;
/// de Souza Neto, Peric and Owen, Computational Methods for Plasticity, box 14.3). History: Cp^-1 - 1 (6, the tensor's
/// components), then the law's variables. parameters: const PlasticLaw*.
template <class Real>
static void finite_plastic_update(const void* parameters, const PointBatch& batch) {
  const auto& law = *static_cast<const PlasticLaw*>(parameters);
  const double G = law.lame.G, K = law.lame.lambda + 2.0 / 3.0 * G;
  constexpr int n = lanes<Real>;
  const int H = (6 + law.variables) * n;
  for (int p = 0; p < batch.points; ++p) {
    const double* history = batch.history == nullptr ? nullptr : batch.history + H * p;
    double* new_history = batch.new_history == nullptr ? nullptr : batch.new_history + H * p;
    const FiniteTrial<Real> trial = finite_trial<Real>(law, batch.strain + 6 * p * n, history);
    const RadialReturn<Real> at_end =
        radial_return(law, trial.stress, history == nullptr ? nullptr : history + 6 * n, batch.dt);
    const Real pressure_part = K * trial.trace, modulus = 2.0 * G * at_end.share;
    Real tau[3][3]{}, spatial[3][3], S[3][3];
    for (int i = 0; i < 3; ++i) tau[i][i] = pressure_part + modulus * trial.deviator[i];
    from_principal(trial.N, tau, spatial);
    sandwich_lower(trial.stretch.inverse, spatial, S);
    for (int c = 0; c < 6; ++c) store(batch.stress + (6 * p + c) * n, S[voigt_row[c]][voigt_column[c]]);
    if (batch.energy != nullptr)
      store(batch.energy + p * n,
            Real(0.5 * pressure_part * trial.trace + G * at_end.share * at_end.share * trial.square));
    if (new_history != nullptr) store_plastic_deformation(trial, at_end.share, history, new_history);
    store_variables(law, at_end, new_history == nullptr ? nullptr : new_history + 6 * n,
                    batch.dissipation == nullptr ? nullptr : batch.dissipation + p * n);
    if (batch.wave_modulus != nullptr) {
      const Real zero = Real{};
      Real largest = zero;  // of -tau: rho c^2 = lambda + 2 G - tau_i along the principal direction i
      for (int i = 0; i < 3; ++i) largest = -tau[i][i] > largest ? Real(-tau[i][i]) : largest;
      store(batch.wave_modulus + p * n, Real(largest + (law.lame.lambda + 2.0 * G)));
    }
  }
}

/// artanh(r) / r of r = (b_i - b_j) / (b_i + b_j), given half of ln(b_i / b_j): the ratio that turns differences of
/// b into those of eps; 1 where they coincide.
template <class Real>
[[gnu::always_inline]] static inline Real logarithmic_ratio(const Real& r, const Real& difference) {
  constexpr double near_square = 0.04;  // ten terms leave 1e-17
  const Real t = r * r, one = Real{} + 1.0;
  Real sum = Real{} + 1.0 / 21.0;
  for (int k = 19; k >= 1; k -= 2) sum = sum * t + 1.0 / k;
  return t > near_square ? difference / (t > near_square ? r : one) : sum;
}

/// dS = F^-1 (d tau - d tau - tau d) F^-T, d = F^-T dE F^-1, in the principal directions of b: d eps_ii = d_ii, and
/// across, d tau_ij = (tau_i - tau_j) / (b_i - b_j) (b_i + b_j) d_ij, where tau_i - tau_j = 2 G share (eps_i - eps_j).
/// Exact for the update above, and symmetric. parameters: const PlasticLaw*.
template <class Real>
static void finite_plastic_tangent(const void* parameters, const TangentBatch& batch) {
  const auto& law = *static_cast<const PlasticLaw*>(parameters);
  const double G = law.lame.G, K = law.lame.lambda + 2.0 / 3.0 * G;
  constexpr int n = lanes<Real>;
  const int H = (6 + law.variables) * n;
  for (int p = 0; p < batch.points; ++p) {
    const double* history = batch.history == nullptr ? nullptr : batch.history + H * p;
    const FiniteTrial<Real> trial = finite_trial<Real>(law, batch.strain + 6 * p * n, history);
    const RadialReturn<Real> at_end =
        radial_return(law, trial.stress, history == nullptr ? nullptr : history + 6 * n, batch.dt);
    Real dE[3][3], spatial[3][3], d[3][3], tau[3];
    load_symmetric(batch.strain_change + 6 * p * n, 0.5, dE);
    for (int i = 0; i < 3; ++i)  // L^-1 dE L^-T
      for (int j = 0; j < 3; ++j) {
        Real sum = Real{};
        for (int k = 0; k <= i; ++k)
          for (int m = 0; m <= j; ++m) sum += trial.stretch.inverse[i][k] * dE[k][m] * trial.stretch.inverse[j][m];
        spatial[i][j] = sum;
      }
    Real N_transposed[3][3];
    for (int i = 0; i < 9; ++i) N_transposed[i / 3][i % 3] = trial.N[i % 3][i / 3];
    from_principal(N_transposed, spatial, d);
    const Real trace = d[0][0] + d[1][1] + d[2][2], modulus = 2.0 * G * at_end.share;
    Real product = Real{}, change[3][3];
    for (int i = 0; i < 3; ++i) {
      tau[i] = K * trial.trace + modulus * trial.deviator[i];
      product += trial.deviator[i] * d[i][i];
    }
    const Real along = along_trial(at_end, product, trial.square);
    for (int i = 0; i < 3; ++i) {
      change[i][i] = K * trace + modulus * (d[i][i] - trace * (1.0 / 3.0)) + 2.0 * G * along * trial.deviator[i] -
                     2.0 * tau[i] * d[i][i];
      for (int j = 0; j < i; ++j) {
        const Real r = (trial.excess[i] - trial.excess[j]) / (2.0 + trial.excess[i] + trial.excess[j]);
        const Real ratio = logarithmic_ratio(r, Real(trial.deviator[i] - trial.deviator[j]));
        change[i][j] = (modulus * ratio - tau[i] - tau[j]) * d[i][j];
        change[j][i] = change[i][j];
      }
    }
    Real S[3][3];
    from_principal(trial.N, change, spatial);
    sandwich_lower(trial.stretch.inverse, spatial, S);
    for (int c = 0; c < 6; ++c) store(batch.stress_change + (6 * p + c) * n, S[voigt_row[c]][voigt_column[c]]);
  }
}

template <class Real>
static constexpr LawKernels j2_kernels() {
  return {finite_plastic_update<Real>, finite_plastic_tangent<Real>};
}
template <class Real>
static constexpr LawKernels johnson_cook_kernels() {
  return j2_kernels<Real>();
}

}  // namespace carom
