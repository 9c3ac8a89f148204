// The cells at a node, as a length.
#pragma once

#include <vector>

#include "model/model.hpp"

namespace carom {

/// Least length (cell_length of mesh/cell_size.hpp) of the parts' cells at each node, in the reference position;
/// infinity at nodes of none.
std::vector<double> node_lengths(const Model& model);

}  // namespace carom
