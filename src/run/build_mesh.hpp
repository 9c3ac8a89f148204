// From the case to its mesh.
#pragma once

#include "casefile/case.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// Reads the mesh file (relative to the case's folder) or makes the structured blocks. Throws CaseError.
Mesh build_mesh(const Case& given);

/// True for an obstacle that moves or is free: it hangs on a node of its own.
bool is_moving(const CaseContact& contact);
/// Their number; build_mesh appends one node for each, after all others and in the order of the contacts.
std::size_t moving_obstacles(const Case& given);

}  // namespace carom
