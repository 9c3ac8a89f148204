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

namespace {

/// The cells of a batch apart from each other: node a of lane l is node a lanes + l of vectors of their own.
struct CellsApart {
  std::vector<Index> offset;
  std::vector<double> x, at;
  CellBatches batch;

  CellsApart(const CellBatches& together, const double* u) : batch(together) {
    const auto nodes = static_cast<std::size_t>(together.stages->cell->nodes);
    const auto lanes = static_cast<std::size_t>(together.stages->lanes);
    offset.assign(together.offset, together.offset + static_cast<std::size_t>(together.stages->cell->places()) * lanes);
    x.resize(3 * nodes * lanes);
    at.assign(x.size(), 0.0);
    for (std::size_t k = 0; k < nodes * lanes; ++k) {
      offset[k] = static_cast<Index>(3 * k);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t global = static_cast<std::size_t>(together.offset[k]) + i;
        x[3 * k + i] = together.x[global];
        if (u != nullptr) at[3 * k + i] = u[global];
      }
    }
    batch.x = x.data();
    batch.offset = offset.data();
    batch.cells = static_cast<Index>(lanes);
    batch.new_history = nullptr;
  }
};

}  // namespace

double stiffness_product(const CellBatches& batch, const CellKernels& kernels, const BatchLaw& law, Index lane,
                         std::span<const Vec3> u) {
  const CellsApart apart(batch, nullptr);
  const auto lanes = static_cast<std::size_t>(batch.stages->lanes);
  std::vector<double> along(apart.x.size(), 0.0), force(apart.x.size(), 0.0);
  const auto place = [&](std::size_t a, std::size_t i) { return 3 * (a * lanes + static_cast<std::size_t>(lane)) + i; };
  for (std::size_t a = 0; a < u.size(); ++a)
    for (std::size_t i = 0; i < 3; ++i) along[place(a, i)] = u[a][i];
  kernels.add_tangent_action(apart.batch, law, apart.at.data(), along.data(), force.data());
  double sum = 0.0;
  for (std::size_t a = 0; a < u.size(); ++a)
    for (std::size_t i = 0; i < 3; ++i) sum += u[a][i] * force[place(a, i)];
  return sum;
}

void batch_stiffness(const CellBatches& batch, const CellKernels& kernels, const BatchLaw& law, bool is_symmetric,
                     const double* u, std::vector<double>& K) {
  const auto nodes = static_cast<std::size_t>(batch.stages->cell->nodes);
  const auto lanes = static_cast<std::size_t>(batch.stages->lanes);
  const std::size_t dofs = 3 * nodes, values = dofs * lanes;
  const CellsApart apart(batch, u);
  std::vector<double> unit(values, 0.0), column(values);
  K.resize(lanes * dofs * dofs);
  if (kernels.stiffness != nullptr) {
    std::vector<double> packed(K.size());
    kernels.stiffness(apart.batch, law, apart.at.data(), packed.data());
    for (std::size_t r = 0; r < dofs; ++r)
      for (std::size_t s = r; s < dofs; ++s)
        for (std::size_t l = 0; l < lanes; ++l) {
          const double value = packed[(dofs * r + s) * lanes + l];
          K[(dofs * l + r) * dofs + s] = K[(dofs * l + s) * dofs + r] = value;
        }
    return;
  }
  for (std::size_t s = 0; s < dofs; ++s) {
    const auto set_unit = [&](double value) {
      for (std::size_t l = 0; l < lanes; ++l) unit[3 * (s / 3 * lanes + l) + s % 3] = value;
    };
    set_unit(1.0);
    std::fill(column.begin(), column.end(), 0.0);
    kernels.add_tangent_action(apart.batch, law, apart.at.data(), unit.data(), column.data());
    set_unit(0.0);
    for (std::size_t l = 0; l < lanes; ++l)
      for (std::size_t r = 0; r < dofs; ++r)
        if (!is_symmetric || r <= s) K[(dofs * l + r) * dofs + s] = column[3 * (r / 3 * lanes + l) + r % 3];
  }
  for (std::size_t l = 0; l < lanes && is_symmetric; ++l)
    for (std::size_t r = 0; r < dofs; ++r)
      for (std::size_t s = 0; s < r; ++s) K[(dofs * l + r) * dofs + s] = K[(dofs * l + s) * dofs + r];
}

}  // namespace carom
