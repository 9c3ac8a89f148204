// Matrices and measures of one cell of any shape.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/types.hpp"
#include "material/point_batch.hpp"
#include "model/model.hpp"
#include "solid/kernels.hpp"

namespace carom {

/// Dofs of a cell at most, and the matrices over them: entry (r, s) of a cell of n nodes stands at [3 n r + s], row
/// 3 a + i is component i of node a. Node matrices: entry (a, b) at [n a + b].
inline constexpr std::size_t most_nodes = 8, most_dofs = 3 * most_nodes;
using CellMatrix = std::array<double, most_dofs * most_dofs>;
using NodeMatrix = std::array<double, most_nodes * most_nodes>;
/// Positions or displacements of the nodes of a cell; the first n count.
using CellNodes = std::array<Vec3, most_nodes>;

/// Reference volume, a length that stands for the size (solids: volume over the largest face; plane cells: area over
/// the longest edge; bars: their length), and the smallest Jacobian determinant at the quadrature points.
struct CellMeasure {
  double volume = 0.0, length = 0.0, smallest_det_J = 0.0;
};

/// What the solid needs of the cells of one section, cell by cell in plain double.
struct CellOperations {
  std::size_t nodes = 0, points = 0;
  CellKernels small_strain, finite_strain;
  CellMeasure (*measure)(const CellNodes& x, double thickness) = nullptr;
  /// M_ab = integral of rho N_a N_b over the reference volume, by rules that are exact on distorted cells too
  NodeMatrix (*mass)(const CellNodes& x, double thickness, double rho) = nullptr;
  /// K_e(u) = integral of B^T D B, and under finite strain of dN_a/dX S dN_b/dX 1; thickness, step and history of
  /// the cell stand in CellBatches
  CellMatrix (*small_stiffness)(const CellNodes& x, const CellNodes& u, const CellBatches&, const BatchLaw&) = nullptr;
  CellMatrix (*finite_stiffness)(const CellNodes& x, const CellNodes& u, const CellBatches&, const BatchLaw&) = nullptr;
  /// Angle (radian) of the rotation R of F = R U at the centre; pi where F is inverted or not a number.
  double (*rotation)(const CellNodes& x, const CellNodes& u, double thickness) = nullptr;
};
const CellOperations& cell_operations(Section section);

/// Lumped mass of the n nodes: the diagonal of M_e scaled to the mass of the cell (Hinton, Rock and Zienkiewicz,
/// Earthq. Eng. Struct. Dyn. 4, 1976).
std::array<double, most_nodes> lumped(const NodeMatrix& mass, std::size_t n);

/// Upper bound of the largest eigenvalue omega^2 of K_e with the lumped node masses m: |A^8|^(1/8) with the largest
/// absolute row sum as norm and A = M^-1/2 K_e M^-1/2. Any power bounds the spectral radius (Gelfand; the first is
/// Gershgorin's bound); the eighth is at most 24^(1/16) = 1.22 times too large.
double frequency_bound(const CellMatrix& K, const std::array<double, most_nodes>& m, std::size_t n);

}  // namespace carom
