// Isotropic hardening: the yield stress as a function of the equivalent plastic strain.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "material/law.hpp"

namespace carom {

/// sigma_y(alpha) = yield_stress + hardening_modulus alpha + (saturation_stress - yield_stress)(1 - exp(-rate alpha))
/// (E. Voce, J. Inst. Metals 74, 1948; with a linear part), or the polygon through given points, whose last stress
/// holds beyond.
class Hardening {
 public:
  explicit Hardening(const Material& material);

  /// sigma_y(alpha), and its slope to the right of alpha.
  double stress(double alpha) const;
  double slope(double alpha) const;
  /// Integral of sigma_y from 0 to alpha.
  double work(double alpha) const;
  /// sigma_y = yield_stress + modulus alpha, and nothing else.
  bool is_linear() const { return curve_.empty() && !(saturation_ > 0.0); }
  double modulus() const { return modulus_; }
  /// The root x of trial - three_G x = sigma_y(alpha + x); trial > sigma_y(alpha).
  double increment(double trial, double three_G, double alpha) const;

 private:
  std::size_t segment(double alpha) const;

  double yield_ = 0.0, modulus_ = 0.0, saturation_ = 0.0, rate_ = 0.0;  ///< saturation_: above yield_
  std::vector<std::array<double, 2>> curve_;
  std::vector<double> work_;  ///< at the points of the curve
};

/// The keys that it reads.
std::vector<LawParameter> hardening_parameters();
/// Rules between them.
std::optional<LawProblem> check_hardening(const Material& material);

}  // namespace carom
