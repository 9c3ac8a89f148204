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
  std::string_view name;         ///< in case files
  bool takes_stiffness = false;  ///< contacts have springs, if only as a means
  bool adds_stiffness = false;   ///< the springs are part of the bodies' vibrations: they limit explicit steps
  bool is_exact = false;       ///< its conditions are met on the rows by their compliance, a column of the inverse each
  bool stops_touches = false;  ///< beside multipliers of displacements the velocities have impulses of their own
  bool throws_back = false;    ///< they have none, and follow from the displacements
};

inline constexpr std::array enforcement_table{
    EnforcementTraits{
        .kind = EnforcementKind::penalty, .name = "penalty", .takes_stiffness = true, .adds_stiffness = true},
    EnforcementTraits{.kind = EnforcementKind::augmented_lagrangian,
                      .name = "augmented_lagrangian",
                      .takes_stiffness = true,
                      .stops_touches = true},
    EnforcementTraits{.kind = EnforcementKind::lagrange, .name = "lagrange", .is_exact = true, .stops_touches = true},
    EnforcementTraits{.kind = EnforcementKind::plain, .name = "plain", .is_exact = true, .throws_back = true},
    EnforcementTraits{.kind = EnforcementKind::impulse, .name = "impulse", .is_exact = true}};
inline constexpr std::size_t enforcement_count = enforcement_table.size();
inline constexpr std::array enforcement_names{enforcement_table[0].name, enforcement_table[1].name,
                                              enforcement_table[2].name, enforcement_table[3].name,
                                              enforcement_table[4].name};

/// How a scheme keeps the angular momentum of bodies that turn far.
enum class AngularMomentum : std::uint8_t { to_its_order, exactly };

/// Which enforcements a scheme takes.
struct Takes {
  bool penalty = false, augmented_lagrangian = false, lagrange = false, plain = false, impulse = false;

  /// In the order of EnforcementKind.
  constexpr std::array<bool, enforcement_count> all() const {
    return {penalty, augmented_lagrangian, lagrange, plain, impulse};
  }
  constexpr bool operator[](std::size_t kind) const { return all()[kind]; }
};

