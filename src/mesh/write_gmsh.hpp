// A mesh as the text of a Gmsh file.
#pragma once

#include <string>

#include "mesh/mesh.hpp"

namespace carom {

/// Format 2.2, as read_mesh takes it: nodes and cells with their numbers, coordinates to the last bit. Node groups
/// become groups of points, sets of groups that a cell is in physical names joined by +. The mesh need not be finished
/// (its groups neither sorted nor unique). Throws CaseError, at mesh.report.source, for a name of a group that Gmsh's
/// format cannot hold.
std::string gmsh_text(const Mesh& mesh);

}  // namespace carom
