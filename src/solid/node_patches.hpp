// Nodal integration of linear tetrahedra and triangles: each node of a part with the cells about it is one cell more,
// its patch (kernels/patch_stages.hpp).
#pragma once

#include <span>
#include <vector>

#include "solid/blocks.hpp"

namespace carom {

/// The patches of the parts of formulation "nodal". They are integrated in place of the part's cells, whose volume they
/// share; the cells' values are means over the patches of their nodes.
struct NodePatches {
  SolidCells cells;                ///< the patches, in blocks of about equal numbers of neighbours
  std::vector<std::size_t> begin;  ///< of each solid cell into `of_cell`; empty without patches
  std::vector<Index> of_cell;      ///< positions of the patches of its nodes; cells integrated by themselves have none
  std::vector<std::size_t> part_begin;  ///< of each patch into `parts`
  std::vector<Index> parts;  ///< the cells of each patch, in the order of its corners, positions among the solid cells

  bool empty() const { return begin.empty(); }
  std::span<const Index> of(std::size_t cell) const {
    if (empty()) return {};
    return std::span<const Index>(of_cell).subspan(begin[cell], begin[cell + 1] - begin[cell]);
  }
  std::span<const Index> cells_of(std::size_t patch) const {
    return std::span<const Index>(parts).subspan(part_begin[patch], part_begin[patch + 1] - part_begin[patch]);
  }
};

/// Of the parts' cells `solid`; their history begins where that of `solid` ends. Throws CaseError where a node has too
/// many neighbours or cells about it.
NodePatches make_node_patches(const Model& model, const SolidCells& solid, const KernelTable& table);

/// The neighbours of a node in some cells, and the cells about it.
struct Valence {
  Index node = -1;
  std::size_t neighbours = 0, cells = 0;
  bool is_within_patch() const { return neighbours <= most_neighbours && cells <= most_patch_cells; }
};
/// Of the first node that a patch has no place for, else of one with the most neighbours.
Valence largest_valence(const Mesh& mesh, CellType type, std::span<const Index> cells);

}  // namespace carom
