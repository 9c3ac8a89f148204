// How large a step explicit schemes take, in units of 1 / omega_max.
#pragma once

#include "schemes/scheme_settings.hpp"

namespace carom {

/// Largest omega h at which the scheme is stable on an undamped oscillator; infinity for implicit schemes.
/// Central differences, CD-Lagrange, forward increments, modified mass: 2. Tchamwa-Wielgosz: 2 / sqrt(2 phi - 1).
/// Hulbert-Chung, where a root of the amplification reaches -1:
///   omega^2 h^2 = (1 - 2 alpha_m) / (beta - gamma/2) = 12 (1 + r) (2 - r) / (10 - 5 r + r^2)
/// (the fit of the 1996 paper, their eq. 38, is the same at r = 0 and 1 and up to 0.4 % larger between).
/// Noh-Bathe: by bisection on its amplification matrix (3.745 for p = 0.54).
double stability_limit(const SchemeSettings& settings);

}  // namespace carom
