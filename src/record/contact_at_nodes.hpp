// What one contact exerts on each node.
#pragma once

#include <cstddef>
#include <vector>

#include "build/simulation.hpp"
#include "march/observer.hpp"

namespace carom {

/// Forces on nodes, which are in ascending order.
struct NodalForces {
  std::vector<Index> nodes;
  std::vector<Vec3> force;
};

/// The forces of the rows of a contact (its position in Model::contacts), and of what it tears, on all nodes that they
/// stand at, of both sides: G^T f. Those of a pair of surfaces add up to nothing, those on one side to its resultant.
NodalForces contact_at_nodes(const Simulation& simulation, const StepView& view, std::size_t contact);

}  // namespace carom
