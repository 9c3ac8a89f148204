#include "run/rigid_bodies.hpp"

#include <numeric>
#include <optional>
#include <stdexcept>

#include "math/vec3.hpp"

namespace carom {

namespace {

/// Where a body turns about, unless the case says: the middle of its shape.
Vec3 middle_of(const CaseContact& contact) {
  if (*contact.kind == CaseContact::Kind::sphere) return contact.centre;
  return scaled(add(contact.lower, *contact.upper), 0.5);  // a box; the reader asks for all others
}

TurningBody body_of(const CaseContact& contact) {
  try {
    TurningBody body = make_turning_body(*contact.mass, contact.centre_of_mass.value_or(middle_of(contact)),
                                         **contact.inertia, contact.products_of_inertia.value_or(Vec3{}));
    body.name = *contact.name;
    body.rigidity = contact.rigidity.value_or(body.rigidity);
    return body;
  } catch (const std::invalid_argument& e) {
    throw CaseError(contact.inertia->where, "contact.inertia", e.what(),
                    "moments about the centre of mass, each smaller than the sum of the two others",
                    "A rod or a disc without thickness has no such body: give it the thickness that it has.");
  }
}

}  // namespace

std::size_t carrier_nodes(const CaseContact& contact) {
  if (contact.inertia) return 4;
  return contact.velocity || contact.mass ? 1 : 0;
}

std::size_t carrier_nodes(const Case& given) {
  return std::accumulate(given.contacts.begin(), given.contacts.end(), std::size_t{0},
                         [](std::size_t sum, const CaseContact& contact) { return sum + carrier_nodes(contact); });
}

std::vector<Vec3> carrier_positions(const CaseContact& contact) {
  if (carrier_nodes(contact) == 0) return {};
  if (!contact.inertia) return {*contact.kind == CaseContact::Kind::sphere ? contact.centre : contact.point};
  const TurningBody body = body_of(contact);
  return {corner(body, 0), corner(body, 1), corner(body, 2), corner(body, 3)};
}

void add_free_body(const CaseContact& contact, Index first, ObstacleContact& obstacle, Model& model) {
  const Vec3 velocity = contact.velocity.value_or(Vec3{});
  if (!contact.inertia) {
    obstacle.carrier = first;
    model.initial.push_back({{first}, {}, {velocity}});
    model.rigid_bodies.push_back({*contact.name, first, *contact.mass});
    return;
  }
  TurningBody body = body_of(contact);
  const Vec3 spin = contact.angular_velocity.value_or(Vec3{});
  for (std::size_t a = 0; a < 4; ++a) {
    body.nodes[a] = first + static_cast<Index>(a);
    const Vec3 v = add(velocity, cross(spin, subtract(corner(body, a), body.centre)));
    model.initial.push_back({{body.nodes[a]}, {}, {v}});
  }
  obstacle.body = static_cast<Index>(model.turning_bodies.size());
  model.turning_bodies.push_back(std::move(body));
}

}  // namespace carom
