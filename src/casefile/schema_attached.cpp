#include "casefile/case_schema.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

/// Springs along the line to other nodes need both ends, springs to the ground none but their own.
void check_spring(CaseSpring& spring, const Node&, const ReadContext& at) {
  if (spring.to.has_value() == spring.axial.has_value()) {
    if (spring.axial) return;
    const Located<Vec3>& k = spring.stiffness ? *spring.stiffness : *spring.total_stiffness;
    if ((*k)[0] > 0.0 || (*k)[1] > 0.0 || (*k)[2] > 0.0) return;
    throw CaseError(k.where, at.at(spring.stiffness ? "stiffness" : "total_stiffness").path,
                    "no stiffness in any direction", "a stiffness above 0 in one direction at least");
  }
  if (spring.to) {
    throw CaseError(spring.to->where, at.at("to").path, "other ends with a stiffness along x, y and z",
                    "axial beside `to`", "Springs between nodes act along their line; remove `to` for the ground.");
  }
  throw CaseError(spring.where, at.at("axial").path, "an axial stiffness without other ends",
                  "the group `to` of the nodes at the other ends", "For springs to the ground give stiffness instead.");
}

}  // namespace

SectionSchema<CasePointMass> point_mass_section() {
  SectionSchema<CasePointMass> s(
      "Masses at the nodes of a group, besides those of their cells: for what is fastened to a body and not meshed. "
      "They have no moments of inertia of their own; gravity pulls at them; mass = \"modified\" moves "
      "those of contact nodes as it does the mass of cells.");
  s.key("nodes", &CasePointMass::nodes, "Group of nodes or cells.", {.need = Need::required});
  s.key("mass", &CasePointMass::mass, "Mass of each node.", {.unit = Dimension::mass, .range = greater_than(0.0)});
  s.key("total", &CasePointMass::total, "Mass of all nodes together, in equal shares.",
        {.unit = Dimension::mass, .range = greater_than(0.0)});
  s.description.alternatives = {{Alternatives::Count::exactly_one, {"mass", "total"}}};
  return s;
}

SectionSchema<CaseErosion> erosion_section() {
  SectionSchema<CaseErosion> s(
      "Cells that go: when one of the criteria is reached at the end of a step, a cell of the part has no forces any "
      "more from there on. Its mass stays at its nodes, what it has stored and spent becomes `eroded`, and the faces "
      "behind it join the contacts that its own faces had, in the same step. For explicit schemes.");
  s.key("part", &CaseErosion::part, "Name of a [[part]].", {.need = Need::required});
  s.key("plastic_strain", &CaseErosion::plastic_strain, "Equivalent plastic strain, the largest of the cell's points.",
        {.unit = Dimension::none, .range = greater_than(0.0)});
  s.key("damage", &CaseErosion::damage,
        "Damage of the material (materials.NAME.damage: fracture at 1), the largest of the cell's points.",
        {.unit = Dimension::none, .range = greater_than(0.0)});
  s.key(
      "distortion", &CaseErosion::distortion,
      "A corner of the cell keeps no more than this share of the volume that it had at rest: cells that are crushed go "
      "before they fold or hold up the run by their short steps.",
      {.range = between_open(0.0, 1.0)});
  s.key("time", &CaseErosion::time, "At the first step that ends there or later all cells of the part go.",
        {.unit = Dimension::time, .range = greater_than(0.0)});
  s.description.alternatives = {
      {Alternatives::Count::at_least_one, {"plastic_strain", "damage", "distortion", "time"}}};
  return s;
}

SectionSchema<CaseSpring> spring_section() {
  SectionSchema<CaseSpring> s(
      "Linear springs without mass at each node of a group: to the ground along the axes, or to the nodes of another "
      "group along the line between them at the start. They push and pull, and store what the energies call strain. "
      "Their directions do "
      "not turn: beside finite rotations that costs the balance of angular momentum the sideways motion of their "
      "ends.");
  s.key("nodes", &CaseSpring::nodes, "Group of nodes or cells.", {.need = Need::required});
  s.key("stiffness", &CaseSpring::stiffness, "To the ground: force of each node per displacement along x, y and z.",
        {.unit = Dimension::force_per_length, .range = at_least(0.0)});
  s.key("total_stiffness", &CaseSpring::total_stiffness,
        "The same of all nodes together, in equal shares: does not depend on the mesh.",
        {.unit = Dimension::force_per_length, .range = at_least(0.0)});
  s.key("to", &CaseSpring::to,
        "Group of the other ends: one node for all springs, or as many as `nodes`, each the nearest of one.");
  s.key("axial", &CaseSpring::axial, "Force of each spring to `to` per elongation.",
        {.unit = Dimension::force_per_length, .range = greater_than(0.0)});
  s.description.alternatives = {{Alternatives::Count::exactly_one, {"stiffness", "total_stiffness", "axial"}}};
  s.finish = check_spring;
  return s;
}

}  // namespace carom
