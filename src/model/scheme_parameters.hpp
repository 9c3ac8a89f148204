// The numbers that users of time schemes give: one struct per family of schemes, and their keys in case files.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <variant>

#include "math/interval.hpp"

namespace carom {

struct NoParameters {};

struct NewmarkParameters {
  double beta = 0.25, gamma = 0.5;

  /// For linear bodies, whatever the step (Hughes, The Finite Element Method, section 9.1).
  constexpr bool is_stable_for_any_step() const {
    constexpr double round_off = 1e-12;
    return 2.0 * beta >= gamma * (1.0 - round_off);
  }
};

struct ContactStabilizedParameters {
  double gamma = 0.5;
};

/// HHT, WBZ.
struct AlphaParameters {
  double alpha = -0.05;
};
/// Below, HHT dissipates less again.
inline constexpr double least_alpha_of_hht = -1.0 / 3.0;

/// Generalised-alpha, its nonsmooth kin, Hulbert-Chung.
struct SpectralRadius {
  double rho_inf = 0.8;
};

struct MoreauJeanParameters {
  double theta = 0.5;
};

struct TchamwaWielgoszParameters {
  double phi = 1.033;
};

struct NohBatheParameters {
  double p = 0.54;
};

using SchemeParameters =
    std::variant<NoParameters, NewmarkParameters, ContactStabilizedParameters, AlphaParameters, SpectralRadius,
                 MoreauJeanParameters, TchamwaWielgoszParameters, NohBatheParameters>;

/// A key of case files, with the members it stands for.
struct SchemeNumber {
  std::string_view key;
  std::string_view meaning;
  Interval range;
  double* (*in)(SchemeParameters& parameters);  ///< its value; nullptr in parameters that do not have it

  constexpr std::optional<double> value(SchemeParameters parameters) const {
    const double* found = in(parameters);
    return found != nullptr ? std::optional(*found) : std::nullopt;
  }
};

namespace detail {
template <class Parameters>
constexpr double* member_in(SchemeParameters& parameters, double Parameters::*member) {
  auto* held = std::get_if<Parameters>(&parameters);
  return held != nullptr ? &(held->*member) : nullptr;
}
template <auto... members>
constexpr double* any_in(SchemeParameters& parameters) {
  double* found = nullptr;
  ((found = found != nullptr ? found : member_in(parameters, members)), ...);
  return found;
}
}  // namespace detail

/// In the order of the manual.
inline constexpr std::array scheme_numbers{
    SchemeNumber{.key = "beta",
                 .meaning = "Newmark's beta.",
                 .range = {.low = 0.0, .high = 0.5, .is_closed_high = true},
                 .in = detail::any_in<&NewmarkParameters::beta>},
    SchemeNumber{.key = "gamma",
                 .meaning = "Newmark's gamma; above 0.5 the scheme dissipates.",
                 .range = {.low = 0.5, .high = 1.0, .is_closed_low = true, .is_closed_high = true},
                 .in = detail::any_in<&NewmarkParameters::gamma, &ContactStabilizedParameters::gamma>},
    SchemeNumber{.key = "alpha",
                 .meaning = "Dissipation of HHT (from -1/3 on) and WBZ; 0 is Newmark's trapezoidal rule.",
                 .range = {.low = -1.0, .high = 0.0, .is_closed_low = true, .is_closed_high = true},
                 .in = detail::any_in<&AlphaParameters::alpha>},
    SchemeNumber{.key = "rho_inf",
                 .meaning = "Spectral radius at high frequency (Hulbert-Chung: at bifurcation).",
                 .range = {.low = 0.0, .high = 1.0, .is_closed_low = true, .is_closed_high = true},
                 .in = detail::any_in<&SpectralRadius::rho_inf>},
    SchemeNumber{.key = "theta",
                 .meaning = "Weight of the end of the step; above 0.5 the scheme dissipates.",
                 .range = {.low = 0.5, .high = 1.0, .is_closed_low = true, .is_closed_high = true},
                 .in = detail::any_in<&MoreauJeanParameters::theta>},
    SchemeNumber{.key = "phi",
                 .meaning = "Above 1 the scheme dissipates.",
                 .range = {.low = 1.0, .high = 2.0, .is_closed_low = true, .is_closed_high = true},
                 .in = detail::any_in<&TchamwaWielgoszParameters::phi>},
    SchemeNumber{.key = "p",
                 .meaning = "First sub-step over the step.",
                 .range = {.low = 0.0, .high = 1.0},
                 .in = detail::any_in<&NohBatheParameters::p>}};

}  // namespace carom
