// All groups that a case names, looked up before anything is made of them.
#pragma once

#include "casefile/case.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// Adds an error for each name of a group that the mesh does not have. Takes also a case of which some could not be
/// read: names that are empty are passed over.
void check_group_names(const Case& given, const Mesh& mesh, CaseErrors& errors);

}  // namespace carom
