#include "casefile/case_schema.hpp"
#include "casefile/section_rules.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;
using Names = std::vector<std::string>;

const Names obstacles{"plane", "sphere", "cylinder", "box", "surface"};
const Names pairs{"pair", "self", "all"};

Names joined(Names a, const Names& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void add_surfaces(SectionSchema<CaseContact>& s) {
  s.key(
      "group", &CaseContact::group,
      "Group of cells (interface), of faces or nodes that may touch (obstacles), of slave faces (pair, tie), of faces "
      "(self), of nodes (stop).",
      {.kinds = joined(obstacles, {"interface", "pair", "self", "stop", "tie"}),
       .need = Need::required,
       .aliases = {"slave"}});
  s.key("master", &CaseContact::master, "Group of faces of the other body; the coarser or stiffer one.",
        {.kinds = {"pair", "tie"}, .need = Need::required});
  s.key("exclude", &CaseContact::exclude, "Groups whose faces take no part.", {.kinds = {"all"}});
  s.key("method", &CaseContact::method,
        "Where the gap is measured: at the nodes of one side, of both, or over the overlaps of the faces. faces, for "
        "the penalty alone, integrates the penetration from both sides: pressure is exact across meshes that match or "
        "not, of first and second order, and what lies between nodes is seen. Both sides' nodes (two_pass) sink "
        "nowhere; surface_to_surface sees the mean gap of a node's faces: pressure is exact across flat meshes, and a "
        "coarse curved face sinks in by part of its rise.",
        {.choices = {"node_to_surface", "two_pass", "surface_to_surface", "faces"},
         .kinds = pairs,
         .default_phrase = "faces in statics with penalty alone, else two_pass"});
}

void add_law(SectionSchema<CaseContact>& s) {
  const Names chosen = joined(joined(obstacles, pairs), {"interface"});
  const std::string automatic = "from the material and the size of the cells";
  const Names aliases{"penalty", "eps_N", "E_n"};
  s.key("stiffness", &CaseContact::stiffness,
        "Normal stress per penetration; with measure = \"node\": force of a node per penetration.",
        {.unit = Dimension::stress_per_length,
         .range = greater_than(0.0),
         .kinds = chosen,
         .aliases = aliases,
         .default_phrase = automatic});
  s.key("stiffness", &CaseContact::stiffness,
        "Stress per distance that the surfaces part, where the scheme is implicit and ties by springs (enforcement = "
        "\"penalty\" or \"augmented_lagrangian\").",
        {.unit = Dimension::stress_per_length,
         .range = greater_than(0.0),
         .kinds = {"tie"},
         .aliases = aliases,
         .default_phrase = automatic});
  s.key("stiffness", &CaseContact::stiffness, "Force of a node per penetration.",
        {.unit = Dimension::force_per_length,
         .range = greater_than(0.0),
         .kinds = {"stop"},
         .required_for = {"stop"},
         .aliases = aliases});
  s.key("stiffness_factor", &CaseContact::stiffness_factor,
        "Multiplies the stiffness that is chosen where none is given.",
        {.range = greater_than(0.0), .kinds = joined(chosen, {"tie"})});
  s.key("measure", &CaseContact::per_node, "What the stiffness is counted per: area of the faces, or node.",
        {.choices = {"area", "node"}, .kinds = obstacles});
  s.key("tangential_stiffness", &CaseContact::tangential_stiffness,
        "As stiffness, for the sliding that regularised friction resists.",
        {.unit = Dimension::stress_per_length,
         .range = greater_than(0.0),
         .kinds = chosen,
         .aliases = {"eps_T", "E_t"},
         .default_phrase = "with friction: as stiffness"});
  s.key("friction", &CaseContact::friction, "Coulomb's coefficient of friction mu.",
        {.range = at_least(0.0), .kinds = chosen, .aliases = {"mu"}});
  s.key(
      "restitution", &CaseContact::restitution,
      "Newton's coefficient: separating over approaching speed, for enforcement = \"impulse\".",
      {.range = {Bound{0.0, Bound::Side::closed}, Bound{1.0, Bound::Side::closed}}, .kinds = chosen, .aliases = {"e"}});
  s.key("initial_penetration", &CaseContact::initial_penetration,
        "What to do where bodies overlap at the start: refuse the case, take the overlap as the zero of the gap (no "
        "strain), or keep it as prestress.",
        {.choices = {"refuse", "offset", "prestress"},
         .kinds = chosen,
         .default_phrase = "\"refuse\"; with [initial_state] \"prestress\" to a quarter of a cell"});
}

void add_shapes(SectionSchema<CaseContact>& s) {
  const Names round{"sphere", "cylinder"};
  const KeyOptions::Need needed = Need::required;
  s.key("point", &CaseContact::point, "A point of the plane, or of the axis of the cylinder.",
        {.unit = Dimension::length, .kinds = {"plane", "cylinder"}, .need = needed});
  s.key("normal", &CaseContact::normal,
        "Direction from the plane to the body, or from the stop to the node; of any length but 0.",
        {.kinds = {"plane", "stop"}, .need = needed});
  s.key("centre", &CaseContact::centre, "Centre of the sphere.",
        {.unit = Dimension::length, .kinds = {"sphere"}, .need = needed, .aliases = {"center"}});
  s.key("axis", &CaseContact::axis, "Direction of the cylinder, which is endless.",
        {.kinds = {"cylinder"}, .need = needed});
  s.key("radius", &CaseContact::radius, "Radius.",
        {.unit = Dimension::length, .range = greater_than(0.0), .kinds = round, .need = needed});
  s.key("inside", &CaseContact::inside, "The body is inside of the shape.", {.kinds = round});
  s.key("lower", &CaseContact::lower, "Corner of the box with the smallest coordinates.",
        {.unit = Dimension::length, .kinds = {"box"}, .need = needed});
  s.key("upper", &CaseContact::upper, "Corner of the box with the largest coordinates.",
        {.unit = Dimension::length, .kinds = {"box"}, .need = needed});
  s.key("surface", &CaseContact::surface, "Group of the faces of the rigid surface, which belong to no part.",
        {.kinds = {"surface"}, .need = needed});
  s.key("velocity", &CaseContact::velocity,
        "The obstacle moves, without turning: imposed velocity times function; with a mass: initial velocity, of the "
        "centre of mass.",
        {.unit = Dimension::velocity, .kinds = obstacles});
  s.key("function", &CaseContact::function, "NAME of a [functions.NAME] that multiplies the imposed velocity.",
        {.kinds = obstacles, .default_phrase = "constant 1"});
  s.key("mass", &CaseContact::mass,
        "The obstacle is a free rigid body of this mass, which turns where it has an inertia and else does not. It "
        "belongs to this one contact.",
        {.unit = Dimension::mass, .range = greater_than(0.0), .kinds = obstacles});
  s.key("inertia", &CaseContact::inertia,
        "Moments of inertia [I_xx, I_yy, I_zz] of the free body about its centre of mass, along the axes; each smaller "
        "than the sum of the two others.",
        {.unit = Dimension::inertia, .kinds = obstacles});
  s.key("products_of_inertia", &CaseContact::products_of_inertia,
        "Entries [I_xy, I_yz, I_zx] of its inertia tensor, which are minus the integrals of the products of the "
        "coordinates.",
        {.unit = Dimension::inertia, .kinds = obstacles, .default_phrase = "0"});
  s.key("centre_of_mass", &CaseContact::centre_of_mass, "Of the free body that turns, at the start.",
        {.unit = Dimension::length,
         .kinds = obstacles,
         .aliases = {"center_of_mass"},
         .default_phrase = "sphere and box: their middle; the other kinds must have one"});
  s.key(
      "rigidity", &CaseContact::rigidity,
      "Of the free body that turns: frequency at which its axes vibrate about right angles, over the highest of the "
      "mesh. Its strain, which the verdict limits to 1e-3, falls with the square; above 1 explicit runs pay with their "
      "step.",
      {.range = greater_than(0.0), .kinds = obstacles, .default_phrase = "0.5"});
  s.key("angular_velocity", &CaseContact::angular_velocity, "Of the free body that turns, at the start; radians.",
        {.unit = Dimension::angular_velocity, .kinds = obstacles, .default_phrase = "0"});
}

void add_tie(SectionSchema<CaseContact>& s) {
  s.key("method", &CaseContact::tie_method,
        "What is tied: each slave node to its nearest place on the master; or the means over the overlaps of the faces "
        "(mortar), which carry uniform stress exactly across meshes that do not match.",
        {.choices = {"node_to_surface", "surface_to_surface"}, .kinds = {"tie"}});
  s.key(
      "tolerance", &CaseContact::tolerance,
      "Largest distance of a slave node from the nearest master face that is tied, over the size of that face (root of "
      "its area, or its length).",
      {.range = at_least(0.0), .kinds = {"tie"}});
  s.key("distance", &CaseContact::distance, "The same as a length, in the place of `tolerance`.",
        {.unit = Dimension::length,
         .range = at_least(0.0),
         .kinds = {"tie"},
         .default_phrase = "tolerance times the size of the face"});
  s.key("far", &CaseContact::far,
        "What to do about slave nodes that are farther away: refuse the case, or leave them free.",
        {.choices = {"refuse", "leave"}, .kinds = {"tie"}});
}

}  // namespace

