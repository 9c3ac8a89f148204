// Meshes of axis-aligned blocks of HEXA8, without a file.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// Block [origin, origin + size] cut into divisions[0] x divisions[1] x divisions[2] equal HEXA8.
struct StructuredBlock {
  Location where;  ///< for messages
  Vec3 origin{};
  Vec3 size{};  ///< all components positive
  std::array<int, 3> divisions{1, 1, 1};
  std::string cells_group = "BLOCK";  ///< all cells; "" gives no group
  /// Groups of QUAD4 (outward normals) on xmin, xmax, ymin, ymax, zmin, zmax; "" gives no group and no QUAD4.
  std::array<std::string, 6> face_groups{"XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX"};
  /// A node group of one node: the node nearest to `position`, at most 1e-6 of the block's diagonal away.
  struct Point {
    std::string name;
    Vec3 position{};
    Location where;
  };
  std::vector<Point> points;
};

/// One mesh of all blocks. Nodes of different blocks are never merged; groups of the same name are united. Node and
/// cell numbers count from 1, x fastest, block after block, the HEXA8 before the QUAD4 of all blocks.
/// Throws CaseError for a size or division that is not positive, a point without a node, or more than 2^31 - 1 nodes.
Mesh make_structured_blocks(const std::vector<StructuredBlock>& blocks);

}  // namespace carom
