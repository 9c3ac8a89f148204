#include "contact/cell_location.hpp"

#include <algorithm>
#include <cmath>

#include "element/hexa8.hpp"
#include "math/vec3.hpp"

namespace carom {

std::optional<Vec3> parent_point(const Corners& corners, const Vec3& x) {
  Vec3 xi{};
  for (int i = 0; i < 20; ++i) {
    const std::array<double, 8> N = hexa8::shape(xi);
    const std::array<Vec3, 8> dN = hexa8::shape_gradient(xi);
    Vec3 r = x;
    std::array<Vec3, 3> J{};  // dx / dxi_k
    for (std::size_t a = 0; a < 8; ++a) {
      r = subtract(r, scaled(corners[a], N[a]));
      for (std::size_t k = 0; k < 3; ++k) J[k] = add(J[k], scaled(corners[a], dN[a][k]));
    }
    const double det = dot(J[0], cross(J[1], J[2]));
    if (!(det > 0.0)) return std::nullopt;
    const Vec3 step{dot(r, cross(J[1], J[2])) / det, dot(r, cross(J[2], J[0])) / det, dot(r, cross(J[0], J[1])) / det};
    xi = add(xi, step);
    if (!(std::max({std::abs(xi[0]), std::abs(xi[1]), std::abs(xi[2])}) < 10.0)) return std::nullopt;
    if (norm(step) < 1e-9) return xi;
  }
  return std::nullopt;
}

PlacedCells::PlacedCells(const Model& model, std::span<const Vec3> x) {
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const CellType type = model.parts[p].type;
    if (type != CellType::hexa8 && type != CellType::quad4) continue;
    const CellBlock& block = *model.mesh->block(type);
    const auto n = static_cast<std::size_t>(node_count(type));
    for (const Index c : model.parts[p].cells) {
      nodes.push_back(std::span(block.connectivity).subspan(n * static_cast<std::size_t>(c), n));
      ref.push_back({static_cast<Index>(&block - model.mesh->blocks.data()), c});
      part.push_back(static_cast<Index>(p));
    }
  }
  corners.resize(nodes.size());
  bounds.resize(nodes.size());
  place(x);
}

void PlacedCells::place(std::span<const Vec3> x) {
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const std::size_t n = nodes[k].size();
    Corners& corner = corners[k];
    for (std::size_t a = 0; a < 8; ++a) corner[a] = x[nodes[k][a % n]];
    if (n == 4) {
      const double half = 0.5 * norm(subtract(corner[2], corner[0]));
      for (std::size_t a = 0; a < 8; ++a) corner[a][2] += a < 4 ? -half : half;
    }
    bounds[k] = Bounds{};
    for (const Vec3& at : corner) bounds[k].include(at);
  }
}

std::vector<Vec3> current_positions(const Mesh& mesh, std::span<const double> u) {
  std::vector<Vec3> x = mesh.coordinates;
  for (std::size_t n = 0; n < x.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c) x[n][c] += u[3 * n + c];
  return x;
}

}  // namespace carom
