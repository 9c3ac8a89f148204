// Gmsh's numbers for cell types and its node orders.
#pragma once

#include <cstdint>
#include <span>

#include "mesh/cell_topology.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// A cell type of Gmsh. `order[i]` is the place in the file of our local node i.
struct GmshCellType {
  CellType type;
  std::span<const LocalNode> order;
};

/// The type with this number in the file (Gmsh reference manual, section "MSH file format"), or nullptr.
const GmshCellType* gmsh_cell_type(std::int64_t number);

}  // namespace carom
