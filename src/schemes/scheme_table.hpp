// The time schemes as a table: one row each, defined beside its class.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "schemes/scheme.hpp"
#include "schemes/scheme_settings.hpp"

namespace carom {

/// All that a scheme is made from.
struct SchemeRequest {
  const System& system;
  const SchemeSettings& settings;
  double dt;                 ///< the usual step
  double omega_max_squared;  ///< a bound of the spectrum of M^-1 K, for the linear solver of implicit schemes

  template <class Parameters>
  const Parameters& parameters() const {
    return std::get<Parameters>(settings.parameters);
  }
};

/// The row of a scheme: how it is made and what limits it. Its name and its parameters stand in its line of
/// scheme_table (model/compatibility.hpp).
struct SchemeRow {
  std::unique_ptr<Scheme> (*make)(const SchemeRequest& request) = nullptr;
  double (*stability_limit)(const SchemeParameters& parameters) = nullptr;  ///< null: any step is stable
  double (*touch_rebound)(const SchemeParameters& parameters) = nullptr;    ///< null: it takes no plain multipliers
  int parts_of_step = 1;  ///< how often a step solves for a motion, or evaluates the forces
};

#define CAROM_DECLARE_SCHEME(scheme) SchemeRow scheme##_row();
CAROM_SCHEMES(CAROM_DECLARE_SCHEME)
#undef CAROM_DECLARE_SCHEME

std::unique_ptr<Scheme> make_scheme(const SchemeRequest& request);

/// "Newmark beta 0.28 gamma 0.55": the scheme with its own parameters.
std::string describe(const SchemeSettings& settings);

/// Largest omega h at which the scheme is stable on an undamped oscillator; infinity where there is none.
double stability_limit(const SchemeSettings& settings);

/// SchemeRow::parts_of_step.
int parts_of_step(SchemeKind kind);

/// The largest touch_rebound() of a run on plain multipliers that may be expected to keep its energy; above it, it may
/// make more (measured on cases/impact_bar/bars.toml at Courant numbers 0.15 to 3: growth below 1 % up to 1.4, above 5
/// % from 2.1 on).
inline constexpr double largest_touch_rebound = 1.5;

/// The largest ratio of separating to approaching speed of a free mass that plain multipliers keep off a rigid row for
/// one step. Empty for other enforcements. Above 1 touches make energy, whatever the step, fixed wall or free.
std::optional<double> touch_rebound(const SchemeSettings& settings);

}  // namespace carom
