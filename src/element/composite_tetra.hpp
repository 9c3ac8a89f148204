// TETRA10 as a composite of linear tetrahedra: gradients, and the tables of its parts.
#pragma once

#include "element/cell_operators.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// The twelve linear tetrahedra of TETRA10, four at the corners and eight about the centre, and the barycentric
/// coordinates of their vertices: nodes 0 to 9 and, as node 10, the mean of the mid-side nodes.
struct CompositeParts {
  int node[12][4] = {};
  double lambda[11][4] = {};
};
consteval CompositeParts make_composite_parts() {
  constexpr int edge[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  constexpr int corner[4][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}};
  CompositeParts parts;
  for (int a = 0; a < 4; ++a) parts.lambda[a][a] = 1.0;
  for (int e = 0; e < 6; ++e)
    for (const int a : edge[e]) parts.lambda[4 + e][a] = 0.5;
  for (int k = 0; k < 4; ++k) parts.lambda[10][k] = 0.25;
  int next = 0;
  for (const auto& tetra : corner) {
    for (int v = 0; v < 4; ++v) parts.node[next][v] = tetra[v];
    ++next;
  }
  // one face of the octahedron of the middles takes one of each pair of opposite middles
  constexpr int opposite[3][2] = {{4, 9}, {5, 7}, {6, 8}};
  for (int k = 0; k < 8; ++k, ++next) {
    int v[4] = {opposite[0][k & 1], opposite[1][k >> 1 & 1], opposite[2][k >> 2], 10};
    double e[3][3] = {};  // edges in the coordinates lambda_1 to lambda_3
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) e[i][j] = parts.lambda[v[i + 1]][j + 1] - parts.lambda[v[0]][j + 1];
    const double det = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                       e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                       e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    const bool turn = det < 0.0;
    const int order[4] = {v[0], turn ? v[2] : v[1], turn ? v[1] : v[2], v[3]};
    for (int i = 0; i < 4; ++i) parts.node[next][i] = order[i];
  }
  return parts;
}
inline constexpr CompositeParts composite_parts = make_composite_parts();

/// TETRA10 with displacements linear in each of its twelve parts and the projection of their gradients on linear
/// functions, at the four points of the rule of degree 2 (Thoutireddy, Molinari, Repetto and Ortiz, Int. J. Numer.
/// Methods Eng. 53, 2002): B_a = lambda_alpha M^-1_alpha_beta integral of lambda_beta dN_a/dX dV with
/// M = integral of lambda_alpha lambda_beta dV over the parts. The weights are those that integrate linear functions
/// over the parts, so that constant stresses have their exact forces whatever the geometry.
struct CompositeTetraCell : DenseGradients<10, 4, 3, false> {
  static constexpr Frame frame = Frame::solid;
  static constexpr int nodes = 10, dimension = 3, points = 4;
  using Base = DenseGradients<10, 4, 3, false>;
  template <class Real>
  using Geometry = Base::Geometry<Real>;

  template <class Real>
  [[gnu::always_inline]] static inline void prepare(const Real x[3][10], double, Geometry<Real>& out) {
    Real moments[4][10][3] = {}, M[4][4] = {}, first[4] = {}, centre[3];
    for (int i = 0; i < 3; ++i) centre[i] = (x[i][4] + x[i][5] + x[i][6] + x[i][7] + x[i][8] + x[i][9]) * (1.0 / 6.0);
    for (int s = 0; s < 12; ++s) add_part(s, x, centre, moments, M, first);
    project(moments, M, first, out);
  }

