// Rows of rigid obstacles and of discrete stops.
#pragma once

#include <memory>

#include "contact/row_maker.hpp"

namespace carom {

/// One row per node that may touch, in the order of the nodes, with the measure of its share in the contact surface in
/// the reference configuration (nodal_measures) or 1. A moving obstacle follows the displacement of its carrier, on
/// which the row has the block -(n, t_1, t_2). Planes have fixed rows. Spheres, cylinders and boxes have rows for all
/// nodes. A rigid surface (its nodes do not move, except all together with the carrier) has rows for the nodes within
/// the larger mean facet size of both surfaces, found by a SurfaceSearch; the nodes' normals come from the contact
/// surface.
std::unique_ptr<RowMaker> obstacle_rows(const Model& model, const ObstacleContact& contact, Index source);

/// One row per node of a discrete stop, with measure 1, the same at every displacement.
std::unique_ptr<RowMaker> stop_rows(const Model& model, const StopContact& contact, Index source);

}  // namespace carom
