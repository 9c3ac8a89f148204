// The radial return of von Mises plasticity over a number type.
#pragma once

#include "material/plastic_law.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// The radial return of the lanes of one point. The deviatoric stress is `share` of the trial one, which is reached
/// elastically; its changes follow those of the trial one, `share` times across and `slope` times along its direction.
template <class Real>
struct RadialReturn {
  Real share, slope;
  Real variables[most_plastic_variables];

  /// Where the equivalent stress `trial` exceeds the yield stress, by `excess` > 0, alpha changes by `increment`, at
  /// the end of which the yield stress has the slope `hardening` over alpha, all that follows from it included.
  [[gnu::always_inline]] inline void flow(double three_G, const Real& trial, const Real& excess, const Real& increment,
                                          const Real& hardening) {
    const Real zero{}, one = zero + 1.0;
    const Real left = 1.0 - three_G * increment / trial;  // of molten metal not a round-off below 0
    share = excess > 0.0 ? (left > 0.0 ? left : zero) : one;
    slope = excess > 0.0 ? hardening / (three_G + hardening) : one;
    variables[0] += excess > 0.0 ? increment : zero;
  }
};

/// trial: equivalent trial stress, which is that of the end once the step is over (PointBatch::is_over). Writes the
/// yield stress of the beginning of the step unless null.
template <class Real, class Yield>
[[gnu::always_inline]] static inline RadialReturn<Real> radial_return(const PlasticLaw<Yield>& law, const Real& trial,
                                                                      const double* variables, double dt,
                                                                      bool is_over = false,
                                                                      double* yield_stress = nullptr) {
  RadialReturn<Real> result{Real{} + 1.0, Real{} + 1.0, {}};
  for (int v = 0; v < Yield::variables; ++v)
    result.variables[v] = variables == nullptr ? Real{} : load<Real>(variables + v * lanes<Real>);
  const bool may_yield = !is_over && any_above(trial, law.elastic_limit);
  if (!may_yield && yield_stress == nullptr) return result;
  const auto begin = law.yield.begin(result.variables);
  if (yield_stress != nullptr) store(yield_stress, begin.stress);
  if (may_yield) law.yield.flow(begin, 3.0 * law.lame.G, trial, dt, result);
  return result;
}

}  // namespace carom
