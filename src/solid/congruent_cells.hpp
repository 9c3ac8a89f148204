// Cells of the same shape.
#pragma once

#include <span>
#include <vector>

#include "solid/blocks.hpp"

namespace carom {

/// Cells sorted by shape: cell k of those given is, but for where it stands, cell first[of[k]].
struct CongruentCells {
  std::vector<std::size_t> first;
  std::vector<std::size_t> of;
};

/// Congruent are cells whose nodes lie equally about their first one, to 2^-36 of the cell's size: what follows from
/// the shape is then the same to some 1e-9. Axisymmetric cells are never so, since their radius counts, and patches of
/// nodes are not looked at. `count` cells from cell `first` of a block on.
CongruentCells congruent_cells(const SolidCells& solid, const Block& block, Index first, Index count);

}  // namespace carom
