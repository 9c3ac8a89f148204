// Isotropic hardening: the yield stress as a function of the equivalent plastic strain.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "material/law.hpp"
#include "material/radial_return.hpp"
#include "math/elementary.hpp"

namespace carom {

/// sigma_y(alpha) = yield_stress + hardening_modulus alpha + (saturation_stress - yield_stress)(1 - exp(-rate alpha))
/// (E. Voce, J. Inst. Metals 74, 1948; with a linear part), or the polygon through given points, whose last stress
/// holds beyond. A Yield of PlasticLaw; what kernels call is inlined there (math/pack.hpp).
class Hardening {
 public:
  static constexpr int variables = 1;

  explicit Hardening(const Material& material);

  /// sigma_y(0)
  double elastic_limit() const { return points_ == nullptr ? yield_ : points_[0].stress; }

  template <class Real>
  struct Begin {
    Real stress, decay;  ///< decay: exp(-rate alpha) of Voce's hardening
  };
  template <class Real>
  [[gnu::always_inline]] inline Begin<Real> begin(const Real own[1]) const {
    const Real alpha = own[0], linear = yield_ + modulus_ * alpha;
    if (points_ != nullptr) {
      const Segment<Real> s = segment_at(alpha);
      return {s.stress + s.slope * (alpha - s.alpha), Real{}};
    }
    if (!(saturation_ > 0.0)) return {linear, Real{}};
    const Real change = exponential_less_one(Real(-rate_ * alpha));
    return {linear - saturation_ * change, 1.0 + change};
  }
  template <class Real>
  [[gnu::always_inline]] inline void flow(const Begin<Real>& begin, double three_G, const Real& trial, double,
                                          RadialReturn<Real>& end) const {
    const Real alpha = end.variables[0], excess = trial - begin.stress, zero{};
    if (points_ != nullptr) {
      // the segment on which the return ends: the curve rises, the stress falls
      const Segment<Real> s =
          segment(alpha, [&](const Point& p) { return Real(trial - three_G * (p.alpha - alpha) - p.stress); });
      const Real increment = (trial - s.stress - s.slope * (alpha - s.alpha)) / (three_G + s.slope);
      return end.flow(three_G, trial, excess, increment, s.slope);
    }
    if (!(saturation_ > 0.0))
      return end.flow(three_G, trial, excess, Real(excess * (1.0 / (three_G + modulus_))), Real(zero + modulus_));
    // What is left of the excess is convex and falls: Newton's method approaches its root from the left, and leaves
    // less than half of rate times the square of its step.
    const double steepest = saturation_ * rate_;
    Real x = zero, left = excess, slope = modulus_ + steepest * begin.decay;
    constexpr int most = 50;
    for (int i = 0; i < most; ++i) {
      const Real newton = left / (three_G + slope), step = newton > 0.0 ? newton : zero;
      x += step;
      if (!any_above(Real(0.5 * rate_ * step * step - 1e-16 * x), 0.0)) {
        slope -= rate_ * (slope - modulus_) * step;  // what is left out goes with the step's square
        break;
      }
      const Real fall = begin.decay * exponential_less_one(Real(-rate_ * x));
      left = excess - (three_G + modulus_) * x + saturation_ * fall;
      slope = modulus_ + steepest * (begin.decay + fall);
    }
    end.flow(three_G, trial, excess, x, slope);
  }
  /// Integral of sigma_y from 0 to alpha.
  template <class Real>
  [[gnu::always_inline]] inline Real plastic_work(const Real own[1]) const {
    const Real alpha = own[0];
    if (points_ != nullptr) {
      const Segment<Real> s = segment_at(alpha);
      const Real beyond = alpha - s.alpha;
      return s.work + (s.stress + 0.5 * s.slope * beyond) * beyond;
    }
    const Real linear = (yield_ + 0.5 * modulus_ * alpha) * alpha;
    if (!(saturation_ > 0.0)) return linear;
    return linear + saturation_ * (alpha + exponential_less_one(Real(-rate_ * alpha)) * (1.0 / rate_));
  }

 private:
  /// A corner of the polygon: the slope to its right, and the work up to it.
  struct Point {
    double alpha, stress, slope, work;
  };
  template <class Real>
  struct Segment {
    Real alpha, stress, slope, work;
  };

  /// The last segment of each lane that begins where `beyond` is positive, which falls along the curve and is positive
  /// up to alpha.
  template <class Real, class Beyond>
  [[gnu::always_inline]] inline Segment<Real> segment(const Real& alpha, const Beyond& beyond) const {
    double lane[lanes<Real>], least = std::numeric_limits<double>::infinity();
    store(lane, alpha);
    for (int l = 0; l < lanes<Real>; ++l) least = lane[l] < least ? lane[l] : least;
    const Point* p = first_segment(least);
    const Real zero{};
    Segment<Real> s{zero + p->alpha, zero + p->stress, zero + p->slope, zero + p->work};
    for (++p; p != points_ + size_; ++p) {
      const Real is_beyond = beyond(*p);
      if (!any_above(is_beyond, 0.0)) break;
      s.alpha = is_beyond > 0.0 ? zero + p->alpha : s.alpha;
      s.stress = is_beyond > 0.0 ? zero + p->stress : s.stress;
      s.slope = is_beyond > 0.0 ? zero + p->slope : s.slope;
      s.work = is_beyond > 0.0 ? zero + p->work : s.work;
    }
    return s;
  }
  template <class Real>
  [[gnu::always_inline]] inline Segment<Real> segment_at(const Real& alpha) const {
    return segment(alpha, [&](const Point& p) { return Real(alpha - p.alpha); });
  }
  /// The last point of the curve that is not right of alpha.
  const Point* first_segment(double alpha) const;

  double yield_ = 0.0, modulus_ = 0.0, saturation_ = 0.0, rate_ = 0.0;  ///< saturation_: above yield_
  std::shared_ptr<const std::vector<Point>> owner_;
  const Point* points_ = nullptr;
  std::ptrdiff_t size_ = 0;
};

/// The keys that it reads.
std::vector<LawParameter> hardening_parameters();
/// Rules between them.
std::optional<LawProblem> check_hardening(const Material& material);

}  // namespace carom
