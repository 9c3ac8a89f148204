// Isotropic linear elasticity at small strain.
#pragma once

namespace carom {

/// sigma = lambda tr(eps) 1 + 2 mu eps (Hooke). Units: E stress, rho mass per volume, nu none.
struct LinearElastic {
  double E = 0.0;
  double nu = 0.0;
  double rho = 0.0;

  /// First Lame parameter, E nu / ((1 + nu)(1 - 2 nu)).
  double lame_lambda() const { return E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)); }
  /// Shear modulus, E / (2 (1 + nu)).
  double shear_modulus() const { return E / (2.0 * (1.0 + nu)); }
  /// P-wave modulus, lambda + 2 G.
  double p_wave_modulus() const { return lame_lambda() + 2.0 * shear_modulus(); }
};

}  // namespace carom
