// Integrals over a cell over a number type: products of shape functions, lumped masses, and the Jacobian determinants.
#pragma once

#include <concepts>
#include <limits>
#include <numbers>

#include "element/cells.hpp"

// Internal linkage throughout: see math/pack.hpp. Positions are [component][node].
namespace carom {

/// g[k][i] = dX_i / dxi_k at a point of a table; returns its determinant.
template <class Real, int dim, int nodes>
[[gnu::always_inline]] static inline Real jacobian_determinant(const double (&dN)[nodes][dim],
                                                               const Real (&x)[3][nodes]) {
  Real g[dim][dim] = {}, cofactor[dim][dim];
  for (int a = 0; a < nodes; ++a)
    for (int k = 0; k < dim; ++k)
      for (int i = 0; i < dim; ++i) g[k][i] += dN[a][k] * x[i][a];
  return invert(g, cofactor);
}

/// Without overflow or underflow of the squares.
template <class Real>
[[gnu::always_inline]] static inline Real bar_length(const Real (&x)[3][2]) {
  Real d[3], largest{};
  for (int i = 0; i < 3; ++i) {
    d[i] = x[i][1] - x[i][0];
    d[i] = d[i] < 0.0 ? -d[i] : d[i];
    largest = d[i] > largest ? d[i] : largest;
  }
  const Real scale = largest > 0.0 ? largest : Real{} + 1.0;
  for (Real& component : d) component /= scale;
  return largest * square_root(Real(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
}

/// density times the part of the reference volume that belongs to point p of the mass rule, which is exact on distorted
/// cells of first order too; of second order a distorted cell's mass is exact, its products of shape functions are not.
/// `thickness` is that of plane cells.
template <class Cell, class Real>
[[gnu::always_inline]] static inline Real point_mass(int p, const Real (&x)[3][Cell::nodes], double thickness,
                                                     double density) {
  constexpr const auto& table = mass_points<typename Cell::Shape>;
  Real mass = density * table.weight[p] * jacobian_determinant(table.dN[p], x);
  if constexpr (Cell::frame == Frame::plane) mass *= thickness;
  if constexpr (Cell::frame == Frame::axisymmetric) {
    Real radius{};
    for (int a = 0; a < Cell::nodes; ++a) radius += table.N[p][a] * x[0][a];
    mass *= 2.0 * std::numbers::pi * radius;
  }
  return mass;
}

/// Part s of a composite tetrahedron: [component][vertex].
template <class Real>
[[gnu::always_inline]] static inline void part_vertices(const Real (&x)[3][10], int s, Real (&vertex)[3][4]) {
  for (int i = 0; i < 3; ++i) {
    Real centre{};
    for (int a = 4; a < 10; ++a) centre += x[i][a] / 6.0;
    for (int v = 0; v < 4; ++v) {
      const int node = composite_parts.node[s][v];
      vertex[i][v] = node == 10 ? centre : x[i][node];
    }
  }
}
template <class Real>
[[gnu::always_inline]] static inline Real part_jacobian(const Real (&x)[3][10], int s) {
  Real vertex[3][4];
  part_vertices(x, s, vertex);
  return jacobian_determinant(stiffness_points<Tetra4>.dN[0], vertex);
}

/// M[a][b] = density x integral of N_a N_b over the reference volume. `thickness` is that of plane cells and the area
/// of the section of bars.
template <class Cell, class Real>
requires requires {
  typename Cell::Shape;
}
static void node_products(const Real (&x)[3][Cell::nodes], double thickness, double density,
                          Real (&M)[Cell::nodes][Cell::nodes]) {
  constexpr const auto& table = mass_points<typename Cell::Shape>;
  for (auto& row : M)
    for (Real& entry : row) entry = Real{};
  for (int p = 0; p < table.points; ++p) {
    const Real weight = point_mass<Cell>(p, x, thickness, density);
    for (int a = 0; a < Cell::nodes; ++a)
      for (int b = 0; b < Cell::nodes; ++b) M[a][b] += weight * (table.N[p][a] * table.N[p][b]);
  }
}

template <std::same_as<BarCell> Cell, class Real>
static void node_products(const Real (&x)[3][Cell::nodes], double area, double density,
                          Real (&M)[Cell::nodes][Cell::nodes]) {
  const Real sixth = density * area * bar_length(x) / 6.0;
  M[0][0] = M[1][1] = 2.0 * sixth;
  M[0][1] = M[1][0] = sixth;
}

/// Of functions linear in each part: integral of N_v N_w over a part is its volume (1 + delta_vw) / 20.
template <std::same_as<CompositeTetraCell> Cell, class Real>
static void node_products(const Real (&x)[3][Cell::nodes], double /*thickness*/, double density,
                          Real (&M)[Cell::nodes][Cell::nodes]) {
  Real with_centre[11][11] = {};
  for (int s = 0; s < 12; ++s) {
    const int(&node)[4] = composite_parts.node[s];
    const Real mass = density * part_jacobian(x, s) / 6.0;
    for (int v = 0; v < 4; ++v)
      for (int w = 0; w < 4; ++w) with_centre[node[v]][node[w]] += mass * (v == w ? 0.1 : 0.05);
  }
  for (int a = 0; a < 10; ++a)
    for (int b = 0; b < 10; ++b) {
      const double at_a = a < 4 ? 0.0 : 1.0 / 6.0, at_b = b < 4 ? 0.0 : 1.0 / 6.0;  // of the centre's function
      M[a][b] =
          with_centre[a][b] + at_a * with_centre[10][b] + at_b * with_centre[a][10] + at_a * at_b * with_centre[10][10];
    }
}

/// Lumped mass of the nodes: the diagonal of M scaled to the mass of the cell (Hinton, Rock and Zienkiewicz, Earthq.
/// Eng. Struct. Dyn. 4, 1976). Positive whatever the shape.
template <class Cell, class Real>
static void lumped_mass(const Real (&x)[3][Cell::nodes], double thickness, double density, Real (&m)[Cell::nodes]) {
  Real total{}, trace{};
  if constexpr (requires { typename Cell::Shape; }) {
    constexpr const auto& table = mass_points<typename Cell::Shape>;
    for (Real& entry : m) entry = Real{};
    for (int p = 0; p < table.points; ++p) {
      const Real weight = point_mass<Cell>(p, x, thickness, density);
      total += weight;  // the shape functions have the sum 1
      for (int a = 0; a < Cell::nodes; ++a) m[a] += weight * (table.N[p][a] * table.N[p][a]);
    }
  } else {
    Real M[Cell::nodes][Cell::nodes];
    node_products<Cell>(x, thickness, density, M);
    for (int a = 0; a < Cell::nodes; ++a) {
      m[a] = M[a][a];
      for (int b = 0; b < Cell::nodes; ++b) total += M[a][b];
    }
  }
  for (const Real& entry : m) trace += entry;
  for (Real& entry : m) entry = entry * total / trace;
}

/// Smallest Jacobian determinant at the points of the shape's stiffness rule; of composites over the parts, of bars
/// half their length.
template <class Cell, class Real>
static Real smallest_jacobian(const Real (&x)[3][Cell::nodes]) {
  if constexpr (Cell::frame == Frame::bar) {
    return 0.5 * bar_length(x);
  } else {
    Real smallest = Real{} + std::numeric_limits<double>::infinity();
    const auto include = [&smallest](const Real& det) { smallest = det < smallest ? det : smallest; };
    if constexpr (requires { typename Cell::Shape; }) {
      for (const auto& dN : stiffness_points<typename Cell::Shape>.dN) include(jacobian_determinant(dN, x));
    } else {
      for (int s = 0; s < 12; ++s) include(part_jacobian(x, s));
    }
    return smallest;
  }
}

}  // namespace carom
