// Von Mises plasticity over a number type: radial return at small strain and in logarithmic strains.
#pragma once

#include "material/linear_elastic_update.hpp"
#include "material/logarithm.hpp"
#include "material/plastic_law.hpp"
#include "material/point_batch.hpp"
#include "material/principal.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

inline constexpr int most_plastic_variables = 3;

/// The radial return of the lanes of one point. The deviatoric stress is `share` of the trial one, which is reached
/// elastically; its changes follow those of the trial one, `share` times across and `slope` times along its direction.
template <class Real>
struct RadialReturn {
  Real share, slope;
  Real variables[most_plastic_variables];
};

/// The return of linear hardening, in closed form for all lanes (Simo and Hughes, Computational Inelasticity, box 3.1).
template <class Real>
[[gnu::always_inline]] static inline void linear_return(const PlasticLaw& law, const Real& trial,
                                                        RadialReturn<Real>& result) {
  const double three_G = 3.0 * law.lame.G, both = three_G + law.hardening;
  const Real excess = trial - (law.elastic_limit + law.hardening * result.variables[0]);
  const Real zero = Real{}, one = zero + 1.0;
  const Real increment = excess > 0.0 ? excess * (1.0 / both) : zero;
  result.share = excess > 0.0 ? 1.0 - three_G * increment / trial : one;
  result.slope = excess > 0.0 ? zero + law.hardening / both : one;
  result.variables[0] += increment;
}

/// trial: equivalent trial stress, which is that of the end once the step is over (PointBatch::is_over).
template <class Real>
[[gnu::always_inline]] static inline RadialReturn<Real> radial_return(const PlasticLaw& law, const Real& trial,
                                                                      const double* variables, double dt,
                                                                      bool is_over = false) {
  constexpr int n = lanes<Real>;
  const int count = law.variables;
  RadialReturn<Real> result{Real{} + 1.0, Real{} + 1.0, {}};
  for (int v = 0; v < count; ++v) result.variables[v] = variables == nullptr ? Real{} : load<Real>(variables + v * n);
  if (is_over) return result;
  if (law.is_linear) {
    linear_return(law, trial, result);
    return result;
  }
  double stress[n], share[n], slope[n], values[most_plastic_variables * n] = {};
  store(stress, trial);
  bool may_yield = false;
  for (int l = 0; l < n; ++l) may_yield = may_yield || stress[l] > law.elastic_limit;
  if (!may_yield) return result;
  for (int v = 0; v < count; ++v) store(values + v * n, result.variables[v]);
  const double three_G = 3.0 * law.lame.G;
  for (int l = 0; l < n; ++l) {
    share[l] = 1.0;
    slope[l] = 1.0;
    if (!(stress[l] > law.elastic_limit)) continue;
    double own[most_plastic_variables] = {};
    for (int v = 0; v < count; ++v) own[v] = values[v * n + l];
    PlasticFlow flow;
    if (!law.flow(law, stress[l], dt, own, flow)) continue;
    for (int v = 0; v < count; ++v) values[v * n + l] = own[v];
    share[l] = flow.stress / stress[l];
    slope[l] = flow.slope / (three_G + flow.slope);
  }
  result.share = load<Real>(share);
  result.slope = load<Real>(slope);
  for (int v = 0; v < count; ++v) result.variables[v] = load<Real>(values + v * n);
  return result;
}

/// The equivalent trial stress of a point together with its cell's hourglass modes: what the modes store in addition
/// counts as the deviator does, so that both return radially in one flow, the closest point in the norm of the stored
/// energy.
template <class Real>
[[gnu::always_inline]] static inline Real with_modes(const Real& trial, const double* mode_square, int p) {
  if (mode_square == nullptr) return trial;
  return square_root(Real(trial * trial + load<Real>(mode_square + p * lanes<Real>)));
}

/// Writes the variables and the plastic work that follows from them.
template <class Real>
[[gnu::always_inline]] static inline void store_variables(const PlasticLaw& law, const RadialReturn<Real>& at_end,
                                                          double* variables, double* dissipation) {
  constexpr int n = lanes<Real>;
  if (variables != nullptr)
    for (int v = 0; v < law.variables; ++v) store(variables + v * n, at_end.variables[v]);
  if (dissipation == nullptr) return;
  if (law.is_linear) {
    const Real alpha = at_end.variables[0];
    store(dissipation, Real((law.elastic_limit + 0.5 * law.hardening * alpha) * alpha));
    return;
  }
  double values[most_plastic_variables * n] = {};
  for (int v = 0; v < law.variables; ++v) store(values + v * n, at_end.variables[v]);
  for (int l = 0; l < n; ++l) {
    double own[most_plastic_variables] = {};
    for (int v = 0; v < law.variables; ++v) own[v] = values[v * n + l];
    dissipation[l] = own[0] > 0.0 ? law.plastic_work(law, own) : 0.0;
  }
}

