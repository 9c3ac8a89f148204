// Rigid bodies of a case: the nodes that obstacles hang on.
#pragma once

#include <array>
#include <vector>

#include "casefile/case.hpp"
#include "mesh/mesh.hpp"
#include "model/model.hpp"

namespace carom {

/// Nodes that hold an obstacle: none at rest, one where it moves without turning, four where it turns. build_mesh
/// appends them after all others, in the order of the contacts.
std::size_t carrier_nodes(const CaseContact& contact);
std::size_t carrier_nodes(const Case& given);

/// Reference positions of the nodes of one obstacle; those of one that is led to turn stand at the distance `size` from
/// its centre. Throws CaseError for an inertia that no body has.
std::vector<Vec3> carrier_positions(const CaseContact& contact, double size);

/// Appends to the model what holds the obstacle, whose first node is given: initial velocities, and a RigidBody or a
/// TurningBody where it is free or turns, with its guide. What leads it is left to the caller. Throws CaseError for a
/// velocity against the guide.
void add_body(const CaseContact& contact, Index first, ObstacleContact& obstacle, Model& model);

}  // namespace carom
