#include "casefile/case_schema.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;
using Names = std::vector<std::string>;

KeyOptions positive(Dimension unit, Names kinds) {
  return {.unit = unit, .range = greater_than(0.0), .kinds = std::move(kinds), .need = Need::required};
}

KeyOptions not_negative(Dimension unit, Names kinds) {
  return {.unit = unit, .range = at_least(0.0), .kinds = std::move(kinds)};
}

SectionSchema<CaseExactBar> second_bar_section() {
  SectionSchema<CaseExactBar> s("With two_bars: the bar on the positive side of the axis.");
  s.key("length", &CaseExactBar::length, "Length.", positive(Dimension::length, {}));
  s.key("area", &CaseExactBar::area, "Section.", positive(Dimension::area, {}));
  s.key("modulus", &CaseExactBar::modulus, "Stress per axial strain.", positive(Dimension::stress, {}));
  s.key("density", &CaseExactBar::density, "Density.", positive(Dimension::density, {}));
  s.key("speed", &CaseExactBar::speed, "Velocity along the axis at the start.", {.unit = Dimension::velocity});
  return s;
}

void add_bodies(SectionSchema<CaseExact>& s) {
  const Names walls{"bar_on_rigid_wall", "bar_on_penalty_wall"};
  const Names bars{"bar_on_rigid_wall", "bar_on_penalty_wall", "bar_on_free_mass", "bouncing_bar", "two_bars"};
  const Names elastic{"bar_on_rigid_wall", "bar_on_penalty_wall", "bar_on_free_mass", "bouncing_bar",
                      "two_bars",          "sphere_on_rigid_wall"};
  s.key("length", &CaseExact::length, "Length of the bar.", positive(Dimension::length, bars));
  s.key("area", &CaseExact::area, "Section of the bar.", positive(Dimension::area, bars));
  s.key("modulus", &CaseExact::modulus,
        "Bars: stress per axial strain, E for nu = 0 or free sides, E (1 - nu) / ((1 + nu) (1 - 2 nu)) for blocked "
        "sides. Sphere: Young's modulus.",
        positive(Dimension::stress, elastic));
  s.key("poisson", &CaseExact::poisson, "Poisson's ratio of the sphere.",
        {.range = between_open(-1.0, 0.5), .kinds = {"sphere_on_rigid_wall"}});
  s.key("density", &CaseExact::density, "Density.", positive(Dimension::density, bars));
  s.key(
      "mass", &CaseExact::mass, "Mass of the body; of the rigid one that the bar hits.",
      positive(Dimension::mass, {"bar_on_free_mass", "sphere_on_rigid_wall", "sliding_block", "friction_oscillator"}));
  s.key("radius", &CaseExact::radius, "Radius of the sphere.", positive(Dimension::length, {"sphere_on_rigid_wall"}));
}

}  // namespace

SectionSchema<CaseExact> exact_section() {
  SectionSchema<CaseExact> s("Exact solution of the case, for checks and curves; the motion is along one axis.");
  s.description.selector = "solution";
  s.key("solution", &CaseExact::solution, "Which solution.",
        {.choices = {"bar_on_rigid_wall", "bar_on_penalty_wall", "bar_on_free_mass", "bouncing_bar", "two_bars",
                     "sphere_on_rigid_wall", "sliding_block", "friction_oscillator"},
         .need = Need::required});
  add_bodies(s);
  s.key("speed", &CaseExact::speed, "Speed towards the wall; of a block or of the first of two bars, along the axis.",
        {.unit = Dimension::velocity,
         .kinds = {"bar_on_rigid_wall", "bar_on_penalty_wall", "bar_on_free_mass", "bouncing_bar", "two_bars",
                   "sphere_on_rigid_wall", "sliding_block"},
         .required_for = {"bar_on_rigid_wall", "bar_on_penalty_wall", "bar_on_free_mass", "sphere_on_rigid_wall",
                          "two_bars"}});
  s.key("gap", &CaseExact::gap, "Distance to the wall, or between the bars, at the start.",
        not_negative(Dimension::length, {"bar_on_rigid_wall", "bar_on_penalty_wall", "bar_on_free_mass", "bouncing_bar",
                                         "two_bars", "sphere_on_rigid_wall"}));
  s.key("stiffness", &CaseExact::stiffness, "Stress per penetration of the wall.",
        positive(Dimension::stress_per_length, {"bar_on_penalty_wall"}));
  s.key("stiffness", &CaseExact::stiffness, "Of the spring.",
        positive(Dimension::force_per_length, {"friction_oscillator"}));
  s.key("gravity", &CaseExact::gravity, "Acceleration of gravity.",
        not_negative(Dimension::acceleration, {"bouncing_bar", "sliding_block", "friction_oscillator"}));
  s.key("friction", &CaseExact::friction, "Coulomb's coefficient.",
        not_negative(Dimension::none, {"sliding_block", "friction_oscillator"}));
  s.key("angle", &CaseExact::angle, "Slope of the incline, in radians.",
        not_negative(Dimension::none, {"sliding_block"}));
  s.key("initial_displacement", &CaseExact::initial_displacement,
        "Added to displacements; where the oscillator is released.",
        {.unit = Dimension::length,
         .kinds = {"bar_on_rigid_wall", "bar_on_penalty_wall", "bar_on_free_mass", "friction_oscillator"}});
  s.table("second", &CaseExact::second, second_bar_section());
  s.key("axis", &CaseExact::axis,
        "Axis of the motion. A bar or sphere flies in the negative direction; of two bars the first part lies on the "
        "negative side.",
        {.choices = {"x", "y", "z"}});
  s.finish = [](CaseExact& exact, const Node& node, const ReadContext& at) {
    const bool two = *exact.solution == "two_bars";
    if (two == exact.second.has_value()) return;
    const Node* second = find(node, "second");
    throw CaseError(second != nullptr ? second->where : node.where, at.at("second").path,
                    two ? "nothing" : "a second bar", two ? "a section [exact.second]" : "it only with two_bars");
  };
  return s;
}

}  // namespace carom