/// One line of the table. `why_not` says what stands against the enforcements that are not taken.
struct SchemeTraits {
  SchemeKind kind;
  std::string_view name;   ///< in case files
  std::string_view title;  ///< in reports and messages
  Stepping stepping;
  SchemeParameters parameters;  ///< with their initial values
  Takes takes;
  std::string_view why_not;
  AngularMomentum angular_momentum = AngularMomentum::to_its_order;
  double gains = 0.005;       ///< energy that it may make, over what there is, without a trend (docs/schemes.md)
  bool has_inertia = true;    ///< false: its steps are equilibria
  bool takes_history = true;  ///< bodies whose points remember, and so dissipate; distortion control
  /// Explicit steps whose contact nodes have given their mass away, and are solved for by the tangent.
  bool has_massless_contact = false;
  /// Bonds with what an imposed motion leads (Stage::refuse_driven_bonds says why not).
  bool takes_driven_bonds = true;
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
    {.kind = SchemeKind::newmark,
     .name = "newmark",
     .title = "Newmark",
     .stepping = Stepping::implicit_steps,
     .parameters = NewmarkParameters{},
     .takes = {.penalty = true, .augmented_lagrangian = true, .lagrange = true, .plain = true},
     .why_not = detail::smooth},
    {.kind = SchemeKind::hht,
     .name = "hht",
     .title = "HHT",
     .stepping = Stepping::implicit_steps,
     .parameters = AlphaParameters{},
     .takes = {.penalty = true, .augmented_lagrangian = true, .lagrange = true, .plain = true},
     .why_not = detail::smooth},
    {.kind = SchemeKind::wbz,
     .name = "wbz",
     .title = "WBZ",
     .stepping = Stepping::implicit_steps,
     .parameters = AlphaParameters{},
     .takes = {.penalty = true, .augmented_lagrangian = true, .lagrange = true, .plain = true},
     .why_not = detail::smooth},
    {.kind = SchemeKind::generalized_alpha,
     .name = "generalized_alpha",
     .title = "generalised-alpha",
     .stepping = Stepping::implicit_steps,
     .parameters = SpectralRadius{},
     .takes = {.penalty = true, .augmented_lagrangian = true, .lagrange = true, .plain = true},
     .why_not = detail::smooth},
    {.kind = SchemeKind::bathe,
     .name = "bathe",
     .title = "Bathe composite",
     .stepping = Stepping::implicit_steps,
     .parameters = NoParameters{},
     .takes = {.penalty = true, .augmented_lagrangian = true, .lagrange = true, .plain = true},
     .why_not = detail::smooth},
    {.kind = SchemeKind::contact_stabilized_newmark,
     .name = "contact_stabilized_newmark",
     .title = "contact-stabilised Newmark",
     .stepping = Stepping::implicit_steps,
     .parameters = ContactStabilizedParameters{},
     .takes = {.lagrange = true},
     .why_not = detail::displacement_level},
    {.kind = SchemeKind::energy_momentum,
     .name = "energy_momentum",
     .title = "energy-momentum",
     .stepping = Stepping::implicit_steps,
     .parameters = NoParameters{},
     .takes = {.penalty = true},
     .why_not = detail::potential,
     .angular_momentum = AngularMomentum::exactly,
     .takes_history = false},
    {.kind = SchemeKind::moreau_jean,
     .name = "moreau_jean",
     .title = "Moreau-Jean",
     .stepping = Stepping::implicit_steps,
     .parameters = MoreauJeanParameters{},
     .takes = {.impulse = true},
     .why_not = detail::velocity_level},
    {.kind = SchemeKind::nonsmooth_generalized_alpha,
     .name = "nonsmooth_generalized_alpha",
     .title = "nonsmooth generalised-alpha",
     .stepping = Stepping::implicit_steps,
     .parameters = SpectralRadius{},
     .takes = {.impulse = true},
     .why_not = detail::velocity_level,
     .takes_driven_bonds = false},
    {.kind = SchemeKind::central_differences,
     .name = "central_differences",
     .title = "central differences",
     .stepping = Stepping::explicit_steps,
     .parameters = NoParameters{},
     .takes = {.penalty = true, .lagrange = true, .impulse = true},
     .why_not = detail::by_the_mass,
     .angular_momentum = AngularMomentum::exactly},
    {.kind = SchemeKind::hulbert_chung,
     .name = "hulbert_chung",
     .title = "Hulbert-Chung",
     .stepping = Stepping::explicit_steps,
     .parameters = SpectralRadius{},
     .takes = {.penalty = true},
     .why_not = detail::smooth_explicit},
    {.kind = SchemeKind::noh_bathe,
     .name = "noh_bathe",
     .title = "Noh-Bathe",
     .stepping = Stepping::explicit_steps,
     .parameters = NohBatheParameters{},
     .takes = {.penalty = true},
     .why_not = detail::smooth_explicit},
    {.kind = SchemeKind::tchamwa_wielgosz,
     .name = "tchamwa_wielgosz",
     .title = "Tchamwa-Wielgosz",
     .stepping = Stepping::explicit_steps,
     .parameters = TchamwaWielgoszParameters{},
     .takes = {.penalty = true},
     .why_not = detail::smooth_explicit,
     .takes_driven_bonds = false},
    {.kind = SchemeKind::modified_mass,
     .name = "modified_mass",
     .title = "central differences, modified mass",
     .stepping = Stepping::explicit_steps,
     .parameters = NoParameters{},
     .takes = {.lagrange = true},
     .why_not = detail::displacement_level,
     .angular_momentum = AngularMomentum::exactly,
     .gains = 0.02,
     .has_massless_contact = true},
    {.kind = SchemeKind::statics,
     .name = "statics",
     .title = "statics",
     .stepping = Stepping::implicit_steps,
     .parameters = NoParameters{},
     .takes = {.penalty = true, .augmented_lagrangian = true, .lagrange = true},
     .why_not = detail::timeless,
     .has_inertia = false},
}};

/// A name that a scheme has in the literature with one of its enforcements: a case may say it as its kind.
struct SchemeAlias {
  std::string_view name;
  std::string_view title;  ///< in reports and messages
  SchemeKind kind;
  EnforcementKind enforcement;
};
inline constexpr std::array scheme_aliases{SchemeAlias{.name = "cd_lagrange",
                                                       .title = "CD-Lagrange",
                                                       .kind = SchemeKind::central_differences,
                                                       .enforcement = EnforcementKind::impulse},
                                           SchemeAlias{.name = "forward_increment",
                                                       .title = "central differences, forward-increment multipliers",
                                                       .kind = SchemeKind::central_differences,
                                                       .enforcement = EnforcementKind::lagrange}};

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
constexpr bool has_massless_contact(SchemeKind kind) {
  return traits(kind).has_massless_contact;
}
constexpr bool has_inertia(SchemeKind kind) {
  return traits(kind).has_inertia;
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
