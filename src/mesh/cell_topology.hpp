// Corners, edges, faces, mirrored node orders and VTK's numbers of the cell types, as tables.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace carom {

using LocalNode = std::uint8_t;

/// A corner and its three neighbours along the edges, so ordered that (a - corner) x (b - corner) . (c - corner) is
/// positive in a cell of positive volume. For linear cells this triple product is det J at the corner times a constant.
struct CornerFrame {
  LocalNode corner, a, b, c;
};

/// Corner frames of a solid; empty for points, lines and faces.
std::span<const CornerFrame> corner_frames(CellType type);

/// The node order of the mirror image: entry i is the old local index of the new node i. Applied to a cell of negative
/// volume it gives a positive one over the same nodes, mid-side nodes included. It is its own inverse, and it is also
/// what leads from MED's order to ours for solids. Faces are turned over; empty for points and lines.
std::span<const LocalNode> mirrored_order(CellType type);

/// Pairings of the corners of opposite faces (edges of a QUAD4): three of four pairs for hexahedra, one of three pairs
/// for pentahedra, two of two pairs for QUAD4. When all pairs of one pairing coincide in space the cell is an interface
/// of zero thickness.
std::span<const std::span<const std::array<LocalNode, 2>>> opposite_faces(CellType type);

/// The type of the cell of the corners alone, e.g. TETRA4 of TETRA10.
CellType linear_type(CellType type);

/// The edges as pairs of corners; one edge of a line, none of a point. Of a quadratic cell the middle of edge e is node
/// corner_count + e.
std::span<const std::array<LocalNode, 2>> cell_edges(CellType type);

/// One piece of the boundary of a cell, itself a cell of one dimension less over nodes of it.
struct CellFace {
  CellType type{};
  std::array<LocalNode, 9> node{};

  std::span<const LocalNode> nodes() const { return {node.data(), static_cast<std::size_t>(node_count(type))}; }
  std::span<const LocalNode> corners() const { return {node.data(), static_cast<std::size_t>(corner_count(type))}; }
};

/// Faces of a solid, whose right-hand normal points outward; edges of a plane cell, which has them on its left if it is
/// counter-clockwise; ends of a line; nothing of a point.
std::span<const CellFace> cell_faces(CellType type);

/// A linear piece of a face: a point, a segment, a triangle or a quadrilateral.
struct FacePiece {
  std::array<LocalNode, 4> node{};
  int size = 0;
};

/// The linear pieces over the nodes of a point, line or face that contact sees in its place, oriented as it is. Linear
/// ones stand for themselves; LINE3: two segments; TRIA6: four triangles; QUAD9: four quadrilaterals; QUAD8: the
/// quadrilateral of the mid-side nodes and four triangles at the corners. Their shape functions share a pressure among
/// the nodes with positive weights (of the area: TRIA6 1/12 at corners, 1/4 at middles; QUAD8 1/24 and 5/24), where
/// those of the quadratic face have zero or negative ones at the corners, which no contact force can have.
std::span<const FacePiece> face_pieces(CellType type);

/// True of cells whose shape functions are of second order on their faces. TETRA10, a composite of linear tetrahedra,
/// is linear on every piece.
bool has_quadratic_faces(CellType type);

/// VTK's number of the type (VTK file formats, "VTK cell types") and its node order: entry i is our local index of
/// VTK's node i; empty where the orders are the same. They are but for pentahedra: the base of VTK's wedge looks
/// outward.
struct VtkCellType {
  std::uint8_t number = 0;
  std::span<const LocalNode> order;
};
VtkCellType vtk_cell_type(CellType type);

/// Per node the highest dimension of the cells it belongs to; 0 for nodes without cells. A cell is a piece of the
/// boundary of others (on_boundary) where all its nodes belong to cells of higher dimension.
std::vector<std::uint8_t> node_dimensions(const Mesh& mesh);
bool on_boundary(std::span<const Index> nodes, CellType type, std::span<const std::uint8_t> node_dimensions);

}  // namespace carom
