#include <fmt/format.h>

#include "casefile/case.hpp"
#include "casefile/contact_keys.hpp"
#include "casefile/guide_keys.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

constexpr auto mandatory = KeyOptions::Need::required;

template <class Kind>
void add_body(SectionSchema<Kind>& s) {
  s.key_by("mass", [](auto& kind) -> auto& { return kind.body.mass; },
           "The obstacle is a free rigid body of this mass, which turns where it has an inertia and else does not. It "
           "belongs to this one contact.",
           {.unit = Dimension::mass, .range = greater_than(0.0)});
  s.key_by(
      "inertia", [](auto& kind) -> auto& { return kind.body.inertia; },
      "Moments of inertia [I_xx, I_yy, I_zz] of the free body about its centre of mass, along the axes; each smaller "
      "than the sum of the two others.",
      {.unit = Dimension::inertia});
  s.key_by("products_of_inertia", [](auto& kind) -> auto& { return kind.body.products_of_inertia; },
           "Entries [I_xy, I_yz, I_zx] of its inertia tensor, which are minus the integrals of the products of the "
           "coordinates.",
           {.unit = Dimension::inertia, .default_phrase = "0"});
  s.key_by("centre_of_mass", [](auto& kind) -> auto& { return kind.body.centre_of_mass; },
           "Of the free body that turns, at the start.",
           {.unit = Dimension::length,
            .aliases = {"center_of_mass"},
            .default_phrase = "sphere and box: their middle; the other kinds must have one"});
  s.key_by(
      "rigidity", [](auto& kind) -> auto& { return kind.body.rigidity; },
      "Of the free body that turns: frequency at which its axes vibrate about right angles, over the highest of the "
      "mesh. Its strain, which the verdict limits to 1e-3, falls with the square; above 1 explicit runs pay with their "
      "step.",
      {.range = greater_than(0.0), .default_phrase = "0.5"});
  add_guide_keys(
      s, [](auto& kind) -> auto& { return kind.body.guide; });
  s.key_by("angular_velocity", [](auto& kind) -> auto& { return kind.body.angular_velocity; },
           "The obstacle turns, by this many radians per time about an axis of this direction through its "
           "centre_of_rotation: imposed, times function; of a free body with an inertia: at the start.",
           {.unit = Dimension::angular_velocity, .default_phrase = "0"});
  s.key_by("centre_of_rotation", [](auto& kind) -> auto& { return kind.body.centre_of_rotation; },
           "A point of the axis of the imposed rotation, at the start; it travels with the imposed velocity.",
           {.unit = Dimension::length,
            .aliases = {"center_of_rotation"},
            .default_phrase =
                "sphere and box: their middle; a cylinder that turns about its own axis: its point; the others "
                "must have one"});
}

/// What a body that turns needs, and what only it may have.
template <class Kind>
void check_body(Kind& given, const Node& node, const ReadContext& at) {
  CaseRigidBody& body = given.body;
  if (body.inertia && !body.mass) {
    throw CaseError(body.inertia->where, at.at("inertia").path, "an inertia without a mass",
                    "the mass of a free body beside its inertia", "Add mass, or remove inertia.");
  }
  check_guide(body.guide, at);
  if (body.guide.blocked && !body.mass)
    throw CaseError(body.guide.blocked->where, at.at("blocked").path, "blocked without a mass",
                    "the mass of a free body",
                    "Without a mass the obstacle rests, or moves by its velocity alone: remove blocked, or add mass.");
  for (const char* key : {"products_of_inertia", "centre_of_mass", "rigidity", "blocked_turns", "blocked_at"}) {
    const Node* written = find(node, key);
    if (written == nullptr || body.inertia) continue;
    throw CaseError(written->where, at.at(key).path, fmt::format("{} without an inertia", key),
                    "the inertia of a free body that turns",
                    fmt::format("Add mass and inertia, or remove {}{}.", key,
                                given.turns() ? "; an imposed rotation has a centre_of_rotation" : ""));
  }
  if (body.angular_velocity && body.mass && !body.inertia)
    throw CaseError(body.angular_velocity->where, at.at("angular_velocity").path,
                    "an angular velocity beside a mass without an inertia",
                    "the inertia of a free body that turns, or no mass",
                    "Add inertia, or remove mass: the rotation is then imposed.");
  constexpr bool has_middle = requires {
    given.middle();
  };
  if (body.inertia && !has_middle && !body.centre_of_mass) {
    throw CaseError(body.inertia->where, at.at("inertia").path, "an inertia without a centre of mass",
                    "a centre_of_mass, which only spheres and boxes have by their shape", "Add centre_of_mass.");
  }
}

