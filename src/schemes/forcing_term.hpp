// The residual to which a step of an inexact Newton method solves its linear system.
#pragma once

#include <algorithm>
#include <cmath>

namespace carom {

/// Asks a linear solve for a residual of eta_k |r_k|, r_k that of the equations, so that no digits are bought of a step
/// that a change of contact or a curved force then makes worthless:
///   eta_k = | |r_k| - |r_k-1 + J s_k-1| | / |r_k-1|,
/// the share in which the last linear model erred (Eisenstat and Walker, SIAM J. Sci. Comput. 17, 1996, choice 1), at
/// most `most`. Where the model was exact, the next solve goes to the end.
class ForcingTerm {
 public:
  /// is_exact: the first model is known to be the equations themselves.
  explicit ForcingTerm(bool is_exact) : eta_(is_exact ? 0.0 : most) {}

  /// The residual that the next solve may leave: `wanted`, or a larger one that is enough for now. norm: |r_k|
  double next(double norm, double wanted) {
    if (last_ > 0.0) eta_ = std::min(most, std::abs(norm - left_) / last_);
    last_ = norm;
    constexpr double near = 30.0;  // less than two digits above what is wanted are not worth another iteration
    const double enough = eta_ * norm;
    return enough < near * wanted ? wanted : enough;
  }
  /// Takes the residual that the solve has left.
  void solved(double residual) { left_ = residual; }

 private:
  static constexpr double most = 1e-3;
  double eta_, last_ = 0.0, left_ = 0.0;
};

}  // namespace carom
