#include "casefile/case_schema.hpp"
#include "casefile/section_rules.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

KeyOptions stiffness_options(Dimension unit, std::vector<std::string> kinds) {
  return {.unit = unit,
          .range = greater_than(0.0),
          .kinds = std::move(kinds),
          .need = Need::required,
          .aliases = {"penalty", "eps_N", "E_n"}};
}

void add_stiffness(Section<CaseContact>& s) {
  s.key("stiffness", &CaseContact::stiffness, "Normal stress per penetration.",
        stiffness_options(Dimension::stress_per_length, {"interface"}));
  s.key("stiffness", &CaseContact::stiffness,
        "Normal stress per penetration; with measure = \"node\": force of a node per penetration.",
        stiffness_options(Dimension::stress_per_length, {"plane"}));
  s.key("stiffness", &CaseContact::stiffness, "Force of a node per penetration.",
        stiffness_options(Dimension::force_per_length, {"stop"}));
}

}  // namespace

Section<CaseContact> contact_section() {
  const std::vector<std::string> stop{"stop"};
  const std::vector<std::string> frictional{"interface", "plane"};
  Section<CaseContact> s(
      "Penalty contact: interface cells of zero thickness, a rigid plane, or discrete stops on nodes.");
  s.description.selector = "kind";
  s.key("name", &CaseContact::name, "Name in results and in [[check]].", {.need = Need::required});
  s.key("kind", &CaseContact::kind, "What touches; decides which of the other keys are taken.",
        {.choices = {"interface", "plane", "stop"}, .need = Need::required});
  s.key("group", &CaseContact::group, "Group of cells (interface), of faces or nodes (plane), of nodes (stop).",
        {.need = Need::required});
  add_stiffness(s);
  s.key("measure", &CaseContact::per_node, "What the stiffness is counted per: area of the faces, or node.",
        {.choices = {"area", "node"}, .kinds = {"plane"}});
  s.key(
      "tangential_stiffness", &CaseContact::tangential_stiffness,
      "As stiffness, for the sliding that Coulomb friction resists.",
      {.unit = Dimension::stress_per_length, .range = at_least(0.0), .kinds = frictional, .aliases = {"eps_T", "E_t"}});
  s.key("friction", &CaseContact::friction, "Coulomb's coefficient of friction mu.",
        {.range = at_least(0.0), .kinds = frictional, .aliases = {"mu"}});
  s.key("point", &CaseContact::point, "A point of the plane.",
        {.unit = Dimension::length, .kinds = {"plane"}, .need = Need::required});
  s.key("normal", &CaseContact::normal,
        "Direction from the plane to the body, or from the stop to the node; of any length but 0.",
        {.kinds = {"plane", "stop"}, .need = Need::required});
  s.key("gap", &CaseContact::gap, "Distance that a node moves before it touches.",
        {.unit = Dimension::length, .kinds = stop});
  s.key("damping", &CaseContact::damping, "Force of a node per closing speed, while it touches.",
        {.unit = Dimension::damping, .range = at_least(0.0), .kinds = stop});
  s.finish = check_contact;
  return s;
}

}  // namespace carom
