#include "solid/cell_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "element/hexa8.hpp"

namespace carom {
namespace {

using NodeMatrix = std::array<std::array<double, 3>, 6>;  // 6 Voigt components x 3 displacement components

/// B_a of node a: strains (shears 2 eps_ij) of a unit displacement of that node.
NodeMatrix strain_matrix(const Vec3& g) {
  return {{{g[0], 0, 0}, {0, g[1], 0}, {0, 0, g[2]}, {g[1], g[0], 0}, {0, g[2], g[1]}, {g[2], 0, g[0]}}};
}

/// D B_a times w
NodeMatrix stress_matrix(const VoigtMatrix& D, const NodeMatrix& B, double w) {
  NodeMatrix DB{};
  for (std::size_t c = 0; c < 6; ++c)
    for (std::size_t d = 0; d < 6; ++d)
      for (std::size_t j = 0; j < 3; ++j) DB[c][j] += w * D[c][d] * B[d][j];
  return DB;
}

void add_node_pair(const NodeMatrix& B, const NodeMatrix& DB, std::size_t a, std::size_t b, CellStiffness& K) {
  for (std::size_t c = 0; c < 6; ++c)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) K[3 * a + i][3 * b + j] += B[c][i] * DB[c][j];
}

double largest_row_sum(const CellStiffness& A) {
  double largest = 0.0;
  for (const auto& row : A) {
    double sum = 0.0;
    for (const double entry : row) sum += std::abs(entry);
    largest = std::max(largest, sum);
  }
  return largest;
}

/// A A of a symmetric A
CellStiffness square(const CellStiffness& A) {
  CellStiffness result{};
  for (std::size_t r = 0; r < 24; ++r)
    for (std::size_t k = 0; k < 24; ++k)
      for (std::size_t s = 0; s < 24; ++s) result[r][s] += A[r][k] * A[k][s];
  return result;
}

}  // namespace

CellStiffness cell_stiffness(const std::array<Vec3, 8>& x, const VoigtMatrix& D) {
  CellStiffness K{};
  for (const hexa8::QuadraturePoint& point : hexa8::gauss_2()) {
    const auto gradient = hexa8::physical_gradient(x, point.xi);
    std::array<NodeMatrix, 8> B{};
    for (std::size_t a = 0; a < 8; ++a) B[a] = strain_matrix(gradient.dN_dX[a]);
    for (std::size_t b = 0; b < 8; ++b) {
      const NodeMatrix DB = stress_matrix(D, B[b], point.weight * gradient.det_J);
      for (std::size_t a = 0; a <= b; ++a) add_node_pair(B[a], DB, a, b, K);
    }
  }
  for (std::size_t r = 0; r < 24; ++r)
    for (std::size_t s = 0; s < r; ++s) K[r][s] = K[s][r];
  return K;
}

CellMass cell_mass(const std::array<Vec3, 8>& x, double rho) {
  CellMass M{};
  for (const hexa8::QuadraturePoint& point : hexa8::gauss_3()) {
    const auto N = hexa8::shape(point.xi);
    const double w = rho * point.weight * hexa8::physical_gradient(x, point.xi).det_J;
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t b = 0; b < 8; ++b) M[a][b] += w * N[a] * N[b];
  }
  return M;
}

std::array<double, 8> lumped(const CellMass& mass) {
  double total = 0.0, trace = 0.0;
  for (std::size_t a = 0; a < 8; ++a) {
    trace += mass[a][a];
    for (std::size_t b = 0; b < 8; ++b) total += mass[a][b];
  }
  std::array<double, 8> m{};
  for (std::size_t a = 0; a < 8; ++a) m[a] = mass[a][a] * total / trace;
  return m;
}

double frequency_bound(const CellStiffness& K, const std::array<double, 8>& m) {
  CellStiffness A{};
  for (std::size_t r = 0; r < 24; ++r)
    for (std::size_t s = 0; s < 24; ++s) A[r][s] = K[r][s] / std::sqrt(m[r / 3] * m[s / 3]);
  const double gershgorin = largest_row_sum(A);
  if (!(gershgorin > 0.0)) return gershgorin;
  for (auto& row : A)
    for (double& entry : row) entry /= gershgorin;  // no power of it overflows
  for (int i = 0; i < 3; ++i) A = square(A);
  return gershgorin * std::pow(largest_row_sum(A), 1.0 / 8.0);
}

}  // namespace carom
