// The stable step of explicit schemes, contact included.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "linalg/largest_eigenvalue.hpp"
#include "model/compatibility.hpp"
#include "schemes/system.hpp"

namespace carom {

/// Largest stable step of an explicit scheme with the given stability_limit L: L / omega_max of M^-1 (K + contact
/// stiffness with every row closed), with the lagged dampers of stops those of central differences scaled by L / 2:
///   h = L/2 (sqrt(d^2 + 4 omega^2) - d) / omega^2,  d = max damping / mass
/// (the roots of z^2 - (2 - omega^2 h^2 - d h) z + 1 - d h stay in the unit circle). Only the penalty adds stiffness:
/// exact enforcements fix what they hold, which lowers no frequency bound. Nodes without mass are held: with the
/// modified mass they follow statically, which is softer, so that the step is one for the condensed system as well.
struct StableStep {
  double omega_max_squared = 0.0;       ///< with contact
  double omega_max_squared_free = 0.0;  ///< of the solids alone
  double dt = 0.0;
  double dt_free = 0.0;  ///< without contact
};
/// At rest, in the reference position.
StableStep stable_step(const System& system, double limit = 2.0,
                       EnforcementKind enforcement = EnforcementKind::penalty);

/// The stable step through a run, as geometry and contact change: a few Lanczos iterations from the last vector.
class StableStepWatch {
 public:
  StableStepWatch(const System& system, double limit, EnforcementKind enforcement);

  /// Stable step at displacement u, every contact row that there is at u counted as closed; begin: where the
  /// last step began. The frequency is taken at the upper end of its error bound, which the iterations
  /// leave: a step on the safe side, as long as the body changes little between two calls. Costs ten actions of the
  /// tangent; the first call some more.
  double update(const State& begin, std::span<const double> u);
  /// False when springs act on rows that the last update did not count, since they were too far from touching to be
  /// there.
  bool knows(const ContactResponse& response) const;

 private:
  const System& system_;
  double limit_;
  EnforcementKind enforcement_;
  std::vector<double> vector_;
  std::vector<bool> known_;  ///< slots of the rows of the last update
};

}  // namespace carom
