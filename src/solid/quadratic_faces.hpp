// Pressure on the faces of cells of second order.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace carom {

/// A face of second order with its nodes (TRIA6, QUAD8, QUAD9, or LINE3 in two dimensions).
struct QuadraticFace {
  CellType type{};
  std::array<Index, 9> node{};
};

/// The faces of second order that facets are pieces of (mesh/skin.hpp), of cells that interpolate by polynomials of
/// second order: all but TETRA10, which is a composite of linear ones. Their pieces are taken out of the facets.
std::vector<QuadraticFace> take_quadratic_faces(const Mesh& mesh, std::vector<Facet>& facets);

/// Integral of N_a n dA over the face, for each of its nodes, n dA by the right-hand rule; of a LINE3 in the x-y plane
/// n = (dy, -dx) times the thickness, or 2 pi x of an axisymmetric section. Exact: rules of degree 4 (triangles; degree
/// 5 in each direction of the others) for products of degree 4 and 5.
std::array<Vec3, 9> nodal_area_vectors(const QuadraticFace& face, const Mesh& mesh, Section section, double thickness);

}  // namespace carom
