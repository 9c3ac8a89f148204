#include <fmt/format.h>

#include "casefile/case.hpp"
#include "casefile/case_schema.hpp"
#include "casefile/contact_keys.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

template <class Kind>
void add_kind(SectionSchema<CaseContact>& s) {
  s.kind(std::string(Kind::kind), &CaseContact::of, contact_keys(std::type_identity<Kind>{}));
}

/// "interface: cells of zero thickness; ..."
std::string summary() {
  std::string text;
#define CAROM_CONTACT_SUMMARY(Kind) \
  text += text.empty() ? "" : "; "; \
  text += "`" + std::string(Kind::kind) + "`: " + contact_keys(std::type_identity<Kind>{}).description.doc;
  CAROM_CASE_CONTACTS(CAROM_CONTACT_SUMMARY)
#undef CAROM_CONTACT_SUMMARY
  return text;
}

}  // namespace

SectionSchema<CaseContact> contact_section() {
#define CAROM_CONTACT_NAME(Kind) std::string(Kind::kind),
  const std::vector<std::string> names{CAROM_CASE_CONTACTS(CAROM_CONTACT_NAME)};
#undef CAROM_CONTACT_NAME
  SectionSchema<CaseContact> s("Who touches whom, or stays together. " + summary() + ".");
  s.description.selector = "kind";
  s.key("name", &CaseContact::name, "Name in results and in [[check]].", {.need = Need::required});
  s.key("kind", &CaseContact::kind, "What touches; decides which of the other keys are taken.",
        {.choices = names, .need = Need::required});
  s.key("moment_point", &CaseContact::moment_point, "Point about which contact.csv gives the moment of the contact.",
        {.unit = Dimension::length,
         .default_phrase = "the origin; of an obstacle with an imposed rotation its centre, which travels with it"});
  s.key("cfc", &CaseContact::cfc,
        "Low-pass filter of its forces and moments, in contact_filtered.csv: SAE J211 channel frequency class.",
        {.range = greater_than(0.0)});
#define CAROM_ADD_CONTACT(Kind) add_kind<Kind>(s);
  CAROM_CASE_CONTACTS(CAROM_ADD_CONTACT)
#undef CAROM_ADD_CONTACT
  s.finish = [](CaseContact& contact, const Node&, const ReadContext& at) {
    check_name(contact.name, at.at("name").path);
  };
  return s;
}

void check_stiffness(const CaseStiffness& springs, const Node& node, const ReadContext& at) {
  if (springs.stiffness && find(node, "stiffness_factor") != nullptr && springs.stiffness_factor != 1.0) {
    throw CaseError(place_of(node, "stiffness_factor"), at.at("stiffness_factor").path, "a factor beside a stiffness",
                    "one of the two", "Remove stiffness to have it chosen.");
  }
}

namespace {

/// As many depths as pressures, none of which falls, in the place of a stiffness.
void check_table(const CaseContactLaw& law, const Node& node, const ReadContext& at) {
  const std::vector<double>&depths = *law.depths, &pressures = *law.pressures;
  if (depths.empty() && pressures.empty()) return;
  const auto refuse = [&](const char* key, const std::string& found, const std::string& expected) {
    throw CaseError(place_of(node, key), at.at(key).path, found, expected,
                    "A law of pressure is a row of depths and a row of pressures of the same length.");
  };
  if (depths.size() != pressures.size())
    refuse(depths.empty() ? "pressures" : "depths",
           fmt::format("{} depths and {} pressures", depths.size(), pressures.size()), "one pressure for each depth");
  if (law.stiffness) refuse("depths", "a law of pressure beside a stiffness", "one of the two");
  if (law.stiffness_factor != 1.0) refuse("depths", "a law of pressure beside a stiffness_factor", "one of the two");
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (!(depths[i] > (i == 0 ? 0.0 : depths[i - 1])))
      refuse("depths", fmt::format("{:g} at position {}", depths[i], i + 1), "increasing depths, all above 0");
    if (!(pressures[i] > 0.0) || (i > 0 && pressures[i] < pressures[i - 1]))
      refuse("pressures", fmt::format("{:g} at position {}", pressures[i], i + 1),
             "positive pressures, none below the one before");
  }
}

void check_friction_law(const CaseContactLaw& law, const Node& node, const ReadContext& at) {
  if (!law.friction_law || find(node, "friction") == nullptr || law.friction == 0.0) return;
  throw CaseError(law.friction_law->where, at.at("friction_law").path, "a law of friction beside friction",
                  "one of the two", "Remove friction.");
}

}  // namespace

void check_pressures(const CaseContactLaw& law, const CaseScheme& scheme, const ContactPlace& at) {
  if (law.pressures->empty()) return;
  const EnforcementKind enforcement = **scheme.enforcement;
  if (enforcement == EnforcementKind::penalty && *scheme.kind != SchemeKind::energy_momentum) return;
  throw CaseError(
      law.pressures.where, at.path + ".pressures",
      fmt::format("a law of pressure with scheme.kind = \"{}\" and enforcement = \"{}\"", traits(*scheme.kind).name,
                  name(enforcement)),
      "enforcement = \"penalty\", and another scheme than energy_momentum",
      "Multipliers and impulses keep bodies from penetrating, and energy_momentum takes the mean of a spring "
      "over a step: neither asks for a pressure at a depth.");
}

void check_law(CaseContactLaw& law, const Node& node, const ReadContext& at) {
  check_table(law, node, at);
  check_friction_law(law, node, at);
  if (!law.initial_penetration && find(at.root, "initial_state") == nullptr)
    law.initial_penetration = InitialPenetration::refuse;
  if (law.tangential_stiffness && law.friction == 0.0 && !law.friction_law) {
    throw CaseError(place_of(node, "tangential_stiffness"), at.at("tangential_stiffness").path,
                    fmt::format("{} without friction", *law.tangential_stiffness),
                    "friction > 0 beside tangential_stiffness", "Add friction, or remove tangential_stiffness.");
  }
  check_stiffness(law, node, at);
}

}  // namespace carom
