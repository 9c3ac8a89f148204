#include "solid/part_inertia.hpp"

#include "math/vec3.hpp"
#include "solid/cell_matrices.hpp"
#include "solid/element_table.hpp"

namespace carom {

namespace {

/// Calls body(M_ab, X_a, X_b) for all pairs of nodes of all cells.
template <class Body>
void for_each_pair(const Mesh& mesh, std::span<const Part* const> parts, const Body& body) {
  for (const Part* part : parts) {
    const CellMass mass_of = cell_mass(find_element(part->type, part->section, part->formulation)->kind);
    const CellBlock& block = *mesh.block(part->type);
    for (const Index cell : part->cells) {
      const std::span<const Index> nodes = block.nodes(cell);
      CellNodes X{};
      for (std::size_t a = 0; a < nodes.size(); ++a) X[a] = mesh.coordinates[static_cast<std::size_t>(nodes[a])];
      const NodeMatrix M = mass_of(X, part->thickness, part->material.rho);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        for (std::size_t b = 0; b < nodes.size(); ++b) body(M[nodes.size() * a + b], X[a], X[b]);
    }
  }
}

}  // namespace

PartInertia inertia_of(const Mesh& mesh, std::span<const Part* const> parts) {
  PartInertia body;
  Vec3 first{};
  for_each_pair(mesh, parts, [&](double m, const Vec3& X, const Vec3&) {
    body.mass += m;
    first = add(first, scaled(X, m));
  });
  body.centre = scaled(first, 1.0 / body.mass);
  std::array<Vec3, 3> second{};
  for_each_pair(mesh, parts, [&](double m, const Vec3& X, const Vec3& Y) {
    const Vec3 r = subtract(X, body.centre), s = subtract(Y, body.centre);
    for (std::size_t i = 0; i < 3; ++i) second[i] = add(second[i], scaled(s, m * r[i]));
  });
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    body.moments[i] = second[j][j] + second[k][k];
    body.products[i] = -second[i][j];
  }
  return body;
}

}  // namespace carom
