#include "solid/cell_matrices.hpp"

#include <algorithm>

#include "element/cell_integrals.hpp"

namespace carom {
namespace {

template <class Cell>
NodeMatrix mass(const CellNodes& nodes, double thickness, double rho) {
  constexpr std::size_t n = Cell::nodes;
  double x[3][n], products[n][n];
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t i = 0; i < 3; ++i) x[i][a] = nodes[a][i];
  node_products<Cell>(x, thickness, rho, products);
  NodeMatrix M{};
  for (std::size_t a = 0; a < n; ++a) std::copy_n(products[a], n, M.begin() + static_cast<std::ptrdiff_t>(n * a));
  return M;
}

}  // namespace

CellMass cell_mass(CellKind kind) {
#define CAROM_CELL_MASS(cell) mass<cell##Cell>,
  static constexpr CellMass table[] = {CAROM_CELLS(CAROM_CELL_MASS)};
#undef CAROM_CELL_MASS
  return table[static_cast<std::size_t>(kind)];
}

CellsApart::CellsApart(const CellBatches& together, std::span<const double* const> vectors,
                       std::span<const std::uint8_t> alive)
    : batch(together) {
  const auto nodes = static_cast<std::size_t>(together.stages->cell->nodes);
  const auto lanes = static_cast<std::size_t>(together.stages->lanes);
  offset.assign(together.offset, together.offset + static_cast<std::size_t>(together.stages->cell->places()) * lanes);
  x.resize(3 * nodes * lanes);
  at.assign(vectors.size(), std::vector<double>(x.size(), 0.0));
  for (std::size_t k = 0; k < nodes * lanes; ++k) {
    offset[k] = static_cast<Index>(3 * k);
    const bool is_there = alive.empty() || (k % lanes < alive.size() && alive[k % lanes] != 0);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t global = static_cast<std::size_t>(together.offset[k]) + i;
      x[3 * k + i] = together.x[global];
      for (std::size_t v = 0; v < vectors.size() && is_there; ++v)
        if (vectors[v] != nullptr) at[v][3 * k + i] = vectors[v][global];
    }
  }
  batch.x = x.data();
  batch.offset = offset.data();
}

double stiffness_product(const CellBatches& batch, const CellKernels& kernels, const BatchLaw& law, Index lane,
                         std::span<const Vec3> u) {
  CellsApart apart(batch, std::array<const double*, 1>{nullptr});
  apart.batch.cells = batch.stages->lanes;
  apart.batch.new_history = nullptr;
  const auto lanes = static_cast<std::size_t>(batch.stages->lanes);
  std::vector<double> along(apart.x.size(), 0.0), force(apart.x.size(), 0.0);
  const auto place = [&](std::size_t a, std::size_t i) { return 3 * (a * lanes + static_cast<std::size_t>(lane)) + i; };
  for (std::size_t a = 0; a < u.size(); ++a)
    for (std::size_t i = 0; i < 3; ++i) along[place(a, i)] = u[a][i];
  kernels.add_tangent_action(apart.batch, law, apart.at[0].data(), along.data(), force.data());
  double sum = 0.0;
  for (std::size_t a = 0; a < u.size(); ++a)
    for (std::size_t i = 0; i < 3; ++i) sum += u[a][i] * force[place(a, i)];
  return sum;
}

void batch_stiffness(const CellBatches& batch, const CellKernels& kernels, const BatchLaw& law, const double* u,
                     std::span<const std::uint8_t> alive, std::vector<double>& K) {
  const auto nodes = static_cast<std::size_t>(batch.stages->cell->nodes);
  const auto lanes = static_cast<std::size_t>(batch.stages->lanes);
  const std::size_t dofs = 3 * nodes, values = dofs * lanes;
  CellsApart apart(batch, std::array<const double*, 1>{u}, alive);
  apart.batch.cells = batch.stages->lanes;
  apart.batch.new_history = nullptr;
  std::vector<double> unit(values, 0.0), column(values);
  K.resize(lanes * dofs * dofs);
  const auto leave_out_gone = [&] {
    for (std::size_t l = 0; l < alive.size(); ++l)
      if (alive[l] == 0) std::fill_n(K.begin() + static_cast<std::ptrdiff_t>(dofs * dofs * l), dofs * dofs, 0.0);
  };
  if (kernels.stiffness != nullptr) {
    std::vector<double> packed(K.size());
    kernels.stiffness(apart.batch, law, apart.at[0].data(), packed.data());
    for (std::size_t r = 0; r < dofs; ++r)
      for (std::size_t s = r; s < dofs; ++s)
        for (std::size_t l = 0; l < lanes; ++l) {
          const double value = packed[(dofs * r + s) * lanes + l];
          K[(dofs * l + r) * dofs + s] = K[(dofs * l + s) * dofs + r] = value;
        }
    return leave_out_gone();
  }
  for (std::size_t s = 0; s < dofs; ++s) {
    const auto set_unit = [&](double value) {
      for (std::size_t l = 0; l < lanes; ++l) unit[3 * (s / 3 * lanes + l) + s % 3] = value;
    };
    set_unit(1.0);
    std::fill(column.begin(), column.end(), 0.0);
    kernels.add_tangent_action(apart.batch, law, apart.at[0].data(), unit.data(), column.data());
    set_unit(0.0);
    for (std::size_t l = 0; l < lanes; ++l)
      for (std::size_t r = 0; r <= s; ++r) K[(dofs * l + r) * dofs + s] = column[3 * (r / 3 * lanes + l) + r % 3];
  }
  for (std::size_t l = 0; l < lanes; ++l)
    for (std::size_t r = 0; r < dofs; ++r)
      for (std::size_t s = 0; s < r; ++s) K[(dofs * l + r) * dofs + s] = K[(dofs * l + s) * dofs + r];
  leave_out_gone();
}

}  // namespace carom
