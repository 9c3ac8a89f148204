// Matrices and measures of one cell of any kind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "element/cell_list.hpp"
#include "kernels/kernels.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// Node matrices: entry (a, b) of a cell of n nodes at [n a + b].
using NodeMatrix = std::array<double, most_nodes * most_nodes>;
/// Positions or displacements of the nodes of a cell; the first n count.
using CellNodes = std::array<Vec3, most_nodes>;

/// M_ab = integral of rho N_a N_b over the reference volume, by rules that are exact on distorted cells too.
using CellMass = NodeMatrix (*)(const CellNodes& x, double thickness, double rho);
CellMass cell_mass(CellKind kind);

/// The cells of a batch apart from each other: node a of lane l is node a lanes + l of coordinates and dof vectors of
/// their own. What has gone (alive, by lane: 0; empty: nothing) has the entry 0 there, and is at rest.
struct CellsApart {
  std::vector<Index> offset;
  std::vector<double> x;
  std::vector<std::vector<double>> at;  ///< each of the vectors; zero for null
  CellBatches batch;                    ///< of the cells, in these vectors

  CellsApart(const CellBatches& together, std::span<const double* const> vectors,
             std::span<const std::uint8_t> alive = {});
};

/// Stiffness matrices K_e(u) of the cells of one batch: entry (r, s) of lane l, row 3 a + i being component i of node
/// a, at [(3 n l + r) 3 n + s]. Where the kernels have no stiffness of their own, columns are tangent actions on unit
/// displacements. The lower triangle repeats the upper one, as tangents are symmetric. u: null at rest. Those
/// of cells that have gone (alive, by lane) are zero. K is made as large as it must be.
void batch_stiffness(const CellBatches& batch, const CellKernels& kernels, const BatchLaw& law, const double* u,
                     std::span<const std::uint8_t> alive, std::vector<double>& K);

/// u.K_e u at rest of the cell in one lane of the batch.
double stiffness_product(const CellBatches& batch, const CellKernels& kernels, const BatchLaw& law, Index lane,
                         std::span<const Vec3> u);

}  // namespace carom
