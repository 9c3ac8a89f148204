// Coefficients of artificial viscosity.
#pragma once

namespace carom {

/// Of the bulk, linear and quadratic (kernels/bulk_viscosity.hpp), and of the hourglass modes of one-point cells
/// (kernels/hourglass_flow.hpp).
struct Viscosity {
  double linear = 0.0, quadratic = 0.0, hourglass = 0.0;

  bool has_bulk() const { return linear > 0.0 || quadratic > 0.0; }
  bool is_any() const { return has_bulk() || hourglass > 0.0; }
};

}  // namespace carom
