// The velocities that an [[initial]] section gives.
#pragma once

#include <span>
#include <vector>

#include "casefile/case.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// One for each of the nodes, or one that all have, empty when the section gives none: velocity + angular_velocity x (X
/// - centre) + velocity_field(X). Throws CaseError where a formula gives no number.
std::vector<Vec3> initial_velocities(const CaseInitial& given, const Mesh& mesh, std::span<const Index> nodes);

}  // namespace carom
