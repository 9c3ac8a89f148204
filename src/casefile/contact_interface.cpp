#include "casefile/contact_keys.hpp"

namespace carom {

SectionSchema<CaseInterface> contact_keys(std::type_identity<CaseInterface>) {
  SectionSchema<CaseInterface> s("cells of zero thickness between two bodies");
  add_group(s);
  add_law(s);
  add_pressures(s);
  s.finish = [](CaseInterface& given, const Node& node, const ReadContext& at) { check_law(given.law, node, at); };
  return s;
}

void CaseInterface::check_scheme(const CaseScheme& scheme, const ContactPlace& at) const {
  check_pressures(law, scheme, at);
}

}  // namespace carom
