// A mesh in a page of text.
#pragma once

#include <string>

#include "mesh/mesh.hpp"

namespace carom {

/// What a user wants to know of a mesh before using it: format, nodes, bounding box, cells by type, worst Jacobian and
/// turned cells, groups with their sizes, notes of the reader. Lines end with '\n'.
std::string mesh_summary(const Mesh& mesh);

}  // namespace carom
