// The keys of the kinds of [[contact]]: of each kind, and what several of them share.
#pragma once

#include <string>
#include <type_traits>

#include "casefile/case_contact.hpp"
#include "casefile/section.hpp"
#include "casefile/section_rules.hpp"

namespace carom {

/// The keys of a kind, with their rules, and in one phrase what touches.
#define CAROM_DECLARE_CONTACT_KEYS(Kind) SectionSchema<Kind> contact_keys(std::type_identity<Kind>);
CAROM_CASE_CONTACTS(CAROM_DECLARE_CONTACT_KEYS)
#undef CAROM_DECLARE_CONTACT_KEYS

/// `group`, in the same words for all, so that it stands before what they have of their own.
template <class Kind>
void add_group(SectionSchema<Kind>& s) {
  const std::string doc =
      "Group of what touches: of cells (interface), of faces, bars or nodes (obstacles), of slave faces or bars "
      "(pair), "
      "of slave faces (tie), of faces or bars (self), of nodes (stop).";
  s.key_by("group", [](auto& kind) -> auto& { return kind.group; }, doc,
           {.need = KeyOptions::Need::required, .aliases = {"slave"}});
}

inline const std::vector<std::string> stiffness_aliases{"penalty", "eps_N", "E_n"};
inline const std::string chosen_stiffness = "from the material and the size of the cells";

/// `bar_radius`
template <class Kind>
void add_bar_radius(SectionSchema<Kind>& s) {
  s.key_by(
      "bar_radius", [](auto& kind) -> auto& { return kind.bar_radius; },
      "Of bars that touch with their sides, which are round: those whose nodes are all in the group, unless it names "
      "their ends alone, which then touch as points.",
      {.unit = Dimension::length,
       .range = greater_than(0.0),
       .default_phrase = "that of a round bar of the section's area"});
}

/// `stiffness_factor`, of springs at spring(kind).
template <class Kind, class Springs>
void add_stiffness_factor(SectionSchema<Kind>& s, const Springs& springs) {
  s.key_by("stiffness_factor", [springs](auto& kind) -> auto& { return springs(kind).stiffness_factor; },
           "Multiplies the stiffness that is chosen where none is given.", {.range = greater_than(0.0)});
}

/// Keys of Kind::law.
template <class Kind>
void add_law(SectionSchema<Kind>& s) {
  const auto law = [](auto& kind) -> auto& {
    return kind.law;
  };
  s.key_by("stiffness", [](auto& kind) -> auto& { return kind.law.stiffness; },
           "Normal stress per penetration; with measure = \"node\": force of a node per penetration.",
           {.unit = Dimension::stress_per_length,
            .range = greater_than(0.0),
            .aliases = stiffness_aliases,
            .default_phrase = chosen_stiffness});
  add_stiffness_factor(s, law);
  s.key_by("tangential_stiffness", [](auto& kind) -> auto& { return kind.law.tangential_stiffness; },
           "As stiffness, for the sliding that regularised friction resists.",
           {.unit = Dimension::stress_per_length,
            .range = greater_than(0.0),
            .aliases = {"eps_T", "E_t"},
            .default_phrase = "with friction: as stiffness"});
  s.key_by("friction", [](auto& kind) -> auto& { return kind.law.friction; }, "Coulomb's coefficient of friction mu.",
           {.range = at_least(0.0), .aliases = {"mu"}});
  s.key_by("friction_law", [](auto& kind) -> auto& { return kind.law.friction_law; },
           "Instead of friction: a coefficient that depends on pressure, slip rate, place and time, which a program "
           "computes that uses Carom as a library (docs/python.md), and which it alone can run.",
           {.choices = {"called"}, .default_phrase = "friction"});
  s.key_by("restitution", [](auto& kind) -> auto& { return kind.law.restitution; },
           "Newton's coefficient of the nodes that touch: separating over approaching speed, for enforcement = "
           "\"impulse\". Not that of their bodies, which rebound by their own waves.",
           {.range = {Bound{0.0, Bound::Side::closed}, Bound{1.0, Bound::Side::closed}}, .aliases = {"e"}});
  s.key_by("initial_penetration", [](auto& kind) -> auto& { return kind.law.initial_penetration; },
           "What to do where bodies overlap at the start: refuse the case, take the overlap as the zero of the gap (no "
           "strain), or keep it as prestress.",
           {.choices = {"refuse", "offset", "prestress"},
            .default_phrase = "\"refuse\"; with [initial_state] \"prestress\" to a quarter of a cell"});
}

/// Keys of a law of pressure over depth, where each row has a depth of its own.
template <class Kind>
void add_pressures(SectionSchema<Kind>& s) {
  s.key_by(
      "depths", [](auto& kind) -> auto& { return kind.law.depths; },
      "Instead of a stiffness: increasing penetrations at which pressures are given, with enforcement = \"penalty\". "
      "The law is straight from 0 to the first of them, between them, and on beyond the last.",
      {.unit = Dimension::length, .default_phrase = "none"});
  s.key_by("pressures", [](auto& kind) -> auto& { return kind.law.pressures; },
           "Normal stress at each of the depths, positive, not falling; with measure = \"node\": force of a node.",
           {.unit = Dimension::stress, .default_phrase = "none"});
}

/// They need springs that are asked at the end of a step.
void check_pressures(const CaseContactLaw& law, const CaseScheme& scheme, const ContactPlace& at);

/// The factor is one on the stiffness that is chosen.
void check_stiffness(const CaseStiffness& springs, const Node& node, const ReadContext& at);
/// Friction needs both mu and a tangential stiffness. Fills what is done about overlaps at the start.
void check_law(CaseContactLaw& law, const Node& node, const ReadContext& at);

}  // namespace carom