/// Writes the yield stress of the beginning of the step.
template <int n>
static void store_yield_stress(const PlasticLaw& law, const double* variables, double* yield_stress) {
  for (int l = 0; law.is_linear && l < n; ++l)
    yield_stress[l] = law.elastic_limit + (variables == nullptr ? 0.0 : law.hardening * variables[l]);
  if (law.is_linear) return;
  for (int l = 0; l < n; ++l) {
    double own[most_plastic_variables] = {};
    for (int v = 0; v < law.variables && variables != nullptr; ++v) own[v] = variables[v * n + l];
    yield_stress[l] = law.yield_stress(law, own);
  }
}

/// Takes a third of the trace from the first three components, by their differences: no pressure is left in them,
/// however large it is.
template <class Real>
[[gnu::always_inline]] static inline void make_deviator(Real* e) {
  const Real xy = e[0] - e[1], yz = e[1] - e[2], zx = e[2] - e[0];
  e[0] = (xy - zx) * (1.0 / 3.0);
  e[1] = (yz - xy) * (1.0 / 3.0);
  e[2] = (zx - yz) * (1.0 / 3.0);
}

/// History of small strain: plastic strain (6, the tensor's components), then the law's variables.
template <class Real>
struct SmallTrial {
  Real deviator[6];  ///< of the elastic trial strain, as the tensor's components
  Real trace, stress;
};

template <class Real>
[[gnu::always_inline]] static inline SmallTrial<Real> small_trial(const PlasticLaw& law, const double* strain,
                                                                  const double* history) {
  constexpr int n = lanes<Real>;
  SmallTrial<Real> trial;
  Real e[6];
  for (int c = 0; c < 6; ++c) {
    e[c] = load<Real>(strain + c * n);
    if (history != nullptr) e[c] -= (c < 3 ? 1.0 : 2.0) * load<Real>(history + c * n);
  }
  trial.trace = e[0] + e[1] + e[2];
  for (int c = 0; c < 3; ++c) trial.deviator[c] = e[c];
  make_deviator(trial.deviator);
  Real square = Real{};
  for (int c = 3; c < 6; ++c) trial.deviator[c] = 0.5 * e[c];
  for (int c = 0; c < 6; ++c) square += (c < 3 ? 1.0 : 2.0) * trial.deviator[c] * trial.deviator[c];
  trial.stress = law.lame.G * square_root(Real(6.0 * square));
  return trial;
}

/// sigma = K tr(eps) 1 + 2 G dev(eps - eps_p), returned radially to the yield surface (Simo and Hughes, Computational
/// Inelasticity, box 3.1); stored energy K/2 tr^2 + G |dev|^2. parameters: const PlasticLaw*.
template <class Real>
static void small_plastic_update(const void* parameters, const PointBatch& batch) {
  const auto& law = *static_cast<const PlasticLaw*>(parameters);
  const double G = law.lame.G, K = law.lame.lambda + 2.0 / 3.0 * G;
  constexpr int n = lanes<Real>;
  const int H = (6 + law.variables) * n;
  for (int p = 0; p < batch.points; ++p) {
    const double* history = batch.history == nullptr ? nullptr : batch.history + H * p;
    const SmallTrial<Real> trial = small_trial<Real>(law, batch.strain + 6 * p * n, history);
    const RadialReturn<Real> at_end =
        radial_return(law, with_modes(trial.stress, batch.mode_square, p),
                      history == nullptr ? nullptr : history + 6 * n, batch.dt, batch.is_over);
    if (batch.share != nullptr) store(batch.share + p * n, at_end.share);
    const Real pressure_part = K * trial.trace, modulus = 2.0 * G * at_end.share;
    double* stress = batch.stress + 6 * p * n;
    for (int c = 0; c < 3; ++c) store(stress + c * n, Real(pressure_part + modulus * trial.deviator[c]));
    for (int c = 3; c < 6; ++c) store(stress + c * n, Real(modulus * trial.deviator[c]));
    if (batch.energy != nullptr) {
      const Real equivalent = at_end.share * trial.stress;
      store(batch.energy + p * n,
            Real(0.5 * pressure_part * trial.trace + equivalent * equivalent * (1.0 / (6.0 * G))));
    }
    if (batch.new_history != nullptr) {
      double* changed = batch.new_history + H * p;
      for (int c = 0; c < 6; ++c) {
        const Real before = history == nullptr ? Real{} : load<Real>(history + c * n);
        store(changed + c * n, Real(before + (1.0 - at_end.share) * trial.deviator[c]));
      }
    }
    store_variables(law, at_end, batch.new_history == nullptr ? nullptr : batch.new_history + H * p + 6 * n,
                    batch.dissipation == nullptr ? nullptr : batch.dissipation + p * n);
    if (batch.yield_stress != nullptr)
      store_yield_stress<n>(law, history == nullptr ? nullptr : history + 6 * n, batch.yield_stress + p * n);
    if (batch.wave_modulus != nullptr) store(batch.wave_modulus + p * n, Real(Real{} + (law.lame.lambda + 2.0 * G)));
  }
}

