#include "casefile/case_schema.hpp"
#include "casefile/guide_keys.hpp"

namespace carom {

namespace {

/// Without cells everything has to be given; what only an inertia of one's own has is nothing without it.
void check_rigid_body(CaseRigidPart& body, const Node&, const ReadContext& at) {
  check_guide(body.guide, at);
  if (body.products_of_inertia && !body.inertia)
    throw CaseError(body.where, at.at("products_of_inertia").path, "products of inertia without moments",
                    "inertia beside them", "Add inertia, or leave them out: cells have their own.");
  if (!body.parts.empty() || (body.mass && body.inertia && body.centre_of_mass)) return;
  throw CaseError(body.where, at.path, "a body without cells", "its parts, or mass, inertia and centre_of_mass",
                  "Name the [[part]]s that are rigid.");
}

}  // namespace

SectionSchema<CaseRigidPart> rigid_body_section() {
  SectionSchema<CaseRigidPart> s(
      "Cells that move as one rigid body, which moves and turns freely, or as its guide lets it. It has the mass and the inertia of its cells, or those "
      "that are given; contacts, loads, supports, initial velocities and probes take its faces and nodes as those of "
      "any part. Nodes that deformable parts share with it, and `nodes`, are joined to it. Its material gives the "
      "density and, to contact, the stiffness of its faces. For schemes with inertia.");
  s.key("name", &CaseRigidPart::name, "Name in messages.", {.need = KeyOptions::Need::required});
  s.key("parts", &CaseRigidPart::parts, "Names of [[part]]s of solid cells.");
  s.key("nodes", &CaseRigidPart::nodes, "Group of nodes of deformable parts that are joined to the body.");
  s.key("points", &CaseRigidPart::points,
        "Group of nodes of no part that go along with the body: forces act there, probes follow them.");
  s.key("mass", &CaseRigidPart::mass, "Instead of that of the cells, whose inertia changes by the same factor.",
        {.unit = Dimension::mass, .range = greater_than(0.0), .default_phrase = "that of the cells"});
  s.key("centre_of_mass", &CaseRigidPart::centre_of_mass, "At the start.",
        {.unit = Dimension::length, .aliases = {"center_of_mass"}, .default_phrase = "that of the cells"});
  s.key("inertia", &CaseRigidPart::inertia,
        "Moments of inertia [I_xx, I_yy, I_zz] about the centre of mass, along the axes; each smaller than the sum of "
        "the two others.",
        {.unit = Dimension::inertia, .default_phrase = "that of the cells"});
  s.key("products_of_inertia", &CaseRigidPart::products_of_inertia,
        "Entries [I_xy, I_yz, I_zx] of its inertia tensor, which are minus the integrals of the products of the "
        "coordinates.",
        {.unit = Dimension::inertia, .default_phrase = "0 beside inertia"});
  s.key("rigidity", &CaseRigidPart::rigidity,
        "Frequency at which the axes of the body vibrate about right angles, over the highest of the mesh. Its strain, "
        "which the verdict limits to 1e-3, falls with the square; above 1 explicit runs may pay with their step.",
        {.range = greater_than(0.0), .default_phrase = "3"});
  add_guide_keys(
      s, [](auto& body) -> auto& { return body.guide; });
  s.finish = check_rigid_body;
  return s;
}

}  // namespace carom
