// The cell that the finest motions and the shortest steps are measured by.
#pragma once

#include <algorithm>
#include <vector>

#include "solid/solid.hpp"

namespace carom {

/// Least of BodyCells::lengths, in the reference position; 0 without cells. What belongs to a place takes the cells
/// there (node_lengths of model/node_lengths.hpp).
inline double smallest_cell(const Solid& solid) {
  const std::vector<double>& lengths = solid.cells().lengths;
  return lengths.empty() ? 0.0 : *std::min_element(lengths.begin(), lengths.end());
}

}  // namespace carom
