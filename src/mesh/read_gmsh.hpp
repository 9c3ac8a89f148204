// Reader for Gmsh 2.2 and 4.1, text and binary.
#pragma once

#include <string>
#include <string_view>

#include "mesh/mesh.hpp"

namespace carom {

/// Reads the bytes of a Gmsh file (Gmsh reference manual, "MSH file format", versions 2.2 and 4.1; both byte orders).
/// Groups as in GmshMesh. Quadratic cells are brought to VTK's node order. source names the file in messages.
/// Throws CaseError with the line (text) or byte offset (binary) for anything that is not such a file.
Mesh read_gmsh(std::string_view bytes, const std::string& source);

}  // namespace carom
