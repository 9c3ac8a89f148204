// Isotropic hardening that depends on the rate: the yield stress by curves over the plastic strain, one for each rate.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "material/law.hpp"
#include "material/radial_return.hpp"

namespace carom {

/// sigma_y(alpha, d alpha / dt): polygons over alpha, linear in the rate between two of them and constant outside. A
/// Yield of PlasticLaw; variables: alpha and the plastic work.
class RateHardening {
 public:
  static constexpr int variables = 2;

  explicit RateHardening(const Material& material);

  /// Of slow flow at alpha = 0.
  double elastic_limit() const { return at(0.0, 0.0).stress; }

  template <class Real>
  struct Begin {
    Real stress;
  };
  template <class Real>
  [[gnu::always_inline]] inline Begin<Real> begin(const Real own[2]) const {
    double lane[lanes<Real>];
    store(lane, own[0]);
    for (int l = 0; l < lanes<Real>; ++l) lane[l] = at(lane[l], 0.0).stress;
    return {load<Real>(lane)};
  }
  template <class Real>
  [[gnu::always_inline]] inline void flow(const Begin<Real>& begin, double three_G, const Real& trial, double dt,
                                          RadialReturn<Real>& end) const {
    const Real excess = trial - begin.stress;
    if (!any_above(excess, 0.0)) return;
    double alpha[lanes<Real>], stress[lanes<Real>], increment[lanes<Real>], slope[lanes<Real>];
    store(alpha, end.variables[0]);
    store(stress, trial);
    for (int l = 0; l < lanes<Real>; ++l) {
      const Return found = returned(alpha[l], stress[l], three_G, dt);
      increment[l] = found.increment, slope[l] = found.slope;
    }
    const Real x = load<Real>(increment);
    end.flow(three_G, trial, excess, x, load<Real>(slope));
    const Real work = end.variables[1] + end.share * trial * x;
    end.variables[1] = excess > 0.0 ? work : end.variables[1];
  }
  template <class Real>
  [[gnu::always_inline]] inline Real plastic_work(const Real own[2]) const {
    return own[1];
  }

 private:
  struct Value {
    double stress, over_alpha, over_rate;  ///< and its slopes
  };
  struct Return {
    double increment = 0.0, slope = 0.0;  ///< of alpha; of the yield stress over it, that of the rate included
  };
  struct Curve {
    double rate = 0.0;
    std::vector<std::array<double, 2>> points;
  };
  Value at(double alpha, double rate) const;
  /// The root x > 0 of trial - 3 G x = yield stress at alpha + x and the rate x / dt, both of the end of the step; none
  /// where the trial stress is below the yield stress of slow flow.
  Return returned(double alpha, double trial, double three_G, double dt) const;

  std::shared_ptr<const std::vector<Curve>> curves_;
};

/// Rules between the rates and the table.
std::optional<LawProblem> check_rate_hardening(const Material& material);

}  // namespace carom
