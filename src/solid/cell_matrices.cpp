#include "solid/cell_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "element/cell_shapes.hpp"
#include "solid/cell_kernels.hpp"
#include "solid/rotation.hpp"

namespace carom {
namespace {

using StrainMatrix = std::array<std::array<double, 3>, 6>;  // 6 Voigt components x 3 displacement components

template <class Shape>
typename Shape::Nodes nodes_of(const CellNodes& all) {
  typename Shape::Nodes nodes{};
  std::copy_n(all.begin(), Shape::nodes, nodes.begin());
  return nodes;
}

/// B_a of node a: strain changes sym(A^T dH) of its unit displacements.
template <class Shape>
StrainMatrix strain_matrix(const typename Shape::Point& point, const double A[3][3], std::size_t a) {
  StrainMatrix B{};
  for (std::size_t i = 0; i < Shape::components; ++i) {
    typename Shape::Nodes unit{};
    unit[a][i] = 1.0;
    double dH[3][3], e[6];
    displacement_gradient<Shape>(point, unit, dH);
    symmetric_product(A, dH, e);
    for (std::size_t c = 0; c < 6; ++c) B[c][i] = e[c];
  }
  return B;
}

using VoigtMatrix = std::array<std::array<double, 6>, 6>;

/// D of every point, column by column.
template <class State>
auto tangents(const State& state, const CellBatches& cell, const BatchLaw& law) {
  constexpr std::size_t points = std::tuple_size_v<decltype(state.point)>;
  std::array<VoigtMatrix, points> D{};
  for (std::size_t column = 0; column < 6; ++column) {
    std::array<double, 6 * points> unit{}, result{};
    for (std::size_t p = 0; p < points; ++p) unit[6 * p + column] = 1.0;
    state.change(cell, 0, law, unit.data(), result.data());
    for (std::size_t p = 0; p < points; ++p)
      for (std::size_t row = 0; row < 6; ++row) D[p][row][column] = result[6 * p + row];
  }
  return D;
}

/// w D B
StrainMatrix stress_matrix(const VoigtMatrix& D, const StrainMatrix& B, double w) {
  StrainMatrix DB{};
  for (std::size_t c = 0; c < 6; ++c)
    for (std::size_t d = 0; d < 6; ++d)
      for (std::size_t j = 0; j < 3; ++j) DB[c][j] += w * D[c][d] * B[d][j];
  return DB;
}

/// Adds the geometric stiffness of nodes a, b: w grad_a S grad_b on the diagonal, and the hoop term on xx.
template <class Shape>
void add_geometric(const typename Shape::Point& point, const double* S, std::size_t a, std::size_t b, CellMatrix& K) {
  constexpr std::size_t dofs = 3 * Shape::nodes;
  constexpr std::size_t voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum += point.gradient[a][i] * S[voigt[i][j]] * point.gradient[b][j];
  for (std::size_t i = 0; i < Shape::components; ++i) K[(3 * a + i) * dofs + 3 * b + i] += point.weight * sum;
  K[3 * a * dofs + 3 * b] += point.weight * point.hoop[a] * S[2] * point.hoop[b];
}

template <class Shape, template <class> class Kinematics>
CellMatrix stiffness(const CellNodes& x, const CellNodes& u, const CellBatches& cell, const BatchLaw& law) {
  constexpr std::size_t dofs = 3 * Shape::nodes;
  CellState<Shape, Kinematics<Shape>> state(nodes_of<Shape>(x), cell.thickness);
  state.set_strain(nodes_of<Shape>(u));
  const auto D = tangents(state, cell, law);
  if constexpr (Kinematics<Shape>::has_geometric_stiffness) state.apply(cell, 0, law);
  CellMatrix K{};
  for (std::size_t p = 0; p < Shape::points; ++p) {
    std::array<StrainMatrix, Shape::nodes> B;
    for (std::size_t a = 0; a < Shape::nodes; ++a) B[a] = strain_matrix<Shape>(state.point[p], state.A[p], a);
    for (std::size_t b = 0; b < Shape::nodes; ++b) {
      const StrainMatrix DB = stress_matrix(D[p], B[b], state.point[p].weight);
      for (std::size_t a = 0; a <= b; ++a) {
        for (std::size_t c = 0; c < 6; ++c)
          for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) K[(3 * a + i) * dofs + 3 * b + j] += B[a][c][i] * DB[c][j];
        if constexpr (Kinematics<Shape>::has_geometric_stiffness)
          add_geometric<Shape>(state.point[p], state.stress + 6 * p, a, b, K);
      }
    }
  }
  for (std::size_t r = 0; r < dofs; ++r)
    for (std::size_t s = 0; s < r; ++s) K[r * dofs + s] = K[s * dofs + r];
  return K;
}

template <class Shape>
CellMeasure measure(const CellNodes& all, double thickness) {
  const auto x = nodes_of<Shape>(all);
  CellMeasure result{0.0, Shape::length(x), std::numeric_limits<double>::infinity()};
  for (std::size_t p = 0; p < Shape::points; ++p) {
    const auto point = Shape::point(x, p, thickness);
    result.volume += point.weight;
    result.smallest_det_J = std::min(result.smallest_det_J, point.det_J);
  }
  return result;
}

template <class Shape>
NodeMatrix mass(const CellNodes& x, double thickness, double rho) {
  const auto products = Shape::node_products(nodes_of<Shape>(x), thickness, rho);
  NodeMatrix M{};
  for (std::size_t a = 0; a < Shape::nodes; ++a)
    for (std::size_t b = 0; b < Shape::nodes; ++b) M[a * Shape::nodes + b] = products[a][b];
  return M;
}

template <class Shape>
double rotation(const CellNodes& x, const CellNodes& u, double thickness) {
  const auto point = Shape::centre(nodes_of<Shape>(x), thickness);
  double F[3][3];
  displacement_gradient<Shape>(point, nodes_of<Shape>(u), F);
  for (int c = 0; c < 9; ++c) F[c / 3][c % 3] += point.frame[c / 3][c % 3];
  if constexpr (Shape::nodes == BarShape::nodes)
    return angle_between({point.frame[0][0], point.frame[1][0], point.frame[2][0]}, {F[0][0], F[1][0], F[2][0]});
  else
    return rotation_angle(F);
}

template <class Shape>
constexpr CellOperations operations() {
  return {Shape::nodes,
          Shape::points,
          ShapeKernels<Shape, SmallStrain>::kernels(),
          ShapeKernels<Shape, GreenLagrangeStrain>::kernels(),
          measure<Shape>,
          mass<Shape>,
          stiffness<Shape, SmallStrain>,
          stiffness<Shape, GreenLagrangeStrain>,
          rotation<Shape>};
}

double largest_row_sum(const CellMatrix& A, std::size_t dofs) {
  double largest = 0.0;
  for (std::size_t r = 0; r < dofs; ++r) {
    double sum = 0.0;
    for (std::size_t s = 0; s < dofs; ++s) sum += std::abs(A[r * dofs + s]);
    largest = std::max(largest, sum);
  }
  return largest;
}

CellMatrix square(const CellMatrix& A, std::size_t dofs) {
  CellMatrix result{};
  for (std::size_t r = 0; r < dofs; ++r)
    for (std::size_t k = 0; k < dofs; ++k)
      for (std::size_t s = 0; s < dofs; ++s) result[r * dofs + s] += A[r * dofs + k] * A[k * dofs + s];
  return result;
}

}  // namespace

