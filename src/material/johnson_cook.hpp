// Johnson and Cook's yield stress over a number type.
#pragma once

#include "material/radial_return.hpp"
#include "math/elementary.hpp"

namespace carom {

/// sigma_y = (A + B alpha^n)(1 + C ln(max(rate / reference_rate, 1)))(1 - theta^m). A Yield of PlasticLaw, inlined
/// into the kernels (math/pack.hpp); variables: alpha, the plastic work, and the rise of the temperature from it.
struct JohnsonCook {
  static constexpr int variables = 3;

  double A = 0.0, B = 0.0, n = 0.0, C = 0.0, m = 0.0, reference_rate = 0.0;
  double reference_temperature = 0.0, melting_temperature = 0.0, initial_temperature = 0.0;
  double heating = 0.0;  ///< temperature per plastic work, taylor_quinney / (rho specific_heat)

  template <class Real>
  struct Begin {
    Real stress, hardening, softening;  ///< B alpha^n and 1 - theta^m
  };
  template <class Real>
  [[gnu::always_inline]] inline Begin<Real> begin(const Real own[3]) const {
    const Real hardening = B * power_from_0(own[0], n), soft = softening(own[1]);
    return {soft * (A + hardening), hardening, soft};
  }
  template <class Real>
  [[gnu::always_inline]] inline Real plastic_work(const Real own[3]) const {
    return own[1];
  }

  /// The root x > 0 of trial - 3 G x = yield stress at alpha + x, the rate x / dt and the temperature of the beginning
  /// of the step, by Newton's method where it stays between what is known to be on both sides, else by halving; from
  /// rest, where the slope is infinite, by thousandths, since Newton's method comes from the left without overshooting.
  template <class Real>
  [[gnu::always_inline]] inline void flow(const Begin<Real>& begin, double three_G, const Real& trial, double dt,
                                          RadialReturn<Real>& end) const {
    const Real zero{}, one = zero + 1.0, alpha = end.variables[0], soft = begin.softening;
    const Real excess = trial - begin.stress;
    if (!any_above(excess, 0.0)) return;
    Real low = zero, high = excess * (1.0 / three_G), is_open = excess > 0.0 ? one : zero;
    const Step<Real> step = step_of(alpha, high, dt);
    Real x = start(begin, three_G, alpha, excess, step.slow);
    constexpr int most = 200;
    for (int i = 0; i < most; ++i) {
      const End<Real> y = at(begin, alpha, step, x);
      const Real left = trial - three_G * x - soft * y.stress, change = left / (three_G + soft * y.slope);
      low = left > 0.0 ? x : low;
      high = left > 0.0 ? high : x;
      const Real newton = x + change, size = change > 0.0 ? change : -change, rest = left > 0.0 ? left : -left;
      // Newton's method leaves the square of the last step, but where the rate begins to count between both.
      const Real near = (x - step.slow) * (newton - step.slow) > 0.0 ? 1e-8 * x : 1e-15 * x;
      const Real is_far = size > near ? (rest > 4e-16 * trial ? one : zero) : zero;  // the rounding of what is left
      const Real between = low > 0.0 ? 0.5 * (low + high) : 1e-3 * high;
      const Real within = newton > low ? (newton < high ? newton : between) : between;
      x = is_open > 0.0 ? (is_far > 0.0 ? within : newton) : x;
      is_open = is_far > 0.0 ? is_open : zero;
      if (!any_above(is_open, 0.0)) break;
    }
    end.flow(three_G, trial, excess, x, Real(soft * at(begin, alpha, step, x).slope));
    const Real work = end.variables[1] + end.share * trial * x;
    end.variables[1] = excess > 0.0 ? work : end.variables[1];
    end.variables[2] = heating * end.variables[1];
  }

 private:
  /// The yield stress at the end of a step without what softens, and its slope over the change of alpha.
  template <class Real>
  struct End {
    Real stress, slope;
  };
  /// What all x of a step share.
  template <class Real>
  struct Step {
    double slow;    ///< the increment up to which there is no influence of the rate; 0: there is none at all
    bool is_small;  ///< against alpha
    Real inverse;   ///< 1 / alpha
  };
  static constexpr int binomial_terms = 8;
  static constexpr double small_step = 0.01;  ///< of which that many terms leave 1e-17

  template <class Real>
  [[gnu::always_inline]] inline Step<Real> step_of(const Real& alpha, const Real& high, double dt) const {
    return {C > 0.0 ? reference_rate * dt : 0.0, !any_above(Real(high - small_step * alpha), 0.0), 1.0 / alpha};
  }

  /// x^n, n > 0, of x >= 0.
  template <class Real>
  [[gnu::always_inline]] static inline Real power_from_0(const Real& x, double n) {
    constexpr double least = 1e-300;
    const Real zero{};
    if (n == 1.0) return x;
    return x > least ? power(Real(x > least ? x : zero + 1.0), n) : zero;
  }
  /// 1 - theta^m
  template <class Real>
  [[gnu::always_inline]] inline Real softening(const Real& plastic_work) const {
    const Real zero{}, one = zero + 1.0;
    const Real T = (initial_temperature - reference_temperature + heating * plastic_work) *
                   (1.0 / (melting_temperature - reference_temperature));
    return 1.0 - power_from_0(Real(T > 0.0 ? (T < 1.0 ? T : one) : zero), m);
  }
  /// After a change x > 0 of alpha.
  template <class Real>
  [[gnu::always_inline]] inline End<Real> at(const Begin<Real>& begin, const Real& alpha, const Step<Real>& step,
                                             const Real& x) const {
    const Real zero{}, sum = alpha + x;
    Real hardening;
    if (step.is_small) {  // (alpha + x)^n = alpha^n (1 + x / alpha)^n, the binomial series
      double term[binomial_terms] = {1.0};
      for (int k = 1; k < binomial_terms; ++k) term[k] = term[k - 1] * (n - (k - 1)) / k;
      hardening = begin.hardening * elementary::polynomial(term, Real(x * step.inverse));
    } else {
      hardening = B * power(sum, n);
    }
    const Real strain = A + hardening, strain_slope = n * hardening / sum;
    if (!(step.slow > 0.0)) return {strain, strain_slope};
    const Real rate = 1.0 + C * natural_logarithm(Real(x > step.slow ? x * (1.0 / step.slow) : zero + 1.0));
    return {strain * rate, strain_slope * rate + (x > step.slow ? strain * C / x : zero)};
  }
  /// About the root x: with a the slope of what is linear in it, a x + b ln(x / slow) = excess, b = C times the yield
  /// stress of slow flow, has the root b/a w with w + ln(w) = excess / b + ln(a slow / b) = L.
  template <class Real>
  [[gnu::always_inline]] inline Real start(const Begin<Real>& begin, double three_G, const Real& alpha,
                                           const Real& excess, double slow) const {
    const Real zero{}, one = zero + 1.0, sum = alpha + excess * (1.0 / three_G);
    const Real a = three_G + begin.softening * n * begin.hardening / sum, linear = excess / a;
    if (!(slow > 0.0)) return linear;
    const Real b = begin.stress > 0.0 ? C * begin.stress : zero + three_G, ratio = a / b;
    const Real L = excess / b + natural_logarithm(Real(ratio * slow));
    const Real small = exponential(Real(L < 1.0 ? L : one)), large = L * L / (1.0 + L);
    const Real fast = (L < 1.0 ? small / (1.0 + small) : large) / ratio;
    return begin.stress > 0.0 ? (fast > slow ? (fast < linear ? fast : linear) : linear) : linear;
  }
};

}  // namespace carom
