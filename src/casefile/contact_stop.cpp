#include <fmt/format.h>

#include "casefile/case.hpp"
#include "casefile/contact_keys.hpp"

namespace carom {

SectionSchema<CaseStop> contact_keys(std::type_identity<CaseStop>) {
  constexpr auto required = KeyOptions::Need::required;
  SectionSchema<CaseStop> s("discrete stops on nodes");
  add_group(s);
  s.key("normal", &CaseStop::normal, "Direction from the stop to the node; of any length but 0.", {.need = required});
  s.key("gap", &CaseStop::gap, "Distance that a node moves before it touches.", {.unit = Dimension::length});
  s.key("stiffness", &CaseStop::stiffness, "Force of a node per penetration.",
        {.unit = Dimension::force_per_length,
         .range = greater_than(0.0),
         .need = required,
         .aliases = stiffness_aliases});
  s.key("damping", &CaseStop::damping, "Force of a node per closing speed, while it touches.",
        {.unit = Dimension::damping, .range = at_least(0.0)});
  s.key("damper", &CaseStop::damper,
        "How the damping acts while the node touches: so that the stop never pulls (compression), or also holding the "
        "node back when it moves off (two_sided).",
        {.choices = {"compression", "two_sided"}});
  s.finish = [](CaseStop& given, const Node&, const ReadContext& at) {
    check_direction(given.normal, at.at("normal").path);
  };
  return s;
}

void CaseStop::check_scheme(const CaseScheme& scheme, const ContactPlace& at) const {
  const EnforcementKind enforcement = **scheme.enforcement;
  if (enforcement == EnforcementKind::penalty) return;
  throw CaseError(at.contact.kind.where, at.path + ".kind",
                  fmt::format("a stop, which is a spring, with enforcement = \"{}\"", name(enforcement)),
                  "enforcement = \"penalty\" with stops", "Take a plane instead, or a scheme with penalty.");
}

}  // namespace carom