/// What an imposed rotation needs, and what only it may have. Fills its centre.
template <class Kind>
void check_rotation(Kind& given, const Node& node, const ReadContext& at) {
  CaseRigidBody& body = given.body;
  const bool is_led = body.angular_velocity && !body.mass;
  for (const char* key : {"centre_of_rotation", "angular_function"}) {
    const Node* written = find(node, key);
    if (written == nullptr || is_led) continue;
    if (body.mass)
      throw CaseError(
          written->where, at.at(key).path, fmt::format("{} of a free body", key),
          "an obstacle without a mass, whose rotation is imposed",
          fmt::format("A free body turns about its centre_of_mass as forces make it: remove {}, or mass.", key));
    throw CaseError(written->where, at.at(key).path, fmt::format("{} without an angular_velocity", key),
                    "an angular_velocity that is imposed", fmt::format("Add angular_velocity, or remove {}.", key));
  }
  if (!is_led) return;
  const Vec3& omega = **body.angular_velocity;
  const Location& where = body.angular_velocity->where;
  const std::string path = at.at("angular_velocity").path;
  if (norm(omega) == 0.0)
    throw CaseError(where, path, "[0, 0, 0], which is no rotation", "a direction and a rate, as [0, 0, 10]",
                    "Remove angular_velocity where the obstacle does not turn.");
  if (body.centre_of_rotation) return;
  if constexpr (requires { given.middle(); })
    body.centre_of_rotation = given.middle();
  else if constexpr (requires { given.middle_about(omega); })
    body.centre_of_rotation = given.middle_about(omega);
  if (body.centre_of_rotation) return;
  throw CaseError(
      where, path, "a rotation without a centre",
      "a centre_of_rotation, which only spheres, boxes and cylinders that turn about their own axis have by "
      "their shape",
      "Add centre_of_rotation, a point of the axis that it turns about.");
}

template <class Kind>
void check_obstacle(Kind& given, const Node& node, const ReadContext& at) {
  check_body(given, node, at);
  check_rotation(given, node, at);
  check_law(given.law, node, at);
  if (given.bar_radius && given.per_node) {
    throw CaseError(given.bar_radius->where, at.at("bar_radius").path, "a radius of bars with measure = \"node\"",
                    "measure = \"area\" with bars that touch with their sides",
                    "Nodes touch as points: remove bar_radius, or measure.");
  }
  const bool has_own = given.angular_function.has_value();
  const bool is_used = given.velocity || (given.body.angular_velocity && !has_own);
  if (!given.function || (is_used && !given.body.mass)) return;
  throw CaseError(given.function->where, at.at("function").path,
                  given.body.mass ? "a function beside a mass"
                  : has_own       ? "a function beside an angular_function, without a velocity"
                                  : "a function without a velocity",
                  "a velocity that is imposed",
                  has_own ? "Remove one of the two functions, or give velocity."
                          : "Remove function, or give velocity or angular_velocity and no mass.");
}

/// Begins with what all shapes have.
template <class Kind>
SectionSchema<Kind> obstacle_keys(const std::string& doc) {
  SectionSchema<Kind> s(doc);
  add_group(s);
  add_law(s);
  add_pressures(s);
  s.key_by("measure", [](auto& kind) -> auto& { return kind.per_node; },
           "What the stiffness is counted per: area of the faces, or node.", {.choices = {"area", "node"}});
  add_bar_radius(s);
  s.key_by("velocity", [](auto& kind) -> auto& { return kind.velocity; },
           "The obstacle moves: imposed velocity times function; with a mass: initial velocity, of the centre of mass.",
           {.unit = Dimension::velocity});
  s.key_by("function", [](auto& kind) -> auto& { return kind.function; },
           "NAME of a [functions.NAME] that multiplies what is imposed, velocity and angular velocity.",
           {.default_phrase = "constant 1"});
  add_body(s);
  s.key_by("angular_function", [](auto& kind) -> auto& { return kind.angular_function; },
           "NAME of a [functions.NAME] that multiplies the imposed angular velocity instead.",
           {.default_phrase = "function"});
  s.finish = check_obstacle<Kind>;
  return s;
}

