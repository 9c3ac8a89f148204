// Swift's hardening over a number type.
#pragma once

#include "material/plastic_update.hpp"
#include "math/elementary.hpp"

namespace carom {

/// sigma_y(alpha) = yield (1 + alpha / pre_strain)^exponent (H. W. Swift, J. Mech. Phys. Solids 1, 1952). A Yield of
/// PlasticLaw, inlined into the kernels (math/pack.hpp); variables: alpha, and the largest d alpha / dt of all steps.
struct Swift {
  static constexpr int variables = 2;

  double yield = 0.0, pre_strain = 1.0, exponent = 0.0;

  template <class Real>
  struct Begin {
    Real stress;
  };
  template <class Real>
  [[gnu::always_inline]] inline Begin<Real> begin(const Real own[2]) const {
    return {stress(own[0])};
  }
  /// Newton's method for the increment x: what is left of the excess is convex and falls, so that its root is
  /// approached from the left, and a step leaves less than (1 - exponent) / 2 (pre_strain + alpha) times its square.
  template <class Real>
  [[gnu::always_inline]] inline void flow(const Begin<Real>& begin, double three_G, const Real& trial, double dt,
                                          RadialReturn<Real>& end) const {
    const Real alpha = end.variables[0], excess = trial - begin.stress, zero{};
    if (!any_above(excess, 0.0)) return;
    const Real base = pre_strain + alpha, rounding = trial * (1e-16 / three_G);
    const Real curvature = (0.5 * (1.0 - exponent)) / base;
    Real x = zero, reached = begin.stress;
    constexpr int most = 50;
    for (int i = 0; i < most; ++i) {
      const Real slope = exponent * reached / (base + x);
      const Real newton = (trial - three_G * x - reached) / (three_G + slope), step = newton > 0.0 ? newton : zero;
      x += step;
      reached = stress(Real(alpha + x));
      if (!any_above(Real(curvature * step * step - 1e-16 * x - rounding), 0.0)) break;
    }
    end.flow(three_G, trial, excess, x, Real(exponent * reached / (base + x)));
    const Real rate = dt > 0.0 ? x * (1.0 / dt) : zero, before = end.variables[1];
    end.variables[1] = rate > before ? rate : before;
  }
  /// Integral of sigma_y from 0 to alpha.
  template <class Real>
  [[gnu::always_inline]] inline Real plastic_work(const Real own[2]) const {
    Real log, rest;
    logarithm(Real(own[0] * (1.0 / pre_strain)), log, rest);
    return (yield * pre_strain / (exponent + 1.0)) * exponential_less_one(Real((exponent + 1.0) * log));
  }

 private:
  template <class Real>
  [[gnu::always_inline]] inline Real stress(const Real& alpha) const {
    return yield * power(Real(1.0 + alpha * (1.0 / pre_strain)), exponent);
  }
};

template <class Real>
static constexpr LawKernels swift_small_strain_kernels() {
  return {small_plastic_update<Real, Swift>, small_plastic_tangent<Real, Swift>};
}

}  // namespace carom
