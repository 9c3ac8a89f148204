// The settings of every implicit scheme beside its own parameters.
#pragma once

#include "model/compatibility.hpp"
#include "system/effective_solver.hpp"

namespace carom {

struct ImplicitSettings {
  EnforcementKind enforcement = EnforcementKind::penalty;
  int max_iterations = 50;    ///< of Newton's method within a stage; of the multipliers of the augmented Lagrangian
  double penetration = 1e-3;  ///< augmented_lagrangian: largest penetration, relative to the smallest cell
  SolverKind solver = SolverKind::automatic;
};

}  // namespace carom
