// Matrices and measures of one cell of any kind.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "element/cell_list.hpp"
#include "solid/kernels.hpp"

namespace carom {

/// Nodes of a cell at most. Node matrices: entry (a, b) of a cell of n nodes at [n a + b].
inline constexpr std::size_t most_nodes = 27;
using NodeMatrix = std::array<double, most_nodes * most_nodes>;
/// Positions or displacements of the nodes of a cell; the first n count.
using CellNodes = std::array<Vec3, most_nodes>;

/// What the solid needs of one kind of cell, cell by cell in plain double.
struct CellOperations {
  /// The smallest Jacobian determinant at the points of the stiffness.
  double (*smallest_jacobian)(const CellNodes& x) = nullptr;
  /// M_ab = integral of rho N_a N_b over the reference volume, by rules that are exact on distorted cells too.
  NodeMatrix (*mass)(const CellNodes& x, double thickness, double rho) = nullptr;
};
const CellOperations& cell_operations(CellKind kind);

/// Lumped mass of the n nodes: the diagonal of M_e scaled to the mass of the cell (Hinton, Rock and Zienkiewicz,
/// Earthq. Eng. Struct. Dyn. 4, 1976). Positive whatever the shape.
std::array<double, most_nodes> lumped(const NodeMatrix& mass, std::size_t n);

/// Stiffness matrices K_e(u) of the cells of one batch: entry (r, s) of lane l, row 3 a + i being component i of node
/// a, at [(3 n l + r) 3 n + s]. Their columns are tangent actions on unit displacements; the lower triangle repeats the
/// upper one where the law's tangent is symmetric. u: null at rest. K is made as large as it must be.
void batch_stiffness(const CellBatches& batch, const CellKernels& kernels, const BatchLaw& law, bool is_symmetric,
                     const double* u, std::vector<double>& K);

/// Upper bound of the largest eigenvalue omega^2 of K_e (3 n x 3 n) with the lumped node masses m: |A^8|^(1/8) with the
/// largest absolute row sum as norm and A = M^-1/2 K_e M^-1/2. Any power bounds the spectral radius (Gelfand; the first
/// is Gershgorin's bound); the eighth is at most (3 n)^(1/16) times too large, 1.22 for HEXA8.
double frequency_bound(std::span<const double> K, const std::array<double, most_nodes>& m, std::size_t n);

}  // namespace carom
