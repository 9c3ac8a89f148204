#include "build/rigid_bodies.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "build/guides.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

/// Where a body turns about, unless the case says: the middle of its shape. The reader asks where there is none.
Vec3 middle_of(const CaseContact& contact) {
  return std::visit(
      [](const auto& kind) {
        if constexpr (requires { kind.middle(); })
          return kind.middle();
        else
          return Vec3{};
      },
      contact.of);
}

/// Where the carrier of an obstacle stands that does not turn.
Vec3 stand_of(const CaseContact& contact) {
  return std::visit(
      [](const auto& kind) {
        if constexpr (requires { kind.stand(); })
          return kind.stand();
        else
          return Vec3{};
      },
      contact.of);
}

/// `size` of one that is led.
TurningBody body_of(const CaseContact& contact, double size) {
  const CaseRigidBody& given = contact.obstacle()->body;
  if (!given.mass) {
    TurningBody body = make_led_body(*given.centre_of_rotation, normalized(**given.angular_velocity), size);
    body.name = *contact.name;
    return body;
  }
  try {
    TurningBody body = make_turning_body(*given.mass, given.centre_of_mass.value_or(middle_of(contact)),
                                         **given.inertia, given.products_of_inertia.value_or(Vec3{}));
    body.name = *contact.name;
    body.rigidity = given.rigidity.value_or(body.rigidity);
    return body;
  } catch (const std::invalid_argument& e) {
    throw CaseError(given.inertia->where, "contact.inertia", e.what(),
                    "moments about the centre of mass, each smaller than the sum of the two others",
                    "A rod or a disc without thickness has no such body: give it the thickness that it has.");
  }
}

}  // namespace

std::size_t carrier_nodes(const CaseContact& contact) {
  const CaseObstacle* obstacle = contact.obstacle();
  if (obstacle == nullptr || !obstacle->moves()) return 0;
  return obstacle->turns() ? 4 : 1;
}

std::size_t carrier_nodes(const Case& given) {
  std::size_t count = 0;
  for (const CaseContact& contact : given.contacts) count += carrier_nodes(contact);
  return count;
}

std::vector<Vec3> carrier_positions(const CaseContact& contact, double size) {
  if (carrier_nodes(contact) == 0) return {};
  if (!contact.obstacle()->turns()) return {stand_of(contact)};
  const TurningBody body = body_of(contact, size);
  return {corner(body, 0), corner(body, 1), corner(body, 2), corner(body, 3)};
}

void add_body(const CaseContact& contact, Index first, ObstacleContact& obstacle, Model& model) {
  const CaseObstacle& given = *contact.obstacle();
  const Vec3 velocity = given.velocity.value_or(Vec3{});
  const Vec3 spin = given.body.angular_velocity ? **given.body.angular_velocity : Vec3{};
  const CaseGuide& guide = given.body.guide;
  if (!given.turns()) {
    obstacle.carrier = first;
    model.initial.push_back({{first}, {}, {velocity}});
    if (!given.body.mass) return;
    model.rigid_bodies.push_back({*contact.name, first, *given.body.mass});
    refuse_guided_motion(guide, "contact", *contact.name, {}, velocity, spin);
    for (std::size_t c = 0; c < 3; ++c)
      if (guide.holds_along(c))
        model.motions.push_back({fmt::format("blocked of contact \"{}\" (line {})", *contact.name, contact.where.line),
                                 {first},
                                 static_cast<int>(c),
                                 MotionKind::velocity,
                                 {{0.0}, {0.0}}});
    return;
  }
  const Vec3& X = model.mesh->coordinates[static_cast<std::size_t>(first)];
  TurningBody body = body_of(contact, norm(subtract(X, given.body.centre_of_rotation.value_or(Vec3{}))));
  for (std::size_t a = 0; a < 4; ++a) {
    body.nodes[a] = first + static_cast<Index>(a);
    const Vec3 v = add(velocity, cross(spin, subtract(corner(body, a), body.centre)));
    model.initial.push_back({{body.nodes[a]}, {}, {v}});
  }
  if (!body.is_led()) {
    refuse_guided_motion(guide, "contact", body.name, body.centre, velocity, spin);
    add_guide(guide, body, contact.where, model);
  }
  obstacle.body = static_cast<Index>(model.turning_bodies.size());
  model.turning_bodies.push_back(std::move(body));
}

}  // namespace carom
