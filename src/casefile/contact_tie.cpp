#include <fmt/format.h>

#include <algorithm>

#include "casefile/case.hpp"
#include "casefile/contact_keys.hpp"

namespace carom {

namespace {

/// Where the tie tears, and how what is left of it rubs.
void add_tearing(SectionSchema<CaseTie>& s) {
  const auto stress = [](const std::string& otherwise) {
    return KeyOptions{.unit = Dimension::stress, .range = greater_than(0.0), .default_phrase = otherwise};
  };
  const auto energy = [](const std::string& otherwise) {  // per area: of the dimension of force per length
    return KeyOptions{.unit = Dimension::force_per_length, .range = greater_than(0.0), .default_phrase = otherwise};
  };
  const std::string holds = "the tie holds whatever comes", as_normal = "as that of the normal";
  s.key("normal_strength", &CaseTie::normal_strength,
        "Stress at which the tie begins to tear when it is pulled; torn, its surfaces touch as a pair does.",
        stress(holds));
  s.key("shear_strength", &CaseTie::shear_strength, "The same when it is sheared.", stress(as_normal));
  s.key("normal_fracture_energy", &CaseTie::normal_energy,
        "Energy per area that tearing takes when the tie is pulled: half of the strength times the opening at which "
        "nothing holds any more.",
        energy(holds));
  s.key("shear_fracture_energy", &CaseTie::shear_energy, "The same when it is sheared.", energy(as_normal));
  s.key_by("friction", [](auto& tie) -> auto& { return tie.torn.law.friction; },
           "Coulomb's coefficient of friction mu, of a tie that has torn.",
           {.range = at_least(0.0), .aliases = {"mu"}});
}

/// Strength and energy belong together, and what else there is of tearing to both.
void check_tearing(const CaseTie& given, const Node& node, const ReadContext& at) {
  if (given.normal_strength && given.normal_energy) return;
  const char* missing = given.normal_strength ? "normal_fracture_energy"
                        : given.normal_energy ? "normal_strength"
                                              : "normal_strength and normal_fracture_energy";
  const auto refuse = [&](const Location& where, const char* key, double found) {
    throw CaseError(where, at.at(key).path, fmt::format("{:g}, of a tie without {}", found, missing),
                    "normal_strength and normal_fracture_energy, for a tie that tears, or nothing of tearing",
                    "A tie tears at a stress, and tearing takes an energy per area: give both.");
  };
  const auto refuse_one = [&](const std::optional<Located<double>>& value, const char* key) {
    if (value) refuse(value->where, key, **value);
  };
  refuse_one(given.normal_strength, "normal_strength");
  refuse_one(given.normal_energy, "normal_fracture_energy");
  refuse_one(given.shear_strength, "shear_strength");
  refuse_one(given.shear_energy, "shear_fracture_energy");
  if (given.torn.law.friction > 0.0) refuse(place_of(node, "friction"), "friction", given.torn.law.friction);
}

/// At a stiffness k the strength S is reached when S^2 / (2 k) per area is stored, and G must be more.
void check_tearing_stiffness(const CaseTie& given, const ReadContext& at) {
  if (!given.tears() || !given.stiffness) return;
  const CohesiveLaw law = given.tearing();
  const double least = std::max(law.normal_strength * law.normal_strength / (2.0 * law.normal_energy),
                                law.shear_strength * law.shear_strength / (2.0 * law.shear_energy));
  if (law.stiffness > least) return;
  throw CaseError(given.stiffness->where, at.at("stiffness").path,
                  fmt::format("{:g}, at which the tie takes up more than its fracture energy before it bears its "
                              "strength",
                              law.stiffness),
                  fmt::format("more than strength^2 / (2 x energy) = {:.4g}", least),
                  "Take ten times that, or remove stiffness to have it chosen.");
}

}  // namespace

CohesiveLaw CaseTie::tearing() const {
  CohesiveLaw law;
  law.normal_strength = **normal_strength;
  law.normal_energy = **normal_energy;
  law.shear_strength = **(shear_strength ? shear_strength : normal_strength);
  law.shear_energy = **(shear_energy ? shear_energy : normal_energy);
  law.stiffness = stiffness ? **stiffness : 0.0;
  return law;
}

SectionSchema<CaseTie> contact_keys(std::type_identity<CaseTie>) {
  SectionSchema<CaseTie> s("two surfaces that are glued");
  add_group(s);
  s.key("master", &CaseTie::master, "Group of faces of the other body; the coarser or stiffer one.",
        {.need = KeyOptions::Need::required});
  s.key("stiffness", &CaseTie::stiffness,
        "Stress per distance that the surfaces part, where the scheme is implicit and ties by springs (enforcement = "
        "\"penalty\" or \"augmented_lagrangian\"); of one that tears, in every scheme.",
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
  add_tearing(s);
  s.finish = [](CaseTie& given, const Node& node, const ReadContext& at) {
    check_stiffness(given, node, at);
    check_tearing(given, node, at);
    check_tearing_stiffness(given, at);
  };
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
