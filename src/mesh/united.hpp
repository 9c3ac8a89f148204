// Two meshes as one.
#pragma once

#include <string>

#include "mesh/mesh.hpp"

namespace carom {

/// A name of a group that both have, or "".
std::string common_group(const Mesh& a, const Mesh& b);

/// The nodes, cells and groups of both, which share none: the numbers of the second count on from the largest of the
/// first, whose source is that of the whole.
Mesh united(Mesh first, const Mesh& second);

}  // namespace carom
