// What implicit schemes on multipliers make of a node that touches for one step.
#pragma once

#include <optional>

#include "schemes/scheme_settings.hpp"

namespace carom {

/// Above this a run on multipliers may make more energy than it may keep (measured on cases/impact_bar/bars.toml at
/// Courant numbers 0.15 to 3: growth below 1 % up to 1.4, above 5 % from 2.1 on).
inline constexpr double largest_touch_rebound = 1.5;

/// Separating over approaching speed of a free mass that meets a rigid row just before the end of a step. The
/// multiplier has to take back the step's displacement h v = beta h^2 a1, and lets go in the next step, where the
/// equation of motion (1 - alpha_m) a2 + alpha_m a1 = 0 still remembers a1; the sum of what the velocity gains is
///   h (a1 + a2 + ...) = (1 - alpha_m) h a1 = (1 - alpha_m) v / beta,
/// so that the mass leaves with (1 - alpha_m) / beta - 1 times its speed: 1 for Chung and Hulbert with rho_inf = 1, 3
/// for Newmark's parameters with beta = 1/4. Above 1 touches make energy, whatever the step, fixed wall or free. With
/// VelocityImpulses a touch stops: 0 for Newmark and WBZ; Bathe's backward formula still leaves a mass that reaches the
/// row right after the middle with v / 2, the most. Empty for schemes of other families and other enforcements.
std::optional<double> touch_rebound(const SchemeSettings& settings);

}  // namespace carom
