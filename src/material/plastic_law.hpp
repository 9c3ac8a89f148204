// Von Mises plasticity: what its kernels take.
#pragma once

#include "material/isotropic_elastic.hpp"

namespace carom {

/// How far a point yields in one step.
struct PlasticFlow {
  double stress = 0.0;  ///< equivalent stress at the end
  double slope = 0.0;   ///< d(stress) / d(equivalent plastic strain) at the end, all that follows from it included
};

/// A von Mises body of isotropic elasticity: its yield stress as a function of a few variables of its own, of which
/// the first is the equivalent plastic strain alpha. They are 0 at rest.
struct PlasticLaw {
  LameParameters lame;
  double elastic_limit = 0.0;  ///< equivalent stress below which nothing yields, whatever went before
  int variables = 1;           ///< at most 3
  /// The yield stress is elastic_limit + hardening alpha: the three functions below are not asked.
  bool is_linear = false;
  double hardening = 0.0;
  const void* parameters = nullptr;
  /// Radial return of the equivalent stress `trial` > 0 to the yield surface: trial - 3 G (change of alpha) is the
  /// yield stress at the end of the step of length dt. Changes the variables; false, and nothing changed, when nothing
  /// yields.
  bool (*flow)(const PlasticLaw&, double trial, double dt, double* variables, PlasticFlow& flow) = nullptr;
  /// The yield stress of slow flow, of the variables.
  double (*yield_stress)(const PlasticLaw&, const double* variables) = nullptr;
  /// All plastic work per volume since the start, of the variables.
  double (*plastic_work)(const PlasticLaw&, const double* variables) = nullptr;
};

}  // namespace carom