const CellOperations& cell_operations(Section section) {
  static constexpr CellOperations solid = operations<HexaShape>(), plane = operations<PlaneShape>();
  static constexpr CellOperations axisymmetric = operations<AxisymmetricShape>(), bar = operations<BarShape>();
  switch (section) {
    case Section::plane_strain:
    case Section::plane_stress:
      return plane;
    case Section::axisymmetric:
      return axisymmetric;
    case Section::bar:
      return bar;
    case Section::solid:
      break;
  }
  return solid;
}

std::array<double, most_nodes> lumped(const NodeMatrix& mass, std::size_t n) {
  double total = 0.0, trace = 0.0;
  for (std::size_t a = 0; a < n; ++a) {
    trace += mass[a * n + a];
    for (std::size_t b = 0; b < n; ++b) total += mass[a * n + b];
  }
  std::array<double, most_nodes> m{};
  for (std::size_t a = 0; a < n; ++a) m[a] = mass[a * n + a] * total / trace;
  return m;
}

double frequency_bound(const CellMatrix& K, const std::array<double, most_nodes>& m, std::size_t n) {
  const std::size_t dofs = 3 * n;
  CellMatrix A{};
  for (std::size_t r = 0; r < dofs; ++r)
    for (std::size_t s = 0; s < dofs; ++s) A[r * dofs + s] = K[r * dofs + s] / std::sqrt(m[r / 3] * m[s / 3]);
  const double gershgorin = largest_row_sum(A, dofs);
  if (!(gershgorin > 0.0)) return gershgorin;
  for (double& entry : A) entry /= gershgorin;  // no power of it overflows
  for (int i = 0; i < 3; ++i) A = square(A, dofs);
  return gershgorin * std::pow(largest_row_sum(A, dofs), 1.0 / 8.0);
}

}  // namespace carom
