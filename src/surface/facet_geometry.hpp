// Geometry of one facet at its current position: shape functions, tangents, normal, area; normals of a surface.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "element/quad4.hpp"
#include "math/vec3.hpp"
#include "mesh/facet.hpp"

namespace carom {

/// Parent coordinates of a point of a facet.
struct ParentPoint {
  double xi = 0.0, eta = 0.0;
};

/// A facet at its current position. Parent coordinates (xi, eta):
///   point: none;  segment: xi in [-1, 1], node 0 at -1;
///   triangle: xi, eta >= 0, xi + eta <= 1, nodes (0,0), (1,0), (0,1);
///   quadrilateral: [-1, 1]^2, nodes (-1,-1), (1,-1), (1,1), (-1,1).
/// Segments lie in a plane z = const.
struct PlacedFacet {
  std::array<Vec3, 4> x{};
  int size = 0;  ///< number of nodes: 1, 2, 3 or 4
};

/// The facet with the positions of its nodes.
inline PlacedFacet place(const Facet& facet, std::span<const Vec3> coordinates) {
  PlacedFacet placed{{}, facet.size};
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) placed.x[a] = coordinates[facet[a]];
  return placed;
}

/// Shape functions of a facet and their derivatives by the parent coordinates; zero for nodes that it does not have.
struct FacetShape {
  std::array<double, 4> N{}, dN_dxi{}, dN_deta{};
};

/// Linear (segment, triangle) or bilinear (quadrilateral) shape functions; N_0 = 1 for a point.
inline FacetShape facet_shape(int size, double xi, double eta) {
  if (size == 4) {
    return {quad4::shape(xi, eta),
            {-0.25 * (1 - eta), 0.25 * (1 - eta), 0.25 * (1 + eta), -0.25 * (1 + eta)},
            {-0.25 * (1 - xi), -0.25 * (1 + xi), 0.25 * (1 + xi), 0.25 * (1 - xi)}};
  }
  if (size == 3) return {{1.0 - xi - eta, xi, eta, 0.0}, {-1.0, 1.0, 0.0, 0.0}, {-1.0, 0.0, 1.0, 0.0}};
  if (size == 2) return {{0.5 * (1.0 - xi), 0.5 * (1.0 + xi), 0.0, 0.0}, {-0.5, 0.5, 0.0, 0.0}, {}};
  return {{1.0, 0.0, 0.0, 0.0}, {}, {}};
}

/// n / |n|, or zero; faster than normalized().
inline Vec3 direction(const Vec3& n) {
  const double length = std::sqrt(dot(n, n));
  return length > 0.0 ? scaled(n, 1.0 / length) : Vec3{};
}

/// Two unit normals oppose each other when their product is below this: sides that stand at a right angle do not.
inline constexpr double opposed = -0.1;

/// Normal at the centre times area or length; zero for a point.
inline Vec3 area_vector(const PlacedFacet& facet) {
  const auto& x = facet.x;
  if (facet.size == 4) return scaled(cross(subtract(x[2], x[0]), subtract(x[3], x[1])), 0.5);
  if (facet.size == 3) return scaled(cross(subtract(x[1], x[0]), subtract(x[2], x[0])), 0.5);
  if (facet.size == 2) return {x[1][1] - x[0][1], x[0][0] - x[1][0], 0.0};
  return {};
}

/// Parent coordinates of the centre (the mean of the nodes).
ParentPoint facet_centre(int size);

/// sum over a of N_a x_a, also outside of the facet.
Vec3 facet_position(const PlacedFacet& facet, double xi, double eta);

/// Position, tangents a_1 = dx/dxi and a_2 = dx/deta, unit outward normal n = a_1 x a_2 / |a_1 x a_2| and Jacobian
/// |a_1 x a_2| (area, or length for a segment, per unit of the parent coordinates). A segment has a_2 = e_z, hence
/// n = (dy, -dx, 0) / length. A point has zero tangents and normal, and Jacobian 1. Where the parametrisation is
/// singular (the collapsed edge of a quadrilateral with a repeated node) n is the normal at the centre.
struct FacetFrame {
  Vec3 position{}, a_1{}, a_2{}, normal{};
  double jacobian = 0.0;
};
FacetFrame facet_frame(const PlacedFacet& facet, const FacetShape& shape);
inline FacetFrame facet_frame(const PlacedFacet& facet, double xi, double eta) {
  return facet_frame(facet, facet_shape(facet.size, xi, eta));
}
/// The frame of a facet with position and tangents alone.
FacetFrame facet_tangents(const PlacedFacet& facet, const FacetShape& shape);

/// Length of a segment, area of a triangle or a quadrilateral (2 x 2 Gauss points: exact when flat), 1 for a point.
double measure(const PlacedFacet& facet);

/// Length of a segment, square root of the area of a triangle or a quadrilateral, 1 for a point.
double facet_size(const PlacedFacet& facet);

/// Averaged unit normals at the nodes of a surface, n_a along the sum over facets of (integral of N_a n dGamma): the
/// average of the facets' normals weighted by the areas of the node's share, which is the gradient of the enclosed
/// volume by the node's position. normals is indexed like coordinates and grows to their number; entries of nodes that
/// are not on the surface are left alone. A node whose facets cancel (a sheet folded on itself) gets zero, as do
/// points.
void nodal_normals(std::span<const Facet> surface, std::span<const Vec3> coordinates, std::vector<Vec3>& normals);

}  // namespace carom
