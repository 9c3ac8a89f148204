// Von Mises plasticity over a number type: radial return at small strain and in logarithmic strains.
#pragma once

#include "material/hardening.hpp"
#include "material/linear_elastic_update.hpp"
#include "material/point_batch.hpp"
#include "material/radial_return.hpp"
#include "material/rate_hardening.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// The equivalent trial stress of a point together with its cell's hourglass modes: what the modes store in addition
/// counts as the deviator does, so that both return radially in one flow, the closest point in the norm of the stored
/// energy.
template <class Real>
[[gnu::always_inline]] static inline Real with_modes(const Real& trial, const double* mode_square, int p) {
  if (mode_square == nullptr) return trial;
  return square_root(Real(trial * trial + load<Real>(mode_square + p * lanes<Real>)));
}

/// Writes the variables and the plastic work that follows from them.
template <class Real, class Yield>
[[gnu::always_inline]] static inline void store_variables(const PlasticLaw<Yield>& law,
                                                          const RadialReturn<Real>& at_end, double* variables,
                                                          double* dissipation) {
  if (variables != nullptr)
    for (int v = 0; v < Yield::variables; ++v) store(variables + v * lanes<Real>, at_end.variables[v]);
  if (dissipation != nullptr) store(dissipation, law.yield.plastic_work(at_end.variables));
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
[[gnu::always_inline]] static inline SmallTrial<Real> small_trial(double G, const double* strain,
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
  trial.stress = G * square_root(Real(6.0 * square));
  return trial;
}

/// sigma = K tr(eps) 1 + 2 G dev(eps - eps_p), returned radially to the yield surface (Simo and Hughes, Computational
/// Inelasticity, box 3.1); stored energy K/2 tr^2 + G |dev|^2. parameters: const PlasticLaw<Yield>*.
template <class Real, class Yield>
static void small_plastic_update(const void* parameters, const PointBatch& batch) {
  const auto& law = *static_cast<const PlasticLaw<Yield>*>(parameters);
  const double G = law.lame.G, K = law.lame.lambda + 2.0 / 3.0 * G;
  constexpr int n = lanes<Real>;
  const int H = (6 + Yield::variables) * n;
  for (int p = 0; p < batch.points; ++p) {
    const double* history = batch.history == nullptr ? nullptr : batch.history + H * p;
    const SmallTrial<Real> trial = small_trial<Real>(G, batch.strain + 6 * p * n, history);
    double* yield_stress = batch.yield_stress == nullptr ? nullptr : batch.yield_stress + p * n;
    const RadialReturn<Real> at_end =
        radial_return(law, with_modes(trial.stress, batch.mode_square, p),
                      history == nullptr ? nullptr : history + 6 * n, batch.dt, batch.is_over, yield_stress);
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
    if (batch.wave_modulus != nullptr) store(batch.wave_modulus + p * n, Real(Real{} + (law.lame.lambda + 2.0 * G)));
  }
}

/// Changes of the deviatoric stress with those of a trial deviator d of Voigt or principal components, as the tensor's:
/// 2 G [share (change) + (slope - share) m (m : change)], m the direction of d; m : change = product, of weights w.
/// The consistent tangent of the radial return (Simo and Hughes, box 3.2). The modes' part of d is that of their trial
/// forces; its square is mode_square / 6 G^2.
template <class Real>
[[gnu::always_inline]] static inline Real along_trial(double G, const RadialReturn<Real>& at_end, Real product,
                                                      Real square, const TangentBatch& batch, int p) {
  constexpr int n = lanes<Real>;
  if (batch.mode_square != nullptr) {
    const double scale = 1.0 / (6.0 * G * G);
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

template <class Real, class Yield>
static void small_plastic_tangent(const void* parameters, const TangentBatch& batch) {
  const auto& law = *static_cast<const PlasticLaw<Yield>*>(parameters);
  const double G = law.lame.G, K = law.lame.lambda + 2.0 / 3.0 * G;
  constexpr int n = lanes<Real>;
  const int H = (6 + Yield::variables) * n;
  for (int p = 0; p < batch.points; ++p) {
    const double* history = batch.history == nullptr ? nullptr : batch.history + H * p;
    const SmallTrial<Real> trial = small_trial<Real>(G, batch.strain + 6 * p * n, history);
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
    const Real along = along_trial(G, at_end, product, square, batch, p);
    for (int c = 0; c < 6; ++c) {
      const Real deviator = c < 3 ? d[c] - trace * (1.0 / 3.0) : d[c];
      const Real change = 2.0 * G * (at_end.share * deviator + along * trial.deviator[c]);
      store(batch.stress_change + (6 * p + c) * n, Real(c < 3 ? K * trace + change : change));
    }
  }
}

template <class Real>
static constexpr LawKernels j2_small_strain_kernels() {
  return {small_plastic_update<Real, Hardening>, small_plastic_tangent<Real, Hardening>};
}
template <class Real>
static constexpr LawKernels j2_rate_small_strain_kernels() {
  return {small_plastic_update<Real, RateHardening>, small_plastic_tangent<Real, RateHardening>};
}

}  // namespace carom
