// Matrices and measures of one cell of any kind.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "element/cell_list.hpp"
#include "mesh/mesh.hpp"
#include "solid/kernels.hpp"

namespace carom {

/// Node matrices: entry (a, b) of a cell of n nodes at [n a + b].
using NodeMatrix = std::array<double, most_nodes * most_nodes>;
/// Positions or displacements of the nodes of a cell; the first n count.
using CellNodes = std::array<Vec3, most_nodes>;

/// M_ab = integral of rho N_a N_b over the reference volume, by rules that are exact on distorted cells too.
using CellMass = NodeMatrix (*)(const CellNodes& x, double thickness, double rho);
CellMass cell_mass(CellKind kind);

/// Stiffness matrices K_e(u) of the cells of one batch: entry (r, s) of lane l, row 3 a + i being component i of node
/// a, at [(3 n l + r) 3 n + s]. Where the kernels have no stiffness of their own, columns are tangent actions on unit
/// displacements. The lower triangle repeats the upper one where the law's tangent is symmetric. u: null at rest. K is
/// made as large as it must be.
void batch_stiffness(const CellBatches& batch, const CellKernels& kernels, const BatchLaw& law, bool is_symmetric,
                     const double* u, std::vector<double>& K);

/// u.K_e u at rest of the cell in one lane of the batch.
double stiffness_product(const CellBatches& batch, const CellKernels& kernels, const BatchLaw& law, Index lane,
                         std::span<const Vec3> u);

}  // namespace carom
