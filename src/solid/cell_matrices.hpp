// Matrices of one HEXA8 cell.
#pragma once

#include <array>

#include "base/types.hpp"
#include "material/linear_elastic_tangent.hpp"

namespace carom {

/// 24 x 24, row-major; row 3 a + i is component i of node a.
using CellStiffness = std::array<std::array<double, 24>, 24>;
/// 8 x 8 node matrix.
using CellMass = std::array<std::array<double, 8>, 8>;

/// K_e = integral of B^T D B, 2 x 2 x 2 Gauss points. D must be symmetric.
CellStiffness cell_stiffness(const std::array<Vec3, 8>& x, const VoigtMatrix& D);

/// M_ab = integral of rho N_a N_b by 3 x 3 x 3 Gauss points: exact on distorted cells too (degree 4 or less in each
/// direction, where 2 x 2 x 2 is exact for parallelepipeds only).
CellMass cell_mass(const std::array<Vec3, 8>& x, double rho);

/// Lumped mass of the nodes: the diagonal of M_e scaled to the mass of the cell (Hinton, Rock and Zienkiewicz, Earthq.
/// Eng. Struct. Dyn. 4, 1976).
std::array<double, 8> lumped(const CellMass& mass);

/// Upper bound of the largest eigenvalue omega^2 of K_e with the lumped node masses m: |A^8|^(1/8) with the largest
/// absolute row sum as norm and A = M^-1/2 K_e M^-1/2. Any power bounds the spectral radius (Gelfand; the first is
/// Gershgorin's bound); the eighth is at most 24^(1/16) = 1.22 times too large.
double frequency_bound(const CellStiffness& K, const std::array<double, 8>& m);

}  // namespace carom
