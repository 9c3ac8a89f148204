// The stages of a batch of cells that know the shape, over a number type.
#pragma once

#include <type_traits>

#include "base/types.hpp"
#include "element/cell_integrals.hpp"
#include "element/hexa8_length.hpp"
#include "kernels/batch_values.hpp"
#include "kernels/hourglass_flow.hpp"
#include "kernels/stabilisation_stages.hpp"
#include "kernels/stages.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

template <class Real, class Cell>
static void cell_jacobians(const double* x, const Index* offset, double* smallest) {
  Real x_cell[3][Cell::nodes];
  gather(x, offset, x_cell);
  store(smallest, smallest_jacobian<Cell>(x_cell));
}

template <class Cell>
concept IsHexa8 = std::is_same_v<typename Cell::Shape, Hexa8>;

template <class Real>
static void hexa8_lengths(const double* x, const double* u, const Index* offset, double* length) {
  Real corner[3][8], displacement[3][8];
  gather(x, offset, corner);
  gather(u, offset, displacement);
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < 8; ++a) corner[i][a] += displacement[i][a];
  store(length, hexa8_length(corner));
}

template <class Real, class Cell>
static void cell_masses(const CellStages&, const double* x, const Index* offset, double thickness, double density,
                        double* m) {
  Real x_cell[3][Cell::nodes], m_cell[Cell::nodes];
  gather(x, offset, x_cell);
  lumped_mass<Cell>(x_cell, thickness, density, m_cell);
  for (int a = 0; a < Cell::nodes; ++a) store(m + a * lanes<Real>, m_cell[a]);
}

template <class Real, class Cell>
static void prepare_cells(const CellStages&, const double* x, const Index* offset, double thickness, double* geometry) {
  Real x_cell[3][Cell::nodes];
  gather(x, offset, x_cell);
  Cell::prepare(x_cell, thickness, *reinterpret_cast<typename Cell::template Geometry<Real>*>(geometry));
}

/// Cells that have hourglass modes.
template <class Cell>
concept HasModes = requires {
  Cell::modes;
};

template <class Real, class Cell>
static void cell_gradients(const double* geometry, const double* u, const Index* offset, double* gradient,
                           [[maybe_unused]] double* q) {
  const auto& of_cell = *reinterpret_cast<const typename Cell::template Geometry<Real>*>(geometry);
  Real u_cell[3][Cell::nodes];
  gather(u, offset, u_cell);
  if constexpr (HasModes<Cell>)
    Cell::gradients(of_cell, u_cell, gradient, q);
  else
    Cell::gradients(of_cell, u_cell, gradient);
}

template <class Real, class Cell>
static void add_cell_forces(const double* geometry, const double* stress, [[maybe_unused]] const double* Q,
                            const Index* offset, int count, double* f) {
  const auto& of_cell = *reinterpret_cast<const typename Cell::template Geometry<Real>*>(geometry);
  Real f_cell[3][Cell::nodes];
  if constexpr (HasModes<Cell>)
    Cell::integrate(of_cell, stress, Q, f_cell);
  else
    Cell::integrate(of_cell, stress, f_cell);
  scatter_batch(f_cell, offset, count, f);
}

template <class Real, class Cell>
static const double* hourglass_stiffness(const double* geometry) {
  const auto& of_cell = *reinterpret_cast<const typename Cell::template Geometry<Real>*>(geometry);
  return reinterpret_cast<const double*>(&of_cell.stiffness);
}

template <class Real, class Cell>
static void elastic_modes(const double* geometry, double modulus, const double* q, double* Q, double* energy) {
  const Real k = modulus * load<Real>(hourglass_stiffness<Real, Cell>(geometry));
  Real twice{};
  for (int c = 0; c < Cell::modes * Cell::directions; ++c) {
    const Real of_mode = load<Real>(q + c * lanes<Real>), force = k * of_mode;
    twice += force * of_mode;
    store(Q + c * lanes<Real>, force);
  }
  store<Real>(energy, 0.5 * twice);
}

template <class Real, class Cell>
static constexpr CellStages cell_stages() {
  using Geometry = typename Cell::template Geometry<Real>;
  static_assert(sizeof(Geometry) <= most_geometry * sizeof(Real) && Cell::points <= most_points);
  CellStages stages;
  stages.nodes = Cell::nodes;
  stages.points = Cell::points;
  stages.frame_offset = Cell::frame == Frame::bar ? Cell::points * lanes<Real> : 0;
  stages.smallest_jacobian = cell_jacobians<Real, Cell>;
  stages.lumped_mass = cell_masses<Real, Cell>;
  stages.prepare = prepare_cells<Real, Cell>;
  stages.gradients = cell_gradients<Real, Cell>;
  stages.add_forces = add_cell_forces<Real, Cell>;
  if constexpr (IsHexa8<Cell>) stages.lengths = hexa8_lengths<Real>;
  if constexpr (HasModes<Cell>) {
    stages.modes = Cell::modes;
    stages.directions = Cell::directions;
    if constexpr (IsStabilised<Cell>) {
      stages.stabilisation = stabilisation::stages<Real, Cell>();
    } else {
      stages.stiffness = hourglass_stiffness<Real, Cell>;
      stages.elastic_modes = elastic_modes<Real, Cell>;
      stages.flow = hourglass_flow::stages<Real, Cell>();
      stages.stabilisation = stabilisation::places<Real, Cell>();
    }
  }
  return stages;
}

}  // namespace carom
