// Meshes of blocks, plane strips and bars, without a file.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// A regular grid of equal cells, of one of three kinds:
///   hexa: the box [origin, origin + size], divisions[0] x divisions[1] x divisions[2] HEXA8;
///   quad: the rectangle [origin, origin + size] in the plane z = origin[2], divisions[0] x divisions[1] QUAD4,
///         counter-clockwise; size[2] and divisions[2] are not used;
///   bar:  the line from origin to end, in any direction, divisions[0] LINE2.
struct StructuredBlock {
  Location where;  ///< for messages
  enum class Kind : std::uint8_t { hexa, quad, bar } kind = Kind::hexa;
  Vec3 origin{};
  Vec3 size{};  ///< hexa, quad: all positive
  Vec3 end{};   ///< bar
  std::array<int, 3> divisions{1, 1, 1};
  std::string cells_group = "BLOCK";  ///< all cells; "" gives no group
  /// Groups on xmin, xmax, ymin, ymax, zmin, zmax: QUAD4 with outward normals (hexa), LINE2 with the body on their left
  /// (quad, the first four); "" gives no group and no cells.
  std::array<std::string, 6> face_groups{"XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX"};
  /// Node groups of the first and the last node of a bar; "" gives no group.
  std::array<std::string, 2> end_groups{"START", "END"};
  /// A node group of one node: the node nearest to `position`, at most 1e-6 of the block's diagonal away.
  struct Point {
    std::string name;
    Vec3 position{};
    Location where;
  };
  std::vector<Point> points;
};

/// One mesh of all blocks. Nodes of different blocks are never merged; groups of the same name are united. Node and
/// cell numbers count from 1, x fastest, block after block, the cells of all blocks before those of the boundaries.
/// Throws CaseError for a size or division that is not positive, a point without a node, or more than 2^31 - 1 nodes.
Mesh make_structured_blocks(const std::vector<StructuredBlock>& blocks);

}  // namespace carom