 private:
  /// Adds the integrals over part s: of lambda_beta dN_a/dX, lambda_alpha lambda_beta (lower triangle) and
  /// lambda_alpha.
  template <class Real>
  [[gnu::always_inline]] static inline void add_part(int s, const Real x[3][10], const Real centre[3],
                                                     Real moments[4][10][3], Real M[4][4], Real first[4]) {
    constexpr const auto& parts = composite_parts;
    const int* node = parts.node[s];
    Real vertex[4][3], edge[3][3], area[4][3];  // area[v] = volume x gradient of vertex v
    for (int v = 0; v < 4; ++v)
      for (int i = 0; i < 3; ++i) vertex[v][i] = node[v] == 10 ? centre[i] : x[i][node[v] == 10 ? 0 : node[v]];
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) edge[k][i] = vertex[k + 1][i] - vertex[0][i];
    hexa8::cross(edge[1], edge[2], area[1]);
    hexa8::cross(edge[2], edge[0], area[2]);
    hexa8::cross(edge[0], edge[1], area[3]);
    const Real volume = (edge[0][0] * area[1][0] + edge[0][1] * area[1][1] + edge[0][2] * area[1][2]) * (1.0 / 6.0);
    for (int i = 0; i < 3; ++i) {
      for (int v = 1; v < 4; ++v) area[v][i] *= 1.0 / 6.0;
      area[0][i] = -area[1][i] - area[2][i] - area[3][i];
    }
    for (int alpha = 0; alpha < 4; ++alpha) {
      double mean = 0.0;
      for (int v = 0; v < 4; ++v) mean += 0.25 * parts.lambda[node[v]][alpha];
      first[alpha] += mean * volume;
      for (int beta = 0; beta <= alpha; ++beta) {
        double product = 0.0, mean_beta = 0.0;
        for (int v = 0; v < 4; ++v) {
          product += parts.lambda[node[v]][alpha] * parts.lambda[node[v]][beta] / 20.0;
          mean_beta += 0.25 * parts.lambda[node[v]][beta];
        }
        M[alpha][beta] += (product + 0.8 * mean * mean_beta) * volume;
      }
      for (int v = 0; v < 4; ++v)
        for (int i = 0; i < 3; ++i) {
          const Real part = mean * area[v][i];
          if (node[v] < 10) moments[alpha][node[v]][i] += part;
          for (int a = 4; a < 10 && node[v] == 10; ++a) moments[alpha][a][i] += (1.0 / 6.0) * part;
        }
    }
  }

  template <class Real>
  [[gnu::always_inline]] static inline void project(const Real moments[4][10][3], Real M[4][4], const Real first[4],
                                                    Geometry<Real>& out) {
    constexpr double a = 0.13819660112501051518, b = 0.58541019662496845446;  // of tetrahedron_rule<4>
    // M = L D L^T in place: D on the diagonal, L below
    for (int j = 0; j < 4; ++j)
      for (int i = j; i < 4; ++i) {
        Real sum = M[i][j];
        for (int k = 0; k < j; ++k) sum -= M[i][k] * M[k][k] * M[j][k];
        M[i][j] = i == j ? sum : Real(sum / M[j][j]);
      }
    const Real total = first[0] + first[1] + first[2] + first[3];
    for (int p = 0; p < 4; ++p) {
      out.weight[p] = (first[p] - a * total) * (1.0 / (b - a));
      Real c[4];  // M^-1 lambda(point p), point p standing nearest to corner p
      for (int i = 0; i < 4; ++i) {
        c[i] = Real{} + (i == p ? b : a);
        for (int k = 0; k < i; ++k) c[i] -= M[i][k] * c[k];
      }
      for (int i = 0; i < 4; ++i) c[i] = c[i] / M[i][i];
      for (int i = 3; i >= 0; --i)
        for (int k = i + 1; k < 4; ++k) c[i] -= M[k][i] * c[k];
      for (int node = 0; node < 10; ++node)
        for (int j = 0; j < 3; ++j)
          out.dN[p][node][j] = c[0] * moments[0][node][j] + c[1] * moments[1][node][j] + c[2] * moments[2][node][j] +
                               c[3] * moments[3][node][j];
    }
  }
};

}  // namespace carom
