// The solid cells in batches: blocks of one part, cut into coloured chunks.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "model/model.hpp"
#include "parallel/threads.hpp"
#include "solid/cell_matrices.hpp"
#include "solid/kernels.hpp"

namespace carom {

/// The cells of one part, laid out for the kernels (CellBatches).
struct Block {
  Index first = 0;  ///< position of its first cell in SolidCells::cells
  Index cells = 0;
  int lanes = 1;
  Section section = Section::solid;
  double thickness = 1.0, rho = 0.0;
  bool small_strain = true;  ///< LinearElastic; the other laws are total Lagrangian
  LameParameters lame;
  const CellOperations* operations = nullptr;
  CellKernels kernels;
  LawKernels batch_law;  ///< for the kernels
  LawKernels cell_law;   ///< for the operations, one lane
  std::vector<Index> offset;

  std::size_t nodes() const { return operations->nodes; }
  BatchLaw law() const { return {batch_law.update, batch_law.tangent, &lame}; }
  CellMatrix stiffness(const CellNodes& x, const CellNodes& u) const;
};

/// Consecutive cells of one block, whole batches but for the block's last.
struct Chunk {
  Index block = 0;
  Index first = 0;  ///< cell in the block, a multiple of the lanes
  Index cells = 0;
};

/// All solid cells. Chunk bounds and colours depend on the mesh alone, never on the number of threads.
struct SolidCells {
  std::shared_ptr<const Mesh> mesh;
  std::vector<CellRef> cells;
  std::vector<Block> blocks;              ///< one per part that has cells
  std::vector<Chunk> chunks;              ///< sorted by colour
  std::vector<std::size_t> colour_begin;  ///< colours + 1 entries into chunks

  /// Nodes of the cell at a position in `cells`.
  std::span<const Index> nodes_of(std::size_t position) const;
  /// Reference coordinates of its nodes.
  CellNodes coordinates_of(std::size_t position) const;
  /// Entries of a dof vector at its nodes.
  CellNodes values_of(std::size_t position, std::span<const double> u) const;
  /// The kernels' view of `count` cells of a block from its cell `first` on, which must be a multiple of the lanes.
  CellBatches batches(const Block& block, Index first, Index count) const;

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

/// Lays the parts out in batches: HEXA8 by the lanes of `table`, the other cells one by one. Throws CaseError when a
/// part names a cell that its block does not have, when a cell is in two parts, when its section does not fit its cell
/// type, or when a cell is degenerate: a Jacobian determinant at a Gauss point that is not positive, plane cells of
/// changing z, axisymmetric ones with a node at negative x.
SolidCells make_solid_cells(const Model& model, const KernelTable& table);

}  // namespace carom
