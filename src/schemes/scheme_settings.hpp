// What a case says about its scheme: the parameters of all schemes, each read by those that have it.
#pragma once

#include "model/compatibility.hpp"
#include "system/effective_solver.hpp"

namespace carom {

struct SchemeSettings {
  SchemeKind kind = SchemeKind::newmark;
  EnforcementKind enforcement = EnforcementKind::penalty;
  double beta = 0.25, gamma = 0.5;  ///< newmark; gamma also contact_stabilized_newmark
  double alpha = -0.05;             ///< hht (-1/3 ... 0); wbz (-1 ... 0)
  double rho_inf = 0.8;             ///< generalized_alpha, nonsmooth_generalized_alpha, hulbert_chung: spectral radius
  double theta = 0.5;               ///< moreau_jean (1/2 ... 1)
  double phi = 1.033;               ///< tchamwa_wielgosz
  double p = 0.54;                  ///< noh_bathe: first sub-step over the step
  int max_iterations = 50;          ///< of the contact state within an implicit step
  double penetration = 1e-3;        ///< augmented_lagrangian: largest penetration, relative to the smallest cell
  SolverKind solver = SolverKind::automatic;
};

}  // namespace carom
