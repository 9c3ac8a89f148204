#include "build/initial_velocities.hpp"

#include <fmt/format.h>

#include <cmath>

#include "math/expression.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

void add_component(const Located<std::string>& text, std::size_t c, const Mesh& mesh, std::span<const Index> nodes,
                   std::vector<Vec3>& velocity) {
  const Expression formula(*text);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(nodes[k]);
    const Vec3& X = mesh.coordinates[node];
    const double value = formula.at(X);
    if (!std::isfinite(value))
      throw CaseError(text.where, "initial.velocity_field",
                      fmt::format("\"{}\" = {} at node {}, ({:.6g}, {:.6g}, {:.6g})", *text, value,
                                  mesh.node_label(static_cast<Index>(node)), X[0], X[1], X[2]),
                      "a finite number at every node");
    velocity[k][c] += value;
  }
}

}  // namespace

std::vector<Vec3> initial_velocities(const CaseInitial& given, const Mesh& mesh, std::span<const Index> nodes) {
  if (!given.has_velocity()) return {};
  const Vec3 common = add(given.velocity.value_or(Vec3{}), given.fall);
  if (!given.angular_velocity && !given.velocity_field) return {common};
  std::vector<Vec3> velocity(nodes.size(), common);
  if (given.angular_velocity) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vec3& X = mesh.coordinates[static_cast<std::size_t>(nodes[k])];
      velocity[k] = add(velocity[k], cross(*given.angular_velocity, subtract(X, *given.centre)));
    }
  }
  for (std::size_t c = 0; c < 3 && given.velocity_field; ++c)
    add_component((*given.velocity_field)[c], c, mesh, nodes, velocity);
  return velocity;
}

}  // namespace carom
