#include <fmt/format.h>

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

void check_law(CaseContactLaw& law, const Node& node, const ReadContext& at) {
  if (!law.initial_penetration && find(at.root, "initial_state") == nullptr)
    law.initial_penetration = InitialPenetration::refuse;
  if (law.tangential_stiffness && law.friction == 0.0) {
    throw CaseError(place_of(node, "tangential_stiffness"), at.at("tangential_stiffness").path,
                    fmt::format("{} without friction", *law.tangential_stiffness),
                    "friction > 0 beside tangential_stiffness", "Add friction, or remove tangential_stiffness.");
  }
  check_stiffness(law, node, at);
}

}  // namespace carom
