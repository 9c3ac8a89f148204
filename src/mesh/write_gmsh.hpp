// Writes a mesh as Gmsh 2.2.
#pragma once

#include <string>

#include "mesh/mesh.hpp"

namespace carom {

/// The mesh as Gmsh 2.2 text with its groups as physical names, in its own order; read_gmsh gives it back. A cell
/// stands there once for each of its groups. Throws CaseError where a group has a name that the format cannot hold.
std::string gmsh_text(const Mesh& mesh);

}  // namespace carom
