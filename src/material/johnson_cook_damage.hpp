// Johnson and Cook's damage: what the user gives.
#pragma once

#include <optional>

namespace carom {

/// The damage of a point grows as d D = d alpha / eps_f, eps_f = [D1 + D2 exp(D3 eta)] [1 + D4 ln(max(rate /
/// reference_rate, 1))] [1 + D5 theta], alpha the equivalent plastic strain, eta the mean over the von Mises stress,
/// tension positive, theta as in Johnson and Cook's yield stress (G. R. Johnson and W. H. Cook, Eng. Fract. Mech. 21,
/// 1985).
struct JohnsonCookDamage {
  double D1 = 0.0, D2 = 0.0, D3 = 0.0, D4 = 0.0, D5 = 0.0;
  std::optional<double> reference_rate{};  ///< nothing: that of the law

  bool operator==(const JohnsonCookDamage&) const = default;
};

}  // namespace carom
