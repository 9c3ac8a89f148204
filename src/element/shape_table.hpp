// Quadrature rules, and shape functions with their derivatives at the points of a rule: tables made at compile time.
#pragma once

#include "math/dual.hpp"

namespace carom {

/// Points and weights on the parent cell.
template <int count, int dimension>
struct Rule {
  static constexpr int points = count;
  double xi[count][dimension] = {};
  double weight[count] = {};
};

/// Gauss and Legendre's rules on [-1, 1]; n points integrate degree 2 n - 1 exactly.
template <int n>
consteval Rule<n, 1> gauss_rule() {
  if constexpr (n == 1) {
    return {{{0.0}}, {2.0}};
  } else if constexpr (n == 2) {
    constexpr double g = 0.57735026918962576451;
    return {{{-g}, {g}}, {1.0, 1.0}};
  } else {
    static_assert(n == 3);
    constexpr double g = 0.77459666924148337704;
    return {{{-g}, {0.0}, {g}}, {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0}};
  }
}

/// The product of two rules, the points of `a` running fastest.
template <int m, int dim_a, int n, int dim_b>
consteval Rule<m * n, dim_a + dim_b> product(const Rule<m, dim_a>& a, const Rule<n, dim_b>& b) {
  Rule<m * n, dim_a + dim_b> rule;
  for (int q = 0; q < n; ++q)
    for (int p = 0; p < m; ++p) {
      const int k = p + m * q;
      rule.weight[k] = a.weight[p] * b.weight[q];
      for (int i = 0; i < dim_a; ++i) rule.xi[k][i] = a.xi[p][i];
      for (int i = 0; i < dim_b; ++i) rule.xi[k][dim_a + i] = b.xi[q][i];
    }
  return rule;
}
template <int n>
consteval Rule<n * n, 2> square_rule() {
  return product(gauss_rule<n>(), gauss_rule<n>());
}
template <int n>
consteval Rule<n * n * n, 3> cube_rule() {
  return product(square_rule<n>(), gauss_rule<n>());
}

/// Rules on the triangle (0,0), (1,0), (0,1): the centroid (degree 1), three points inside (degree 2), six (degree 4;
/// Dunavant, Int. J. Numer. Methods Eng. 21, 1985, table II).
template <int n>
consteval Rule<n, 2> triangle_rule() {
  if constexpr (n == 1) {
    return {{{1.0 / 3.0, 1.0 / 3.0}}, {0.5}};
  } else if constexpr (n == 3) {
    constexpr double a = 1.0 / 6.0, b = 2.0 / 3.0, w = 1.0 / 6.0;
    return {{{a, a}, {b, a}, {a, b}}, {w, w, w}};
  } else {
    static_assert(n == 6);
    constexpr double a = 0.445948490915964886, b = 0.0915762135097707435;
    constexpr double v = 0.5 * 0.223381589678011466, w = 0.5 * 0.109951743655321868;
    return {{{a, a}, {1.0 - 2.0 * a, a}, {a, 1.0 - 2.0 * a}, {b, b}, {1.0 - 2.0 * b, b}, {b, 1.0 - 2.0 * b}},
            {v, v, v, w, w, w}};
  }
}

/// Rules on the tetrahedron (0,0,0), (1,0,0), (0,1,0), (0,0,1): the centroid (degree 1), four points (degree 2).
template <int n>
consteval Rule<n, 3> tetrahedron_rule() {
  if constexpr (n == 1) {
    return {{{0.25, 0.25, 0.25}}, {1.0 / 6.0}};
  } else {
    static_assert(n == 4);
    constexpr double a = 0.13819660112501051518, b = 0.58541019662496845446, w = 1.0 / 24.0;
    return {{{a, a, a}, {b, a, a}, {a, b, a}, {a, a, b}}, {w, w, w, w}};
  }
}

/// N[p][a] and dN[p][a][k] = dN_a / dxi_k at the points of a rule.
template <int count, int nodes, int dimension>
struct ShapeTable {
  static constexpr int points = count;
  double weight[count] = {};
  double N[count][nodes] = {};
  double dN[count][nodes][dimension] = {};
};

template <class Shape, int count>
consteval ShapeTable<count, Shape::nodes, Shape::dimension> tabulate(const Rule<count, Shape::dimension>& rule) {
  constexpr int dim = Shape::dimension;
  ShapeTable<count, Shape::nodes, dim> table;
  for (int p = 0; p < count; ++p) {
    Dual<dim> xi[dim], N[Shape::nodes];
    for (int k = 0; k < dim; ++k) {
      xi[k] = rule.xi[p][k];
      xi[k].d[k] = 1.0;
    }
    Shape::values(xi, N);
    table.weight[p] = rule.weight[p];
    for (int a = 0; a < Shape::nodes; ++a) {
      table.N[p][a] = N[a].value;
      for (int k = 0; k < dim; ++k) table.dN[p][a][k] = N[a].d[k];
    }
  }
  return table;
}

/// The tables of a shape: at the points of its stiffness and of its mass (integrals of N_a N_b).
template <class Shape>
inline constexpr auto stiffness_points = tabulate<Shape>(Shape::stiffness_rule());
template <class Shape>
inline constexpr auto mass_points = tabulate<Shape>(Shape::mass_rule());

}  // namespace carom