template <class Kind>
void add_round(SectionSchema<Kind>& s) {
  s.key("radius", &Kind::radius, "Radius.", {.unit = Dimension::length, .range = greater_than(0.0), .need = mandatory});
  s.key("inside", &Kind::inside, "The body is inside of the shape.");
}

}  // namespace

SectionSchema<CasePlane> contact_keys(std::type_identity<CasePlane>) {
  auto s = obstacle_keys<CasePlane>("a rigid half-space");
  s.key("point", &CasePlane::point, "A point of the plane.", {.unit = Dimension::length, .need = mandatory});
  s.key("normal", &CasePlane::normal, "Direction from the plane to the body; of any length but 0.",
        {.need = mandatory});
  s.finish = [](CasePlane& given, const Node& node, const ReadContext& at) {
    check_obstacle(given, node, at);
    check_direction(given.normal, at.at("normal").path);
  };
  return s;
}

SectionSchema<CaseSphere> contact_keys(std::type_identity<CaseSphere>) {
  auto s = obstacle_keys<CaseSphere>("a rigid sphere");
  s.key("centre", &CaseSphere::centre, "Centre of the sphere.",
        {.unit = Dimension::length, .need = mandatory, .aliases = {"center"}});
  add_round(s);
  return s;
}

SectionSchema<CaseCylinder> contact_keys(std::type_identity<CaseCylinder>) {
  auto s = obstacle_keys<CaseCylinder>("a rigid cylinder");
  s.key("point", &CaseCylinder::point, "A point of the axis.", {.unit = Dimension::length, .need = mandatory});
  s.key("axis", &CaseCylinder::axis, "Direction of the cylinder, which is endless.", {.need = mandatory});
  add_round(s);
  s.finish = [](CaseCylinder& given, const Node& node, const ReadContext& at) {
    check_obstacle(given, node, at);
    check_direction(given.axis, at.at("axis").path);
  };
  return s;
}

SectionSchema<CaseBox> contact_keys(std::type_identity<CaseBox>) {
  auto s = obstacle_keys<CaseBox>("a rigid box along the axes");
  s.key("lower", &CaseBox::lower, "Corner of the box with the smallest coordinates.",
        {.unit = Dimension::length, .need = mandatory});
  s.key("upper", &CaseBox::upper, "Corner of the box with the largest coordinates.",
        {.unit = Dimension::length, .need = mandatory});
  s.finish = [](CaseBox& given, const Node& node, const ReadContext& at) {
    check_obstacle(given, node, at);
    for (std::size_t c = 0; c < 3; ++c) {
      if ((*given.upper)[c] > given.lower[c]) continue;
      throw CaseError(given.upper.where, at.at("upper").path,
                      fmt::format("{} against a lower of {}", (*given.upper)[c], given.lower[c]),
                      "larger coordinates than lower, all three");
    }
  };
  return s;
}

SectionSchema<CaseRigidSurface> contact_keys(std::type_identity<CaseRigidSurface>) {
  auto s = obstacle_keys<CaseRigidSurface>("a rigid surface of faces of the mesh");
  s.key("surface", &CaseRigidSurface::surface, "Group of the faces of the rigid surface, which belong to no part.",
        {.need = mandatory});
  return s;
}

void CaseObstacle::check_scheme(const CaseScheme& scheme, const ContactPlace& at) const {
  check_pressures(law, scheme, at);
  if (!body.inertia) return;
  check_guide(body.guide, scheme, at.path);
  if (has_inertia(*scheme.kind)) return;
  throw CaseError(body.inertia->where, at.path + ".inertia", "a body that turns, with statics",
                  "a scheme with inertia, or a free body without `inertia`, which does not turn",
                  "Nothing but contact holds the directions of such a body at rest.");
}

}  // namespace carom
