// The solid cells in batches: blocks of one part, cut into coloured chunks.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "material/linear_elastic_update.hpp"
#include "model/model.hpp"
#include "parallel/threads.hpp"
#include "solid/kernels.hpp"

namespace carom {

/// The cells of one part, laid out for the kernels (CellBatches).
struct Block {
  Index first = 0;  ///< position of its first cell in SolidCells::cells
  Index cells = 0;
  LinearElastic material;
  LameParameters lame;
  std::vector<Index> offset;
};

/// Consecutive cells of one block, whole batches but for the block's last.
struct Chunk {
  Index block = 0;
  Index first = 0;  ///< cell in the block, a multiple of the lanes
  Index cells = 0;
};

/// All solid cells. Chunk bounds and colours depend on the mesh alone, never on the number of threads.
struct SolidCells {
  std::vector<Index> cells;               ///< index in Mesh::block(hexa8)
  std::vector<Block> blocks;              ///< one per part that has cells
  std::vector<Chunk> chunks;              ///< sorted by colour
  std::vector<std::size_t> colour_begin;  ///< colours + 1 entries into chunks

  /// Calls body(chunk) for all chunks; those of one colour at the same time, colours one after the other.
  template <class Body>
  void for_each_chunk(const Body& body) const {
    for (std::size_t k = 0; k + 1 < colour_begin.size(); ++k)
      parallel_for(colour_begin[k + 1] - colour_begin[k], 1,
                   [&](std::size_t begin, std::size_t) { body(chunks[colour_begin[k] + begin]); });
  }

  /// Calls body(cell position, block) for all cells, in the order of for_each_chunk.
  template <class Body>
  void for_each_cell(const Body& body) const {
    for_each_chunk([&](const Chunk& chunk) {
      const Block& block = blocks[static_cast<std::size_t>(chunk.block)];
      const Index first = block.first + chunk.first;
      for (Index c = first; c < first + chunk.cells; ++c) body(static_cast<std::size_t>(c), block);
    });
  }
};

/// Node numbers of a cell of the HEXA8 block.
std::array<Index, 8> cell_nodes(const Mesh& mesh, Index cell);
/// Reference coordinates of its nodes.
std::array<Vec3, 8> cell_coordinates(const Mesh& mesh, Index cell);

/// Lays the parts out in batches of `lanes` cells. Throws CaseError when a part names a cell that the HEXA8 block does
/// not have, when a cell is in two parts, or when a Jacobian determinant at a Gauss point is not positive.
SolidCells make_solid_cells(const Model& model, int lanes);

}  // namespace carom
