// Rigid bodies that turn, for the tests of solid, contact and schemes.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "math/vec3.hpp"
#include "mesh/mesh.hpp"
#include "model/model.hpp"

namespace carom::test {

/// Appends the four nodes of the body to the mesh.
inline void add_nodes(Mesh& mesh, TurningBody& body) {
  for (std::size_t a = 0; a < 4; ++a) {
    body.nodes[a] = static_cast<Index>(mesh.node_count());
    mesh.coordinates.push_back(corner(body, a));
    mesh.node_numbers.push_back(static_cast<std::int64_t>(mesh.node_count()));
  }
}

/// A model of nothing but one body.
inline Model lone_body(TurningBody body, double frequency) {
  Mesh mesh;
  body.name = "top";
  body.frequency = frequency;
  add_nodes(mesh, body);
  Model model;
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.turning_bodies.push_back(body);
  return model;
}

/// Sets the body's nodes in the velocity of a rigid motion.
inline void spin(const TurningBody& body, const Vec3& velocity, const Vec3& omega, std::vector<double>& v) {
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec3 u = add(velocity, cross(omega, subtract(corner(body, a), body.centre)));
    for (std::size_t c = 0; c < 3; ++c) v[3 * static_cast<std::size_t>(body.nodes[a]) + c] = u[c];
  }
}

/// Directors and their rates of a state.
inline BodyFrame position_of(const TurningBody& body, const std::vector<double>& q) {
  BodyFrame frame = body_frame(body, nodal_values(body, q));
  frame.centre = add(frame.centre, body.centre);
  for (std::size_t i = 0; i < 3; ++i) frame.directors[i] = add(frame.directors[i], body.axes[i]);
  return frame;
}
inline BodyFrame velocity_of(const TurningBody& body, const std::vector<double>& v) {
  return body_frame(body, nodal_values(body, v));
}

}  // namespace carom::test
