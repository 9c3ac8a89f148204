// The stable step of explicit schemes, contact included.
#pragma once

#include "schemes/system.hpp"

namespace carom {

/// Largest stable step of central differences on this system: 2 / omega_max of M^-1 (K + contact stiffness with every
/// row closed), with the lagged dampers of stops:
///   h = (sqrt(d^2 + 4 omega^2) - d) / omega^2,  d = max damping / mass
/// (the roots of z^2 - (2 - omega^2 h^2 - d h) z + 1 - d h stay in the unit circle).
struct StableStep {
  double omega_max_squared = 0.0;       ///< with contact
  double omega_max_squared_free = 0.0;  ///< of the solids alone
  double dt = 0.0;
  double dt_free = 0.0;  ///< without contact
};
StableStep stable_step(const System& system);

}  // namespace carom
