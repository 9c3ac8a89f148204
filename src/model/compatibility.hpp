// Which time scheme takes which enforcement of contact: the one table behind the error message, the manual and the
// tests.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "model/scheme_parameters.hpp"

namespace carom {

/// The schemes there are: one line each. For X(scheme): SchemeKind::scheme; its line of scheme_table, below; its row
/// scheme_row(), defined beside its class (schemes/scheme_table.hpp).
#define CAROM_SCHEMES(X)         \
  X(newmark)                     \
  X(hht)                         \
  X(wbz)                         \
  X(generalized_alpha)           \
  X(bathe)                       \
  X(contact_stabilized_newmark)  \
  X(energy_momentum)             \
  X(moreau_jean)                 \
  X(nonsmooth_generalized_alpha) \
  X(central_differences)         \
  X(hulbert_chung)               \
  X(noh_bathe)                   \
  X(tchamwa_wielgosz)            \
  X(modified_mass)               \
  X(statics)

#define CAROM_SCHEME_KIND(scheme) scheme,
enum class SchemeKind : std::uint8_t { CAROM_SCHEMES(CAROM_SCHEME_KIND) };
#undef CAROM_SCHEME_KIND

#define CAROM_SCHEME_VALUE(scheme) SchemeKind::scheme,
inline constexpr std::size_t scheme_count = std::array{CAROM_SCHEMES(CAROM_SCHEME_VALUE)}.size();
#undef CAROM_SCHEME_VALUE

enum class EnforcementKind : std::uint8_t { penalty, augmented_lagrangian, lagrange, plain, impulse };

/// Whether a step solves a system of the whole body.
enum class Stepping : std::uint8_t { implicit_steps, explicit_steps };

/// What the rest of the program has to know of an enforcement.
struct EnforcementTraits {
  EnforcementKind kind;
  std::string_view name;  ///< in case files
  bool takes_stiffness;   ///< contacts have springs, if only as a means
  bool adds_stiffness;    ///< the springs are part of the bodies' vibrations: they limit explicit steps
  bool is_exact;          ///< its conditions are met on the rows by their compliance, a column of the inverse each
  bool stops_touches;     ///< beside multipliers of displacements the velocities have impulses of their own
  bool throws_back;       ///< they have none, and follow from the displacements
};

inline constexpr std::array enforcement_table{
    EnforcementTraits{EnforcementKind::penalty, "penalty", true, true, false, false, false},
    EnforcementTraits{EnforcementKind::augmented_lagrangian, "augmented_lagrangian", true, false, false, true, false},
    EnforcementTraits{EnforcementKind::lagrange, "lagrange", false, false, true, true, false},
    EnforcementTraits{EnforcementKind::plain, "plain", false, false, true, false, true},
    EnforcementTraits{EnforcementKind::impulse, "impulse", false, false, true, false, false}};
inline constexpr std::size_t enforcement_count = enforcement_table.size();
inline constexpr std::array enforcement_names{enforcement_table[0].name, enforcement_table[1].name,
                                              enforcement_table[2].name, enforcement_table[3].name,
                                              enforcement_table[4].name};

/// How a scheme keeps the angular momentum of bodies that turn far.
enum class AngularMomentum : std::uint8_t { to_its_order, exactly };

/// One line of the table. `why_not` says what stands against the enforcements that are not taken.
struct SchemeTraits {
  SchemeKind kind;
  std::string_view name;   ///< in case files
  std::string_view title;  ///< in reports and messages
  Stepping stepping;
  SchemeParameters parameters;                ///< with their initial values
  std::array<bool, enforcement_count> takes;  ///< in the order of EnforcementKind
  std::string_view why_not;
  AngularMomentum angular_momentum = AngularMomentum::to_its_order;
  double gains = 0.005;       ///< energy that it may make, over what there is, without a trend (docs/schemes.md)
  bool takes_history = true;  ///< bodies whose points remember, and so dissipate; distortion control
};

namespace detail {
inline constexpr std::string_view smooth = "its forces are smooth functions of time, which impulses are not";
inline constexpr std::string_view smooth_explicit =
    "an explicit step has no equation in which a multiplier could be solved for at its end; central_differences and "
    "modified_mass are the explicit schemes with exact contact";
inline constexpr std::string_view by_the_mass =
    "its exact contact follows from the mass alone, at the velocities of the step that comes next";
inline constexpr std::string_view velocity_level =
    "it balances velocities over a step, so that contact enters by impulses";
inline constexpr std::string_view displacement_level =
    "it is built on constraints of the displacement, which it solves exactly within the step by a rule of its own";
inline constexpr std::string_view timeless =
    "it has no velocities, which impulses would change and plain multipliers would leave";
inline constexpr std::string_view potential =
    "it conserves energy through a contact potential, which only the penalty has";
}  // namespace detail

/// Doyen, Ern and Piperno, SIAM J. Sci. Comput. 33(1), 2011, sort contact discretisations into the same four groups.
inline constexpr std::array<SchemeTraits, scheme_count> scheme_table{{
    {SchemeKind::newmark,
     "newmark",
     "Newmark",
     Stepping::implicit_steps,
     NewmarkParameters{},
     {true, true, true, true, false},
     detail::smooth},
    {SchemeKind::hht,
     "hht",
     "HHT",
     Stepping::implicit_steps,
     AlphaParameters{},
     {true, true, true, true, false},
     detail::smooth},
    {SchemeKind::wbz,
     "wbz",
     "WBZ",
     Stepping::implicit_steps,
     AlphaParameters{},
     {true, true, true, true, false},
     detail::smooth},
    {SchemeKind::generalized_alpha,
     "generalized_alpha",
     "generalised-alpha",
     Stepping::implicit_steps,
     SpectralRadius{},
     {true, true, true, true, false},
     detail::smooth},
    {SchemeKind::bathe,
     "bathe",
     "Bathe composite",
     Stepping::implicit_steps,
     NoParameters{},
     {true, true, true, true, false},
     detail::smooth},
    {SchemeKind::contact_stabilized_newmark,
     "contact_stabilized_newmark",
     "contact-stabilised Newmark",
     Stepping::implicit_steps,
     ContactStabilizedParameters{},
     {false, false, true, false, false},
     detail::displacement_level},
    {SchemeKind::energy_momentum,
     "energy_momentum",
     "energy-momentum",
     Stepping::implicit_steps,
     NoParameters{},
     {true, false, false, false, false},
     detail::potential,
     AngularMomentum::exactly,
     0.005,
     false},
    {SchemeKind::moreau_jean,
     "moreau_jean",
     "Moreau-Jean",
     Stepping::implicit_steps,
     MoreauJeanParameters{},
     {false, false, false, false, true},
     detail::velocity_level},
    {SchemeKind::nonsmooth_generalized_alpha,
     "nonsmooth_generalized_alpha",
     "nonsmooth generalised-alpha",
     Stepping::implicit_steps,
     SpectralRadius{},
     {false, false, false, false, true},
     detail::velocity_level},
    {SchemeKind::central_differences,
     "central_differences",
     "central differences",
     Stepping::explicit_steps,
     NoParameters{},
     {true, false, true, false, true},
     detail::by_the_mass,
     AngularMomentum::exactly},
    {SchemeKind::hulbert_chung,
     "hulbert_chung",
     "Hulbert-Chung",
     Stepping::explicit_steps,
     SpectralRadius{},
     {true, false, false, false, false},
     detail::smooth_explicit},
    {SchemeKind::noh_bathe,
     "noh_bathe",
     "Noh-Bathe",
     Stepping::explicit_steps,
     NohBatheParameters{},
     {true, false, false, false, false},
     detail::smooth_explicit},
    {SchemeKind::tchamwa_wielgosz,
     "tchamwa_wielgosz",
     "Tchamwa-Wielgosz",
     Stepping::explicit_steps,
     TchamwaWielgoszParameters{},
     {true, false, false, false, false},
     detail::smooth_explicit},
    {SchemeKind::modified_mass,
     "modified_mass",
     "central differences, modified mass",
     Stepping::explicit_steps,
     NoParameters{},
     {false, false, true, false, false},
     detail::displacement_level,
     AngularMomentum::exactly,
     0.02},
    {SchemeKind::statics,
     "statics",
     "statics",
     Stepping::implicit_steps,
     NoParameters{},
     {true, true, true, false, false},
     detail::timeless},
}};

/// A name that a scheme has in the literature with one of its enforcements: a case may say it as its kind.
struct SchemeAlias {
  std::string_view name;
  std::string_view title;  ///< in reports and messages
  SchemeKind kind;
  EnforcementKind enforcement;
};
inline constexpr std::array scheme_aliases{
    SchemeAlias{"cd_lagrange", "CD-Lagrange", SchemeKind::central_differences, EnforcementKind::impulse},
    SchemeAlias{"forward_increment", "central differences, forward-increment multipliers",
                SchemeKind::central_differences, EnforcementKind::lagrange}};

constexpr const SchemeTraits& traits(SchemeKind kind) {
  return scheme_table[static_cast<std::size_t>(kind)];
}
constexpr bool takes(SchemeKind scheme, EnforcementKind enforcement) {
  return traits(scheme).takes[static_cast<std::size_t>(enforcement)];
}
constexpr const EnforcementTraits& traits(EnforcementKind kind) {
  return enforcement_table[static_cast<std::size_t>(kind)];
}
constexpr std::string_view name(EnforcementKind kind) {
  return traits(kind).name;
}
constexpr bool is_explicit(SchemeKind kind) {
  return traits(kind).stepping == Stepping::explicit_steps;
}
constexpr std::string_view title(SchemeKind scheme, EnforcementKind enforcement) {
  for (const SchemeAlias& alias : scheme_aliases) {
    if (alias.kind == scheme && alias.enforcement == enforcement) return alias.title;
  }
  return traits(scheme).title;
}
/// The enforcement that a case gets which names none: the first that the scheme takes.
constexpr EnforcementKind default_enforcement(SchemeKind scheme) {
  for (std::size_t e = 0; e < enforcement_count; ++e) {
    if (traits(scheme).takes[e]) return static_cast<EnforcementKind>(e);
  }
  return EnforcementKind::penalty;
}

namespace detail {
constexpr bool table_is_in_order() {
  for (std::size_t i = 0; i < scheme_table.size(); ++i) {
    if (static_cast<std::size_t>(scheme_table[i].kind) != i) return false;
  }
  for (std::size_t i = 0; i < enforcement_table.size(); ++i) {
    if (static_cast<std::size_t>(enforcement_table[i].kind) != i) return false;
  }
  return true;
}
static_assert(table_is_in_order());
}  // namespace detail

}  // namespace carom
