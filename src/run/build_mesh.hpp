// From the case to its mesh.
#pragma once

#include "casefile/case.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// Reads the mesh file (relative to the case's folder) or makes the structured blocks, and appends the nodes that hold
/// moving obstacles (rigid_bodies.hpp). Throws CaseError.
Mesh build_mesh(const Case& given);

}  // namespace carom
