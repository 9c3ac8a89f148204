// Writes a mesh in the format that the name of the file asks for.
#pragma once

#include <string>

#include "mesh/mesh.hpp"

namespace carom {

/// .msh: Gmsh 2.2; .med: MED 4.0; .inp: a deck of Abaqus and CalculiX; .vtu: VTK, groups as fields of 0 and 1. Throws
/// CaseError for other names and for what a format cannot hold, and OutputError.
void write_mesh(const std::string& path, const Mesh& mesh);

}  // namespace carom
