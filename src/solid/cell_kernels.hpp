// The kernels over cells of any shape in plain double, one cell after the other.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "element/cell_shapes.hpp"
#include "material/discrete_gradient.hpp"
#include "solid/kernels.hpp"

namespace carom {

/// eps = sym(frame^T H); forces on the reference configuration, P = frame sigma.
template <class Shape>
struct SmallStrain {
  static constexpr bool has_geometric_stiffness = false;
  /// Strain of H, and the matrix A with P = A S and dE = sym(A^T dH).
  static void evaluate(const typename Shape::Point& point, const double H[3][3], double A[3][3], double e[6]) {
    std::copy_n(&point.frame[0][0], 9, &A[0][0]);
    symmetric_product(A, H, e);
  }
  /// J with sigma = A S A^T / J.
  static double volume_ratio(const double[6]) { return 1.0; }
  /// A step's work is S : (e_1 - e_0) with A at its middle.
  static void discrete_stress(const double*, const double*, const double*, double, double, double*) {}
};

/// E = (F^T F - frame^T frame) / 2, P = F S; not a number in an inverted cell.
template <class Shape>
struct GreenLagrangeStrain {
  static constexpr bool has_geometric_stiffness = true;
  static void evaluate(const typename Shape::Point& point, const double H[3][3], double F[3][3], double e[6]) {
    symmetric_product(point.frame, H, e);
    add_quadratic_strain(H, e);
    for (int c = 0; c < 9; ++c) F[c / 3][c % 3] = point.frame[c / 3][c % 3] + H[c / 3][c % 3];
    refuse_inversion(Shape::jacobian(F), e);
  }
  static double volume_ratio(const double e[6]) {
    const double C[3][3] = {
        {1.0 + 2.0 * e[0], e[3], e[5]}, {e[3], 1.0 + 2.0 * e[1], e[4]}, {e[5], e[4], 1.0 + 2.0 * e[2]}};
    return std::sqrt(determinant(C));
  }
  static void discrete_stress(const double* e_0, const double* e_1, const double* S_mid, double W_0, double W_1,
                              double* S) {
    discrete_gradient_stress(e_0, e_1, S_mid, W_0, W_1, S);
  }
};

/// The points of one cell with what stands there.
template <class Shape, class Kinematics>
struct CellState {
  std::array<typename Shape::Point, Shape::points> point;
  double A[Shape::points][3][3];
  double strain[6 * Shape::points], stress[6 * Shape::points], energy[Shape::points];
  double dissipation[Shape::points] = {};

  CellState(const typename Shape::Nodes& x, double thickness) {
    for (std::size_t p = 0; p < Shape::points; ++p) point[p] = Shape::point(x, p, thickness);
  }

  void set_strain(const typename Shape::Nodes& u) {
    for (std::size_t p = 0; p < Shape::points; ++p) {
      double H[3][3];
      displacement_gradient<Shape>(point[p], u, H);
      Kinematics::evaluate(point[p], H, A[p], strain + 6 * p);
    }
  }

  /// Stress, energy and dissipation of cell c.
  void apply(const CellBatches& cells, Index c, const BatchLaw& law) {
    PointBatch points = point_batch(cells, c, static_cast<int>(Shape::points), strain, stress);
    points.energy = energy;
    if (cells.history_variables > 0) points.dissipation = dissipation;
    law.update(law.parameters, points);
  }

  /// dS of the stress changes that belong to dE, at the present strain of cell c.
  void change(const CellBatches& cells, Index c, const BatchLaw& law, const double* strain_change,
              double* stress_change) const {
    const PointBatch points = point_batch(cells, c, static_cast<int>(Shape::points), nullptr, nullptr);
    law.tangent(law.parameters, {points.points, strain, strain_change, stress_change, points.dt, points.history});
  }
};

/// Reference positions or displacements of the nodes of the cell at `offset`.
template <class Shape>
typename Shape::Nodes gather_cell(const double* values, const Index* offset) {
  typename Shape::Nodes nodes{};
  for (std::size_t a = 0; a < Shape::nodes; ++a)
    for (std::size_t i = 0; i < 3; ++i) nodes[a][i] = values[offset[a] + static_cast<Index>(i)];
  return nodes;
}

/// Kernels of one shape under one kinematics (CellKernels).
template <class Shape, template <class> class Kinematics_>
struct ShapeKernels {
  using Kinematics = Kinematics_<Shape>;
  using State = CellState<Shape, Kinematics>;
  using Nodes = typename Shape::Nodes;

  /// Calls body(offsets, number, state on the reference configuration) for each cell.
  template <class Body>
  static void for_each_cell(const CellBatches& cells, const Body& body) {
    const Index* offset = cells.offset;
    for (Index c = 0; c < cells.cells; ++c, offset += Shape::nodes) {
      State state(gather_cell<Shape>(cells.x, offset), cells.thickness);
      body(offset, c, state);
    }
  }

  static void scatter(const Nodes& in, const Index* offset, double* f) {
    for (std::size_t a = 0; a < Shape::nodes; ++a)
      for (std::size_t i = 0; i < 3; ++i) f[offset[a] + static_cast<Index>(i)] += in[a][i];
  }

