// From the case to its mesh.
#pragma once

#include <cstddef>

#include "casefile/case.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// Reads the mesh file (relative to the case's folder) or makes the structured blocks, and appends the nodes where
/// springs to the ground end (attached.hpp) and those that hold moving obstacles (rigid_bodies.hpp). Throws CaseError.
Mesh build_mesh(const Case& given);
/// The same without refinement and without those nodes.
Mesh written_mesh(const Case& given);

/// The nodes of that mesh that are the user's: those appended for obstacles and for springs to the ground left out.
std::size_t given_nodes(const Case& given, const Mesh& mesh);

}  // namespace carom
