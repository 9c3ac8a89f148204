// The scheme that a case names.
#pragma once

#include <memory>
#include <string>

#include "schemes/scheme.hpp"
#include "schemes/scheme_settings.hpp"

namespace carom {

/// dt: the usual step; omega_max_squared: a bound of the spectrum of M^-1 K, for the choice of the linear solver.
std::unique_ptr<Scheme> make_scheme(const System& system, const SchemeSettings& settings, double dt,
                                    double omega_max_squared);

/// "Newmark beta 0.28 gamma 0.55": the scheme with its own parameters.
std::string describe(const SchemeSettings& settings);

}  // namespace carom