/// Changes of the deviatoric stress with those of a trial deviator d of Voigt or principal components, as the tensor's:
/// 2 G [share (change) + (slope - share) m (m : change)], m the direction of d; m : change = product, of weights w.
/// The consistent tangent of the radial return (Simo and Hughes, box 3.2). The modes' part of d is that of their trial
/// forces; its square is mode_square / 6 G^2.
template <class Real>
[[gnu::always_inline]] static inline Real along_trial(const PlasticLaw& law, const RadialReturn<Real>& at_end,
                                                      Real product, Real square, const TangentBatch& batch, int p) {
  constexpr int n = lanes<Real>;
  if (batch.mode_square != nullptr) {
    const double scale = 1.0 / (6.0 * law.lame.G * law.lame.G);
    square += scale * load<Real>(batch.mode_square + p * n);
    product += scale * load<Real>(batch.half_change + p * n);
  }
  const Real zero = Real{}, one = zero + 1.0;
  const Real along = square > 0.0 ? (at_end.slope - at_end.share) * product / (square > 0.0 ? square : one) : zero;
  if (batch.share != nullptr) {
    store(batch.share + p * n, at_end.share);
    store(batch.along + p * n, along);
  }
  return along;
}

template <class Real>
static void small_plastic_tangent(const void* parameters, const TangentBatch& batch) {
  const auto& law = *static_cast<const PlasticLaw*>(parameters);
  const double G = law.lame.G, K = law.lame.lambda + 2.0 / 3.0 * G;
  constexpr int n = lanes<Real>;
  const int H = (6 + law.variables) * n;
  for (int p = 0; p < batch.points; ++p) {
    const double* history = batch.history == nullptr ? nullptr : batch.history + H * p;
    const SmallTrial<Real> trial = small_trial<Real>(law, batch.strain + 6 * p * n, history);
    const RadialReturn<Real> at_end = radial_return(law, with_modes(trial.stress, batch.mode_square, p),
                                                    history == nullptr ? nullptr : history + 6 * n, batch.dt);
    Real d[6], square = Real{}, product = Real{};
    for (int c = 0; c < 6; ++c) d[c] = (c < 3 ? 1.0 : 0.5) * load<Real>(batch.strain_change + (6 * p + c) * n);
    const Real trace = d[0] + d[1] + d[2];
    for (int c = 0; c < 6; ++c) {
      const double weight = c < 3 ? 1.0 : 2.0;
      square += weight * trial.deviator[c] * trial.deviator[c];
      product += weight * trial.deviator[c] * d[c];
    }
    const Real along = along_trial(law, at_end, product, square, batch, p);
    for (int c = 0; c < 6; ++c) {
      const Real deviator = c < 3 ? d[c] - trace * (1.0 / 3.0) : d[c];
      const Real change = 2.0 * G * (at_end.share * deviator + along * trial.deviator[c]);
      store(batch.stress_change + (6 * p + c) * n, Real(c < 3 ? K * trace + change : change));
    }
  }
}

template <class Real>
static constexpr LawKernels j2_small_strain_kernels() {
  return {small_plastic_update<Real>, small_plastic_tangent<Real>};
}

}  // namespace carom