SectionSchema<CaseContact> contact_section() {
  SectionSchema<CaseContact> s(
      "Who touches whom: interface cells of zero thickness, rigid obstacles (plane, sphere, cylinder, box, surface), "
      "two deformable surfaces (pair), one with itself (self), all exterior surfaces with each other (all), "
      "discrete stops on nodes, or who stays together: two surfaces that are glued (tie).");
  s.description.selector = "kind";
  s.key("name", &CaseContact::name, "Name in results and in [[check]].", {.need = Need::required});
  s.key(
      "kind", &CaseContact::kind, "What touches; decides which of the other keys are taken.",
      {.choices = {"interface", "plane", "sphere", "cylinder", "box", "surface", "pair", "self", "all", "stop", "tie"},
       .need = Need::required});
  s.key("moment_point", &CaseContact::moment_point, "Point about which contact.csv gives the moment of the contact.",
        {.unit = Dimension::length});
  add_surfaces(s);
  add_law(s);
  add_shapes(s);
  s.key("gap", &CaseContact::gap, "Distance that a node moves before it touches.",
        {.unit = Dimension::length, .kinds = {"stop"}});
  s.key("damping", &CaseContact::damping, "Force of a node per closing speed, while it touches.",
        {.unit = Dimension::damping, .range = at_least(0.0), .kinds = {"stop"}});
  s.key("damper", &CaseContact::damper,
        "How the damping acts while the node touches: so that the stop never pulls (compression), or also holding the "
        "node back when it moves off (two_sided).",
        {.choices = {"compression", "two_sided"}, .kinds = {"stop"}});
  add_tie(s);
  s.finish = check_contact;
  return s;
}

}  // namespace carom
