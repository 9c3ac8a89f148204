// The cell types as the solid integrates over them: quadrature points with gradients, and the mass integrals.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/types.hpp"
#include "element/hexa8_kernel.hpp"
#include "element/kinematics.hpp"

namespace carom {

/// One quadrature point of a cell of n nodes. The displacement gradient in the reference frame is
/// H_iJ = sum over a of u_ai gradient[a][J], plus sum over a of u_a0 hoop[a] in H_22 of axisymmetric cells; the
/// deformation gradient is frame + H. The frame is 1 but for bars, whose first reference direction is their axis and
/// which have no others: its columns are (axis, 0, 0).
template <std::size_t n>
struct PointShape {
  double weight = 0.0;             ///< reference volume that the point stands for
  double det_J = 0.0;              ///< Jacobian determinant of the map from the parent cell
  std::array<Vec3, n> gradient{};  ///< dN/dX, 1/length
  std::array<double, n> hoop{};    ///< N / X, 1/length; zero unless axisymmetric
  double frame[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

/// density x integral of N_a N_b over the reference volume, by rules that are exact on distorted cells too.
template <std::size_t n>
using NodeProducts = std::array<std::array<double, n>, n>;

/// What the cell types below have in common: nodes, quadrature points, displacement components that strain the cell.
/// `thickness` is that of a plane cell, the area of a bar's section, and unused by the others.
template <std::size_t node_count, std::size_t point_count, std::size_t component_count>
struct CellShape {
  static constexpr std::size_t nodes = node_count, points = point_count, components = component_count;
  using Nodes = std::array<Vec3, nodes>;
  using Point = PointShape<nodes>;
  /// Factor of the volume change of a deformation gradient; not positive: the cell is inverted.
  static double jacobian(const double F[3][3]) { return determinant(F); }
};

/// HEXA8, 2 x 2 x 2 Gauss points.
struct HexaShape : CellShape<8, 8, 3> {
  static Point point(const Nodes& x, std::size_t p, double thickness);
  static Point centre(const Nodes& x, double thickness);
  static NodeProducts<8> node_products(const Nodes& x, double thickness, double density);
  static double length(const Nodes& x);  ///< volume over the largest face
};

/// QUAD4 in the x-y plane, 2 x 2 Gauss points.
struct PlaneShape : CellShape<4, 4, 2> {
  static Point point(const Nodes& x, std::size_t p, double thickness);
  static Point centre(const Nodes& x, double thickness);
  static NodeProducts<4> node_products(const Nodes& x, double thickness, double density);
  static double length(const Nodes& x);  ///< area over the longest edge
};

/// QUAD4 turned about the y axis: volumes carry 2 pi x (the whole circumference), the hoop strain is u_x / x.
struct AxisymmetricShape : CellShape<4, 4, 2> {
  static Point point(const Nodes& x, std::size_t p, double thickness);
  static Point centre(const Nodes& x, double thickness);
  static NodeProducts<4> node_products(const Nodes& x, double thickness, double density);
  static double length(const Nodes& x);  ///< area over the longest edge
};

/// LINE2 bar in space, 1 Gauss point.
struct BarShape : CellShape<2, 1, 3> {
  static Point point(const Nodes& x, std::size_t p, double thickness);
  static Point centre(const Nodes& x, double thickness);
  static NodeProducts<2> node_products(const Nodes& x, double thickness, double density);
  static double length(const Nodes& x);
  /// Square of the axial stretch.
  static double jacobian(const double F[3][3]) { return F[0][0] * F[0][0] + F[1][0] * F[1][0] + F[2][0] * F[2][0]; }
};

/// The shape's length of a cell by the number of its nodes: 8, 4 or 2.
double cell_length(std::span<const Vec3> x);

/// H at a point, of nodal displacements.
template <class Shape>
void displacement_gradient(const typename Shape::Point& point, const typename Shape::Nodes& u, double H[3][3]) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) H[i][j] = 0.0;
  for (std::size_t a = 0; a < Shape::nodes; ++a) {
    for (std::size_t i = 0; i < Shape::components; ++i)
      for (std::size_t j = 0; j < 3; ++j) H[i][j] += u[a][i] * point.gradient[a][j];
    H[2][2] += u[a][0] * point.hoop[a];
  }
}

/// Adds to nodal forces those of a first Piola-Kirchhoff stress at the point: the transpose of displacement_gradient.
template <class Shape>
void add_nodal_force(const typename Shape::Point& point, const double P[3][3], typename Shape::Nodes& f) {
  for (std::size_t a = 0; a < Shape::nodes; ++a) {
    const Vec3& g = point.gradient[a];
    for (std::size_t i = 0; i < Shape::components; ++i)
      f[a][i] += point.weight * (P[i][0] * g[0] + P[i][1] * g[1] + P[i][2] * g[2]);
    f[a][0] += point.weight * P[2][2] * point.hoop[a];
  }
}

}  // namespace carom
