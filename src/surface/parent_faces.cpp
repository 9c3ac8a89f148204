#include "surface/parent_faces.hpp"

#include <algorithm>
#include <map>

#include "element/shapes/line3.hpp"
#include "element/shapes/quad8.hpp"
#include "element/shapes/quad9.hpp"
#include "element/shapes/tria6.hpp"
#include "math/dual.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"

namespace carom {
namespace {

/// Parent coordinates of the nodes of a face: corners, middles of the edges, centre.
std::array<ParentPoint, 9> node_points(CellType type) {
  if (dimension(type) == 1) return {{{-1.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}}};
  std::array<ParentPoint, 9> at{};
  const auto corners = static_cast<std::size_t>(corner_count(type));
  if (corners == 3) {
    at = {{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};
  } else {
    at = {{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}};
  }
  for (std::size_t a = 0; a < corners; ++a) {
    const ParentPoint &p = at[a], &q = at[(a + 1) % corners];
    at[corners + a] = {0.5 * (p.xi + q.xi), 0.5 * (p.eta + q.eta)};
  }
  return at;
}

using FacetKey = std::array<Index, 4>;

FacetKey key_of(Facet facet) {
  std::sort(facet.node.begin(), facet.node.end());
  return facet.node;
}

ParentFace linear_face(const Facet& facet) {
  ParentFace face;
  face.type = facet.size == 4   ? CellType::quad4
              : facet.size == 3 ? CellType::tria3
              : facet.size == 2 ? CellType::line2
                                : CellType::point1;
  face.size = facet.size;
  std::copy(facet.begin(), facet.end(), face.node.begin());
  return face;
}

/// Enters the pieces of one face of a cell that are wanted.
void enter_pieces(const CellFace& face, std::span<const Index> cell, std::map<FacetKey, ParentFace>& wanted) {
  const std::array<ParentPoint, 9> points = node_points(face.type);
  for (const FacePiece& piece : face_pieces(face.type)) {
    Facet facet;
    facet.size = piece.size;
    for (std::size_t a = 0; a < static_cast<std::size_t>(piece.size); ++a)
      facet.node[a] = cell[face.node[piece.node[a]]];
    const auto entry = wanted.find(key_of(facet));
    if (entry == wanted.end()) continue;
    ParentFace& parent = entry->second;
    parent.type = face.type;
    parent.size = node_count(face.type);
    parent.is_linear = false;
    for (std::size_t a = 0; a < static_cast<std::size_t>(parent.size); ++a) parent.node[a] = cell[face.node[a]];
    for (std::size_t a = 0; a < static_cast<std::size_t>(piece.size); ++a) parent.corner[a] = points[piece.node[a]];
  }
}

/// The corners of the facet in its own order, which may be another one than that of the piece.
void order_corners(const Facet& facet, ParentFace& face) {
  const std::array<ParentPoint, 9> points = node_points(face.type);
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) {
    const auto k = std::find(face.nodes().begin(), face.nodes().end(), facet[a]) - face.nodes().begin();
    face.corner[a] = points[static_cast<std::size_t>(k)];
  }
}

template <class Shape>
FaceShape values_of(const ParentPoint& at) {
  constexpr int dim = Shape::dimension;
  Dual<dim> xi[dim], N[Shape::nodes];
  xi[0] = at.xi;
  xi[0].d[0] = 1.0;
  if constexpr (dim == 2) {
    xi[1] = at.eta;
    xi[1].d[1] = 1.0;
  }
  Shape::values(xi, N);
  FaceShape out;
  for (std::size_t a = 0; a < static_cast<std::size_t>(Shape::nodes); ++a) {
    out.N[a] = N[a].value;
    out.dN_dxi[a] = N[a].d[0];
    if constexpr (dim == 2) out.dN_deta[a] = N[a].d[1];
  }
  return out;
}

}  // namespace

std::vector<ParentFace> parent_faces(const Mesh& mesh, std::span<const Facet> facets) {
  std::vector<ParentFace> faces;
  for (const Facet& facet : facets) faces.push_back(linear_face(facet));
  std::map<FacetKey, ParentFace> wanted;
  if (std::any_of(mesh.blocks.begin(), mesh.blocks.end(),
                  [](const CellBlock& b) { return has_quadratic_faces(b.type); }))
    for (const Facet& facet : facets) wanted[key_of(facet)];
  for (const CellBlock& block : mesh.blocks) {
    if (!has_quadratic_faces(block.type) || wanted.empty()) continue;
    for (Index c = 0; c < static_cast<Index>(block.size()); ++c)
      for (const CellFace& face : cell_faces(block.type)) enter_pieces(face, block.nodes(c), wanted);
  }
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto found = wanted.find(key_of(facets[f]));
    if (found == wanted.end() || found->second.is_linear) continue;
    faces[f] = found->second;
    order_corners(facets[f], faces[f]);
  }
  return faces;
}

