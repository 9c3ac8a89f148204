#include "casefile/case.hpp"
#include "casefile/contact_keys.hpp"

namespace carom {

SectionSchema<CaseTie> contact_keys(std::type_identity<CaseTie>) {
  SectionSchema<CaseTie> s("two surfaces that are glued");
  add_group(s);
  s.key("master", &CaseTie::master, "Group of faces of the other body; the coarser or stiffer one.",
        {.need = KeyOptions::Need::required});
  s.key("stiffness", &CaseTie::stiffness,
        "Stress per distance that the surfaces part, where the scheme is implicit and ties by springs (enforcement = "
        "\"penalty\" or \"augmented_lagrangian\").",
        {.unit = Dimension::stress_per_length,
         .range = greater_than(0.0),
         .aliases = stiffness_aliases,
         .default_phrase = chosen_stiffness});
  add_stiffness_factor(
      s, [](auto& tie) -> auto& { return tie; });
  s.key("method", &CaseTie::method,
        "What is tied: each slave node to its nearest place on the master; or the means over the overlaps of the faces "
        "(mortar), which carry uniform stress exactly across meshes that do not match.",
        {.choices = {"node_to_surface", "surface_to_surface"}});
  s.key(
      "tolerance", &CaseTie::tolerance,
      "Largest distance of a slave node from the nearest master face that is tied, over the size of that face (root of "
      "its area, or its length).",
      {.range = at_least(0.0)});
  s.key("distance", &CaseTie::distance, "The same as a length, in the place of `tolerance`.",
        {.unit = Dimension::length, .range = at_least(0.0), .default_phrase = "tolerance times the size of the face"});
  s.key("far", &CaseTie::far,
        "What to do about slave nodes that are farther away: refuse the case, or leave them free.",
        {.choices = {"refuse", "leave"}});
  s.finish = [](CaseTie& given, const Node& node, const ReadContext& at) { check_stiffness(given, node, at); };
  return s;
}

void CaseTie::check_scheme(const CaseScheme& scheme, const ContactPlace& at) const {
  if (**scheme.mass != CaseScheme::Mass::modified) return;
  throw CaseError(at.contact.kind.where, at.path + ".kind", "a tie, with mass = \"modified\"",
                  "a scheme whose contact nodes keep their mass",
                  "What is tied moves by its inertia, also where it touches something: take another mass, or another "
                  "scheme than modified_mass.");
}

}  // namespace carom
