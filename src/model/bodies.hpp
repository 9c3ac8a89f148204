// Which nodes belong to one connected body.
#pragma once

#include <vector>

#include "model/model.hpp"

namespace carom {

/// By node of the mesh: a number that is the same for all nodes of one body, the cells of parts that hang together by
/// common nodes; -1 for nodes of no part. Interface cells connect nothing.
std::vector<Index> bodies_of_nodes(const Model& model);

}  // namespace carom
