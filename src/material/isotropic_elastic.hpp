// Parameters of the isotropic elastic laws.
#pragma once

namespace carom {

/// First Lame parameter lambda and shear modulus G (stress): what the updates of the isotropic laws take.
struct LameParameters {
  double lambda = 0.0;
  double G = 0.0;
};

/// Units: E stress, rho mass per (reference) volume, nu none.
struct IsotropicElastic {
  double E = 0.0;
  double nu = 0.0;
  double rho = 0.0;

  /// First Lame parameter, E nu / ((1 + nu)(1 - 2 nu)).
  double lame_lambda() const { return E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)); }
  /// Shear modulus, E / (2 (1 + nu)).
  double shear_modulus() const { return E / (2.0 * (1.0 + nu)); }
  LameParameters lame() const { return {lame_lambda(), shear_modulus()}; }
  /// P-wave modulus, lambda + 2 G.
  double p_wave_modulus() const { return lame_lambda() + 2.0 * shear_modulus(); }
};

/// Small strain: sigma = lambda tr(eps) 1 + 2 G eps (Hooke).
struct LinearElastic : IsotropicElastic {};

/// Finite rotations, moderate strains: S = lambda tr(E) 1 + 2 G E, E = (F^T F - 1) / 2 the Green-Lagrange strain
/// (Belytschko, Liu, Moran and Elkhodary, Nonlinear Finite Elements, 2nd ed., eq. 5.4.51).
struct StVenantKirchhoff : IsotropicElastic {};

/// Finite strains: W = G/2 (tr C - 3) - G ln J + lambda/2 (ln J)^2, S = G (1 - C^-1) + lambda ln J C^-1
/// (Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed., eqs. 6.27 and 6.28).
struct NeoHookean : IsotropicElastic {};

}  // namespace carom
