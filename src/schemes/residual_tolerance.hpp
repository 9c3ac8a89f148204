// How far a step may be from equilibrium.
#pragma once

#include "base/types.hpp"

namespace carom {

/// What a residual may leave unbooked.
struct ResidualTolerance {
  double work = 0.0;            ///< energy
  double resultant = infinity;  ///< force on all bodies together: momentum over time

  friend ResidualTolerance operator*(double share, const ResidualTolerance& whole) {
    return {share * whole.work, share * whole.resultant};
  }
};

}  // namespace carom
