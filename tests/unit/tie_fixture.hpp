// Blocks of meshes that do not match, tied side by side.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "schemes_fixture.hpp"

namespace carom::test {

/// Two blocks of size 2 x 2 x 2, one after the other along x and a gap apart, 3 x 3 against 2 x 2 faces (or as many),
/// their meshes distorted inside; the nodes of the second are tied to the first, and their undersides lie in z = 0.
/// Springs of schemes that tie by them are a thousand times as stiff as a cell.
inline Model tied_blocks(double gap = 0.0, int divisions = 3, double distortion = 0.1) {
  StructuredBlock left, right;
  left.size = right.size = {2.0, 2.0, 2.0};
  left.divisions = {2, 2, 2};
  right.divisions = {2, divisions, divisions};
  right.origin = {2.0 + gap, 0.0, 0.0};
  left.face_groups = {"XMIN", "MASTER", "", "", "ZMIN", ""};
  right.face_groups = {"SLAVE", "XMAX", "", "", "ZMIN", ""};
  Mesh mesh = make_structured_blocks({left, right});
  const std::vector<double> moves = random_vector(3 * mesh.node_count(), 5);
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    Vec3& x = mesh.coordinates[n];
    const auto inside = [](double value, double low, double high) { return value > low && value < high; };
    const bool moves_x = inside(x[0], 0.1, 1.9) || inside(x[0], 2.1 + gap, 3.9 + gap);
    if (moves_x) x[0] += distortion * moves[3 * n];
    for (std::size_t c = 1; c < 3; ++c)
      if (inside(x[c], 0.1, 1.9)) x[c] += distortion * moves[3 * n + c];
  }
  Model model = one_part(std::move(mesh));
  TieContact tie;
  tie.name = "glue";
  tie.slave.facets = faces_of(*model.mesh, "SLAVE");
  tie.master.facets = faces_of(*model.mesh, "MASTER");
  tie.law.eps_N = 1000.0;
  model.contacts.emplace_back(std::move(tie));
  return model;
}

/// Largest distance by which the sides of bonds have parted at displacement x, or velocity x.
inline double parting(const ContactGeometry& contact, std::span<const double> x) {
  double most = 0.0;
  const ConstraintRows& bonds = contact.bonds();
  for (std::size_t r = 0; r < bonds.size(); ++r) most = std::max(most, norm(bonds.relative(r, x)));
  return most;
}

}  // namespace carom::test
