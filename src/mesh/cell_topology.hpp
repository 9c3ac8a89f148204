// Corners, mirrored node orders and faces of the cell types, as tables.
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
/// what leads from MED's order to ours for solids. Empty for points, lines and faces.
std::span<const LocalNode> mirrored_order(CellType type);

/// Pairings of the corners of opposite faces (edges of a QUAD4): three of four pairs for hexahedra, one of three pairs
/// for pentahedra, two of two pairs for QUAD4. When all pairs of one pairing coincide in space the cell is an interface
/// of zero thickness.
std::span<const std::span<const std::array<LocalNode, 2>>> opposite_faces(CellType type);

/// The six faces of a HEXA8 with outward normals.
inline constexpr std::array<std::array<LocalNode, 4>, 6> hexa8_faces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// Per node the highest dimension of the cells it belongs to; 0 for nodes without cells. A cell is a piece of the
/// boundary of others (on_boundary) where all its nodes belong to cells of higher dimension.
std::vector<std::uint8_t> node_dimensions(const Mesh& mesh);
bool on_boundary(std::span<const Index> nodes, CellType type, std::span<const std::uint8_t> node_dimensions);

}  // namespace carom
