// Rows of rigid obstacles.
#pragma once

#include <memory>

#include "contact/row_maker.hpp"

namespace carom {

/// One row per node that may touch, in the order of the nodes, with the measure of its share in the contact surface in
/// the reference configuration (nodal_measures) or 1. A moving obstacle follows the displacement of its carrier, on
/// which the row has the block -(n, t_1, t_2). One that turns is placed by the four nodes of its body, on which the row
/// has the blocks -N_a (n, t_1, t_2) with the weights of the body's point where the node is (turning_body.hpp), so that
/// forces and moments balance exactly; n is then the gradient of the gap. Planes that do not turn have fixed rows.
/// Spheres, cylinders and boxes have rows for all nodes. A rigid surface (its nodes do not move, except all together
/// with the carrier or body) has rows for the nodes within the larger mean facet size of both surfaces, found by a
/// SurfaceSearch; the nodes' normals come from the contact surface. Where springs hold it on the contact surface's
/// area, it has rigid_pair_rows (pair_rows.hpp) instead, whose rigid nodes are points of the carrier or
/// body: so its own corners and edges, and faces between the nodes of the body, are met.
std::unique_ptr<RowMaker> obstacle_rows(const Model& model, const ObstacleContact& contact, Index source);

}  // namespace carom