ParentPoint in_parent(const ParentFace& face, const Facet& facet, const ParentPoint& at) {
  if (face.is_linear) return at;
  const std::array<double, 4> N = facet_shape(facet.size, at.xi, at.eta).N;
  ParentPoint out;
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) {
    out.xi += N[a] * face.corner[a].xi;
    out.eta += N[a] * face.corner[a].eta;
  }
  return out;
}

FaceShape face_shape(const ParentFace& face, const ParentPoint& at) {
  switch (face.type) {
    case CellType::line3:
      return values_of<Line3>(at);
    case CellType::tria6:
      return values_of<Tria6>(at);
    case CellType::quad8:
      return values_of<Quad8>(at);
    case CellType::quad9:
      return values_of<Quad9>(at);
    default:
      break;
  }
  const FacetShape linear = facet_shape(face.size, at.xi, at.eta);
  FaceShape out;
  std::copy(linear.N.begin(), linear.N.end(), out.N.begin());
  std::copy(linear.dN_dxi.begin(), linear.dN_dxi.end(), out.dN_dxi.begin());
  std::copy(linear.dN_deta.begin(), linear.dN_deta.end(), out.dN_deta.begin());
  return out;
}

FacetFrame face_frame(const ParentFace& face, const FaceShape& shape, std::span<const Vec3> x) {
  FacetFrame frame;
  if (face.is_linear) {
    PlacedFacet placed{{}, face.size};
    FacetShape linear;
    for (std::size_t a = 0; a < static_cast<std::size_t>(face.size); ++a) {
      placed.x[a] = x[static_cast<std::size_t>(face.node[a])];
      linear.N[a] = shape.N[a];
      linear.dN_dxi[a] = shape.dN_dxi[a];
      linear.dN_deta[a] = shape.dN_deta[a];
    }
    return facet_frame(placed, linear);
  }
  for (std::size_t a = 0; a < static_cast<std::size_t>(face.size); ++a) {
    const Vec3& at = x[static_cast<std::size_t>(face.node[a])];
    frame.position = add(frame.position, scaled(at, shape.N[a]));
    frame.a_1 = add(frame.a_1, scaled(at, shape.dN_dxi[a]));
    frame.a_2 = add(frame.a_2, scaled(at, shape.dN_deta[a]));
  }
  if (dimension(face.type) == 1) frame.a_2 = {0.0, 0.0, 1.0};
  const Vec3 n = cross(frame.a_1, frame.a_2);
  frame.jacobian = std::sqrt(dot(n, n));
  frame.normal = direction(n);
  return frame;
}

double distance_from_facet(const ParentFace& face, const Facet& facet, std::span<const Vec3> x) {
  if (face.is_linear) return 0.0;
  static constexpr ParentPoint segment[1] = {{0.0, 0.0}};
  static constexpr ParentPoint triangle[4] = {{1.0 / 3.0, 1.0 / 3.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}};
  static constexpr ParentPoint quad[5] = {{0.0, 0.0}, {0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}};
  const std::span<const ParentPoint> middles =
      facet.size == 2 ? std::span<const ParentPoint>(segment)
                      : (facet.size == 3 ? std::span<const ParentPoint>(triangle) : std::span<const ParentPoint>(quad));
  const PlacedFacet placed = place(facet, x);
  double most = 0.0;
  for (const ParentPoint& at : middles) {
    const Vec3 on_face = face_frame(face, face_shape(face, in_parent(face, facet, at)), x).position;
    most = std::max(most, norm(subtract(on_face, facet_position(placed, at.xi, at.eta))));
  }
  return most;
}

}  // namespace carom
