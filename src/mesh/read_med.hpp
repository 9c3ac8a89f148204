// Reader for MED files (Salome, Code_Aster), which are HDF5 inside.
#pragma once

#include <string>
#include <string_view>

#include "mesh/mesh.hpp"

namespace carom {

/// Reads the bytes of a MED file (med_mesh.hpp). source names the file in messages. Throws CaseError with the path
/// inside the file.
Mesh read_med(std::string_view bytes, const std::string& source);

}  // namespace carom
