// Writes a mesh as MED, the format of Salome and Code_Aster.
#pragma once

#include <string>

#include "mesh/mesh.hpp"

namespace carom {

/// One mesh of MED 4.0 (an HDF5 file laid out as the MED library does: nodes, cells, their numbers, a family for each
/// set of groups that occurs); solids in MED's orientation. The file appears under its name only when it is complete.
/// Throws CaseError for HEXA27 and names of groups of more than 80 bytes, and OutputError.
void write_med(const std::string& path, const Mesh& mesh);

}  // namespace carom
