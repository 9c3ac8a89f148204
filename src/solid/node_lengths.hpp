// The cells at a node, as a length.
#pragma once

#include <vector>

#include "solid/solid.hpp"

namespace carom {

/// Least length (Solid::cell_lengths) of the cells at each node; infinity at nodes of none.
std::vector<double> node_lengths(const Solid& solid);

}  // namespace carom
