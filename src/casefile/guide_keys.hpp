// The keys of what guides hold free rigid bodies by, which obstacles and [[rigid_body]] share.
#pragma once

#include <fmt/format.h>

#include <string>

#include "casefile/case.hpp"
#include "casefile/case_schema.hpp"
#include "casefile/section.hpp"

namespace carom {

/// Adds the keys of the CaseGuide at guide(section).
template <class S, class Access>
void add_guide_keys(SectionSchema<S>& s, Access guide) {
  s.key_by("blocked", [guide](auto& of) -> auto& { return guide(of).blocked; },
           "Axes along which guides hold the free body: its point blocked_at does not move along them.",
           {.choices = kAxes});
  s.key_by("blocked_turns", [guide](auto& of) -> auto& { return guide(of).blocked_turns; },
           "Axes about which guides keep it from turning: two, for a body that turns about the third alone, or all.",
           {.choices = kAxes});
  s.key_by("blocked_at", [guide](auto& of) -> auto& { return guide(of).blocked_at; },
           "The point that blocked holds, at the start, as of a hinge.",
           {.unit = Dimension::length, .default_phrase = "the centre of mass"});
}

/// What the keys ask of each other.
inline void check_guide(const CaseGuide& guide, const ReadContext& at) {
  if (guide.blocked_turns) {
    const std::array<bool, 3>& about = **guide.blocked_turns;
    if (about[0] + about[1] + about[2] == 1)
      throw CaseError(guide.blocked_turns->where, at.at("blocked_turns").path, "one axis alone",
                      "two axes, or all three",
                      "What is kept from turning about one axis while it turns about others has no axis of its own: "
                      "block two for a hinge, all for a guide.");
  }
  if (guide.blocked_at && !guide.blocked)
    throw CaseError(guide.blocked_at->where, at.at("blocked_at").path, "a point without axes along which it is held",
                    "blocked beside it", "Add blocked, or remove blocked_at.");
}

/// Guides of bodies that turn are equations, which know no nodes that give their mass away.
inline void check_guide(const CaseGuide& guide, const CaseScheme& scheme, const std::string& section) {
  if (!guide.holds() || **scheme.mass != CaseScheme::Mass::modified) return;
  const char* const key = guide.blocked ? "blocked" : "blocked_turns";
  throw CaseError(guide.blocked ? guide.blocked->where : guide.blocked_turns->where, section + "." + key,
                  fmt::format("{} of a body that turns, with mass = \"modified\"", key),
                  "a scheme whose nodes keep their mass",
                  "The guide is an equation: take another mass, or another scheme than modified_mass.");
}

}  // namespace carom
