// The faces of cells that facets are pieces of, and their shape functions.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {

/// Shape functions of a face of up to nine nodes and their derivatives by the parent coordinates of the face.
struct FaceShape {
  std::array<double, 9> N{}, dN_dxi{}, dN_deta{};
};

/// The face of a cell that a facet is a piece of (face_pieces), with all its nodes: what the cell interpolates over. A
/// linear facet is its own face.
struct ParentFace {
  CellType type = CellType::point1;
  int size = 0;  ///< number of nodes
  std::array<Index, 9> node{};
  std::array<ParentPoint, 4> corner{};  ///< of the facet, in the parent coordinates of the face
  bool is_linear = true;

  std::span<const Index> nodes() const { return {node.data(), static_cast<std::size_t>(size)}; }
};

/// The parent face of each facet. Takes time linear in the number of cells of second order.
std::vector<ParentFace> parent_faces(const Mesh& mesh, std::span<const Facet> facets);

/// A point of a facet in the parent coordinates of its face: sum over the facet's corners of their shape functions.
ParentPoint in_parent(const ParentFace& face, const Facet& facet, const ParentPoint& at);

/// N of the face's nodes and their derivatives at a point in its parent coordinates.
FaceShape face_shape(const ParentFace& face, const ParentPoint& at);

/// Position, tangents and unit normal of the face at a point, its nodes being at x; segments as in facet_frame.
FacetFrame face_frame(const ParentFace& face, const FaceShape& shape, std::span<const Vec3> x);

/// How far the face is from a facet of its, its nodes being at x: the largest distance at the middle of the facet and
/// at those of its edges. 0 for a linear one.
double distance_from_facet(const ParentFace& face, const Facet& facet, std::span<const Vec3> x);

}  // namespace carom
