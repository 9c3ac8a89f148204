// Contact elements of zero thickness on a block.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace carom::test {

/// How an interface cell is numbered: local numbers of the four nodes of the wall's face and of the opposite four.
struct InterfaceNumbering {
  std::array<int, 4> wall{0, 1, 2, 3};
  std::array<int, 4> body{4, 5, 6, 7};
};

/// Appends under every QUAD4 of the group a HEXA8 of zero thickness whose wall nodes are new (one below each node of
/// the group, in the node group WALL). Returns the cells' positions in the block of HEXA8. The wall's nodes run so that
/// their right-hand normal points into the body.
inline std::vector<Index> add_interface(Mesh& mesh, const std::string& group,
                                        const InterfaceNumbering& numbering = {}) {
  std::map<Index, Index> wall_of;
  for (const Index n : mesh.nodes_of(group)) {
    wall_of[n] = static_cast<Index>(mesh.node_count());
    mesh.node_groups["WALL"].push_back(wall_of[n]);
    mesh.coordinates.push_back(mesh.coordinates[static_cast<std::size_t>(n)]);
    mesh.node_numbers.push_back(static_cast<std::int64_t>(mesh.node_count()));
  }
  CellBlock& hexas = *std::find_if(mesh.blocks.begin(), mesh.blocks.end(),
                                   [](const CellBlock& b) { return b.type == CellType::hexa8; });
  std::vector<Index> cells;
  for (const CellRef& ref : mesh.cell_groups.at(group)) {
    const CellBlock& quads = mesh.blocks[static_cast<std::size_t>(ref.block)];
    std::array<Index, 8> cell{};
    for (std::size_t a = 0; a < 4; ++a) {
      const Index n = quads.connectivity[4 * static_cast<std::size_t>(ref.cell) + 3 - a];  // inward
      cell[static_cast<std::size_t>(numbering.wall[a])] = wall_of.at(n);
      cell[static_cast<std::size_t>(numbering.body[a])] = n;
    }
    cells.push_back(static_cast<Index>(hexas.size()));
    hexas.connectivity.insert(hexas.connectivity.end(), cell.begin(), cell.end());
    hexas.file_numbers.push_back(1000 + static_cast<std::int64_t>(cells.size()));
  }
  return cells;
}

}  // namespace carom::test
