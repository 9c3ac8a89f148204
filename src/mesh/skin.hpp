// The outer surface of the HEXA8 cells.
#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.hpp"

namespace carom {

/// Faces (4 local node indices, normal outward) that belong to exactly one HEXA8, in the order of their cells.
/// Interfaces of zero thickness are left out, so that the faces beside them are outer faces.
std::vector<std::array<Index, 4>> skin(const Mesh& mesh);

}  // namespace carom
