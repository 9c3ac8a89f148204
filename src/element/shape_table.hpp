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

/// Points of the weight s^2 on [0, 1]: m of them integrate degree 2 m - 1 exactly. They are the roots of
/// s^2 - 4/3 s + 2/5 and s^3 - 15/8 s^2 + 15/14 s - 5/28.
template <int m>
consteval Rule<m, 1> shrinking_rule() {
  if constexpr (m == 2) {
    constexpr double s[2] = {0.45584815598877472, 0.87748517734455862};
    constexpr double w = (0.25 - s[0] / 3.0) / (s[1] - s[0]);
    return {{{s[0]}, {s[1]}}, {1.0 / 3.0 - w, w}};
  } else {
    static_assert(m == 3);
    return {{{0.29499779011150161688}, {0.65299623396164811528}, {0.92700597592685026784}},
            {0.029950703008580698011, 0.146246269259866022, 0.15713636106488661332}};
  }
}

/// Conical product on the pyramid |xi|, |eta| <= 1 - zeta, 0 <= zeta <= 1: n x n Gauss points over the base, shrunk by
/// s = 1 - zeta, times m points of the weight s^2.
template <int n, int m>
consteval Rule<m * n * n, 3> pyramid_rule() {
  constexpr auto base = square_rule<n>();
  constexpr auto height = shrinking_rule<m>();
  Rule<m * n * n, 3> rule;
  for (int k = 0; k < m; ++k)
    for (int p = 0; p < n * n; ++p) {
      const int q = p + n * n * k;
      const double s = height.xi[k][0];
      rule.weight[q] = height.weight[k] * base.weight[p];
      for (int i = 0; i < 2; ++i) rule.xi[q][i] = s * base.xi[p][i];
      rule.xi[q][2] = 1.0 - s;
    }
  return rule;
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
