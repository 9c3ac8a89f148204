// The elastic constants of hourglass modes.
#pragma once

namespace carom {

/// Of stabilised cells, each times the part's coefficient of hourglass stiffness but nu.
struct ModeModuli {
  double G = 0.0, E = 0.0;
  double plate = 0.0;  ///< E / (1 - nu^2); E under plane stress
  double nu = 0.0;
};

}  // namespace carom
