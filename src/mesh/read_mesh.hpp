// Reads a mesh file of any known format.
#pragma once

#include <string>
#include <string_view>

#include "mesh/mesh.hpp"

namespace carom {

/// Reads a mesh from a file: Gmsh 2.2 or 4.1 (text or binary), MED 2.2 to 4, or a deck of Abaqus or CalculiX, told
/// apart by their first bytes, whatever the file is called. Solid cells come out with positive Jacobians, numbered for
/// locality. Throws CaseError when the file cannot be opened, is of no known format, or is damaged.
Mesh read_mesh(const std::string& path);

/// The same from the bytes of a file; source names it in messages.
Mesh read_mesh(std::string_view bytes, const std::string& source);

}  // namespace carom
