// Integrals over one cell in plain double: products of shape functions, and the Jacobian determinants.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "base/types.hpp"
#include "element/cells.hpp"

namespace carom {

/// Entry (a, b) at [n a + b] of a cell of n nodes.
template <class Cell>
using NodeProducts = std::array<double, static_cast<std::size_t>(Cell::nodes* Cell::nodes)>;
template <class Cell>
using NodePositions = std::array<Vec3, static_cast<std::size_t>(Cell::nodes)>;

/// g[k][i] = dX_i / dxi_k at a point of a table; returns its determinant.
template <int dim, int nodes>
double jacobian_determinant(const double (&dN)[nodes][dim], const Vec3* x) {
  double g[dim][dim] = {}, cofactor[dim][dim];
  for (int a = 0; a < nodes; ++a)
    for (int k = 0; k < dim; ++k)
      for (int i = 0; i < dim; ++i) g[k][i] += dN[a][k] * x[a][static_cast<std::size_t>(i)];
  return invert(g, cofactor);
}

/// density x integral of N_a N_b over the reference volume, by rules that are exact on distorted cells of first
/// order too; of second order a distorted cell's mass is exact, its products are not.
/// `thickness` is that of plane cells and the area of the section of bars.
template <class Cell>
NodeProducts<Cell> node_products(const NodePositions<Cell>& x, double thickness, double density) {
  constexpr auto n = static_cast<std::size_t>(Cell::nodes);
  NodeProducts<Cell> M{};
  constexpr const auto& table = mass_points<typename Cell::Shape>;
  for (std::size_t p = 0; p < static_cast<std::size_t>(table.points); ++p) {
    double measure = density;
    if constexpr (Cell::frame == Frame::plane) measure *= thickness;
    if constexpr (Cell::frame == Frame::axisymmetric) {
      double radius = 0.0;
      for (std::size_t a = 0; a < n; ++a) radius += table.N[p][a] * x[a][0];
      measure *= 2.0 * std::numbers::pi * radius;
    }
    const double weight = measure * table.weight[p] * jacobian_determinant(table.dN[p], x.data());
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) M[n * a + b] += weight * table.N[p][a] * table.N[p][b];
  }
  return M;
}

template <>
inline NodeProducts<BarCell> node_products<BarCell>(const NodePositions<BarCell>& x, double area, double density) {
  const double sixth = density * area * std::hypot(x[1][0] - x[0][0], x[1][1] - x[0][1], x[1][2] - x[0][2]) / 6.0;
  return {2.0 * sixth, sixth, sixth, 2.0 * sixth};
}

/// Vertices of part s of a composite tetrahedron.
inline std::array<Vec3, 4> part_vertices(const NodePositions<CompositeTetraCell>& x, std::size_t s) {
  Vec3 centre{};
  for (std::size_t a = 4; a < 10; ++a)
    for (std::size_t i = 0; i < 3; ++i) centre[i] += x[a][i] / 6.0;
  std::array<Vec3, 4> vertex;
  for (std::size_t v = 0; v < 4; ++v) {
    const int node = composite_parts.node[s][v];
    vertex[v] = node == 10 ? centre : x[static_cast<std::size_t>(node)];
  }
  return vertex;
}

/// Of functions linear in each part: integral of N_v N_w over a part is its volume (1 + delta_vw) / 20.
template <>
inline NodeProducts<CompositeTetraCell> node_products<CompositeTetraCell>(const NodePositions<CompositeTetraCell>& x,
                                                                          double, double density) {
  std::array<std::array<double, 11>, 11> M{};
  for (std::size_t s = 0; s < 12; ++s) {
    const double volume = jacobian_determinant(stiffness_points<Tetra4>.dN[0], part_vertices(x, s).data()) / 6.0;
    for (std::size_t v = 0; v < 4; ++v)
      for (std::size_t w = 0; w < 4; ++w)
        M[static_cast<std::size_t>(composite_parts.node[s][v])][static_cast<std::size_t>(composite_parts.node[s][w])] +=
            density * volume * (v == w ? 0.1 : 0.05);
  }
  NodeProducts<CompositeTetraCell> products{};
  for (std::size_t a = 0; a < 10; ++a)
    for (std::size_t b = 0; b < 10; ++b) {
      const double at_a = a < 4 ? 0.0 : 1.0 / 6.0, at_b = b < 4 ? 0.0 : 1.0 / 6.0;  // of the centre's function
      products[10 * a + b] = M[a][b] + at_a * M[10][b] + at_b * M[a][10] + at_a * at_b * M[10][10];
    }
  return products;
}

/// Smallest Jacobian determinant at the points of the shape's stiffness rule; of composites over the parts, of bars
/// half their length.
template <class Cell>
double smallest_jacobian(const NodePositions<Cell>& x) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& dN : stiffness_points<typename Cell::Shape>.dN)
    smallest = std::min(smallest, jacobian_determinant(dN, x.data()));
  return smallest;
}
template <>
inline double smallest_jacobian<BarCell>(const NodePositions<BarCell>& x) {
  return 0.5 * std::hypot(x[1][0] - x[0][0], x[1][1] - x[0][1], x[1][2] - x[0][2]);
}
template <>
inline double smallest_jacobian<CompositeTetraCell>(const NodePositions<CompositeTetraCell>& x) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < 12; ++s)
    smallest = std::min(smallest, jacobian_determinant(stiffness_points<Tetra4>.dN[0], part_vertices(x, s).data()));
  return smallest;
}

}  // namespace carom