  static void scatter_force(const State& state, const Index* offset, double* f) {
    Nodes f_cell{};
    for (std::size_t p = 0; p < Shape::points; ++p) {
      double P[3][3];
      first_piola(state.A[p], state.stress + 6 * p, P);
      add_nodal_force<Shape>(state.point[p], P, f_cell);
    }
    scatter(f_cell, offset, f);
  }

  static void add_internal_force(const CellBatches& cells, const BatchLaw& law, const double* u, double* f,
                                 SolidEnergies* energies) {
    SolidEnergies sum;
    for_each_cell(cells, [&](const Index* offset, Index c, State& state) {
      state.set_strain(gather_cell<Shape>(u, offset));
      state.apply(cells, c, law);
      scatter_force(state, offset, f);
      for (std::size_t p = 0; p < Shape::points; ++p) {
        sum.strain += state.point[p].weight * state.energy[p];
        sum.plastic += state.point[p].weight * state.dissipation[p];
      }
    });
    if (energies != nullptr) energies->add(sum);
  }

  /// dP = dH S + A dS, dS = D : sym(A^T dH); the first term of finite strain alone.
  static void add_tangent_action(const CellBatches& cells, const BatchLaw& law, const double* u, const double* x,
                                 double* y) {
    for_each_cell(cells, [&](const Index* offset, Index c, State& state) {
      state.set_strain(gather_cell<Shape>(u, offset));
      const Nodes x_cell = gather_cell<Shape>(x, offset);
      double dH[Shape::points][3][3], dE[6 * Shape::points], dS[6 * Shape::points];
      for (std::size_t p = 0; p < Shape::points; ++p) {
        displacement_gradient<Shape>(state.point[p], x_cell, dH[p]);
        symmetric_product(state.A[p], dH[p], dE + 6 * p);
      }
      state.change(cells, c, law, dE, dS);
      if constexpr (Kinematics::has_geometric_stiffness) state.apply(cells, c, law);
      Nodes y_cell{};
      for (std::size_t p = 0; p < Shape::points; ++p) {
        double P[3][3];
        first_piola(state.A[p], dS + 6 * p, P);
        add_nodal_force<Shape>(state.point[p], P, y_cell);
        if constexpr (Kinematics::has_geometric_stiffness) {
          first_piola(dH[p], state.stress + 6 * p, P);
          add_nodal_force<Shape>(state.point[p], P, y_cell);
        }
      }
      scatter(y_cell, offset, y);
    });
  }

  static void add_discrete_gradient_force(const CellBatches& cells, const BatchLaw& law, const double* u_0,
                                          const double* u_1, double* f) {
    for_each_cell(cells, [&](const Index* offset, Index c, State& state) {
      State end = state;
      state.set_strain(gather_cell<Shape>(u_0, offset));
      end.set_strain(gather_cell<Shape>(u_1, offset));
      State middle = state;
      std::array<double, 6 * Shape::points> e_0, e_1;  // the law writes into those of the states
      std::copy_n(state.strain, e_0.size(), e_0.begin());
      std::copy_n(end.strain, e_1.size(), e_1.begin());
      for (std::size_t k = 0; k < e_0.size(); ++k) middle.strain[k] = 0.5 * (e_0[k] + e_1[k]);
      for (std::size_t p = 0; p < Shape::points; ++p)
        for (int k = 0; k < 9; ++k)
          middle.A[p][k / 3][k % 3] = 0.5 * (state.A[p][k / 3][k % 3] + end.A[p][k / 3][k % 3]);
      for (State* s : {&state, &end, &middle}) s->apply(cells, c, law);
      for (std::size_t p = 0; p < Shape::points; ++p) {
        double* S = middle.stress + 6 * p;
        Kinematics::discrete_stress(e_0.data() + 6 * p, e_1.data() + 6 * p, S, state.energy[p], end.energy[p], S);
      }
      scatter_force(middle, offset, f);
    });
  }

  static void mean_stress(const CellBatches& cells, const BatchLaw& law, const double* u, double* stress) {
    for_each_cell(cells, [&](const Index* offset, Index cell, State& state) {
      state.set_strain(gather_cell<Shape>(u, offset));
      state.apply(cells, cell, law);
      double volume = 0.0, *mean = stress + 6 * cell;
      std::fill_n(mean, 6, 0.0);
      for (std::size_t p = 0; p < Shape::points; ++p) {
        double P[3][3], sigma[6];
        first_piola(state.A[p], state.stress + 6 * p, P);
        cauchy(P, state.A[p], Kinematics::volume_ratio(state.strain + 6 * p), sigma);
        volume += state.point[p].weight;
        for (int c = 0; c < 6; ++c) mean[c] += state.point[p].weight * sigma[c];
      }
      for (int c = 0; c < 6; ++c) mean[c] /= volume;
    });
  }

  static constexpr CellKernels kernels() {
    return {add_internal_force, add_tangent_action, add_discrete_gradient_force, mean_stress};
  }
};

}  // namespace carom
