// HEXA8: the trilinear hexahedron (shape functions, quadrature, faces). Knows no physics.
#pragma once

#include <array>

#include "base/types.hpp"

namespace carom::hexa8 {

/// Parent coordinates of the nodes on [-1, 1]^3, in the order of Gmsh, VTK and Abaqus.
inline constexpr std::array<Vec3, 8> node_position{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

/// Local nodes of the six faces; the right-hand rule gives the outward normal.
inline constexpr std::array<std::array<int, 4>, 6> faces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// A point of a quadrature rule on [-1, 1]^3.
struct QuadraturePoint {
  Vec3 xi{};
  double weight = 0.0;
};

/// Gauss-Legendre product rules, xi running fastest: 2 x 2 x 2 integrates degree 3 in each direction exactly (the
/// volume of any HEXA8), 3 x 3 x 3 degree 5 (the mass matrix of any HEXA8).
const std::array<QuadraturePoint, 8>& gauss_2();
const std::array<QuadraturePoint, 27>& gauss_3();

/// N_a = (1 + xi xi_a)(1 + eta eta_a)(1 + zeta zeta_a) / 8.
std::array<double, 8> shape(const Vec3& xi);
/// dN_a / dxi_k, [a][k].
std::array<Vec3, 8> shape_gradient(const Vec3& xi);

/// Gradients with respect to X at one point, and the Jacobian determinant.
struct PhysicalGradient {
  std::array<Vec3, 8> dN_dX{};
  double det_J = 0.0;
};

/// dN_dX[a][j] = sum over k of dN_a/dxi_k (J^-1)_kj with J_ij = dX_i/dxi_j. det_J may be zero or negative; then dN_dX
/// is not meaningful.
PhysicalGradient physical_gradient(const std::array<Vec3, 8>& x, const Vec3& xi);

/// Volume (exact for any HEXA8) and smallest Jacobian determinant at the 2 x 2 x 2 Gauss points.
struct Volume {
  double volume = 0.0;
  double smallest_det_J = 0.0;
};
Volume volume(const std::array<Vec3, 8>& x);

/// The volume alone, in closed form (Grandy, Efficient computation of volume of hexahedral cells, UCRL-ID-128886,
/// 1997).
double exact_volume(const std::array<Vec3, 8>& x);

/// Volume over the largest face area (2 x 2 Gauss): the edge of a cube, the thickness of a plate.
double length(const std::array<Vec3, 8>& x);

}  // namespace carom::hexa8
