// The stages of a batch of cells that know the shape, over a number type.
#pragma once

#include "base/types.hpp"
#include "element/cell_operators.hpp"
#include "solid/batch_values.hpp"
#include "solid/stages.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

template <class Real, class Cell>
static void prepare_cells(const double* x, const Index* offset, double thickness, double* geometry) {
  Real x_cell[3][Cell::nodes];
  gather(x, offset, x_cell);
  Cell::prepare(x_cell, thickness, *reinterpret_cast<typename Cell::template Geometry<Real>*>(geometry));
}

template <class Real, class Cell>
static void cell_gradients(const double* geometry, const double* u, const Index* offset, double* gradient) {
  Real u_cell[3][Cell::nodes];
  gather(u, offset, u_cell);
  Cell::gradients(*reinterpret_cast<const typename Cell::template Geometry<Real>*>(geometry), u_cell, gradient);
}

template <class Real, class Cell>
static void add_cell_forces(const double* geometry, const double* stress, const Index* offset, int count, double* f) {
  Real f_cell[3][Cell::nodes];
  Cell::integrate(*reinterpret_cast<const typename Cell::template Geometry<Real>*>(geometry), stress, f_cell);
  scatter_batch(f_cell, offset, count, f);
}

template <class Real, class Cell>
static void add_cell_hourglass(const double* geometry, double modulus, const double* u, const Index* offset, int count,
                               double* f, double* energy) {
  Real u_cell[3][Cell::nodes], f_cell[3][Cell::nodes] = {};
  gather(u, offset, u_cell);
  store(energy, Cell::add_hourglass(*reinterpret_cast<const typename Cell::template Geometry<Real>*>(geometry), modulus,
                                    u_cell, f_cell));
  scatter_batch(f_cell, offset, count, f);
}

template <class Real, class Cell>
static void cell_hourglass(const double* geometry, const double* u, const Index* offset, double* q, double* stiffness) {
  Real u_cell[3][Cell::nodes];
  gather(u, offset, u_cell);
  Cell::hourglass(*reinterpret_cast<const typename Cell::template Geometry<Real>*>(geometry), u_cell, q, stiffness);
}

template <class Real, class Cell>
static void add_cell_hourglass_forces(const double* geometry, const double* Q, const Index* offset, int count,
                                      double* f) {
  Real f_cell[3][Cell::nodes];
  Cell::hourglass_forces(*reinterpret_cast<const typename Cell::template Geometry<Real>*>(geometry), Q, f_cell);
  scatter_batch(f_cell, offset, count, f);
}

template <class Real, class Cell>
static constexpr CellStages cell_stages() {
  using Geometry = typename Cell::template Geometry<Real>;
  static_assert(sizeof(Geometry) <= most_geometry * sizeof(Real) && Cell::points <= most_points);
  CellStages stages{Cell::nodes,
                    Cell::points,
                    Cell::frame == Frame::bar ? Cell::points * lanes<Real> : 0,
                    prepare_cells<Real, Cell>,
                    cell_gradients<Real, Cell>,
                    add_cell_forces<Real, Cell>};
  if constexpr (requires { Geometry::gamma; }) {
    stages.modes = Cell::Shape::modes;
    stages.directions = Cell::dimension;
    stages.add_hourglass = add_cell_hourglass<Real, Cell>;
    stages.hourglass = cell_hourglass<Real, Cell>;
    stages.add_hourglass_forces = add_cell_hourglass_forces<Real, Cell>;
  }
  return stages;
}

}  // namespace carom
