// The scheme of a case, its enforcement and its numbers.
#pragma once

#include "enforcement/implicit_settings.hpp"

namespace carom {

struct SchemeSettings {
  SchemeKind kind = SchemeKind::newmark;
  SchemeParameters parameters = traits(kind).parameters;
  EnforcementKind enforcement = EnforcementKind::penalty;
  int max_iterations = 50;    ///< of the contact state within an implicit step
  double penetration = 1e-3;  ///< augmented_lagrangian: largest penetration, relative to the smallest cell
  SolverKind solver = SolverKind::automatic;

  ImplicitSettings implicit() const { return {enforcement, max_iterations, penetration, solver}; }
};

}  // namespace carom
