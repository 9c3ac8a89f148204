// How the parts of a case share what a node has.
#pragma once

#include <vector>

#include "model/model.hpp"
#include "parallel/group_sums.hpp"
#include "solid/solid.hpp"

namespace carom {

/// Items are the nodes, groups the positions of the parts in the case (Model::part_numbers), shares the lumped mass of
/// the part's cells at the node over that of all cells there: 1 where a node is of one part. The four nodes of a rigid
/// body (TurningBody) belong to its parts by the masses of their cells. Nodes without cells, such as those of obstacles
/// that move, are of no part.
std::vector<GroupShare> node_shares(const Solid& solid, const Model& model);

}  // namespace carom
