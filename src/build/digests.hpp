// What a state hangs on, as numbers: two meshes, or two sets of bodies, that differ have others.
#pragma once

#include <cstddef>
#include <cstdint>

#include "mesh/mesh.hpp"
#include "model/model.hpp"

namespace carom {

/// Coordinates, cells, groups and numbers of a mesh.
std::uint64_t mesh_digest(const Mesh& mesh);

/// Where the first nodes are, and which of them the cells of the parts have: what a state hangs on. The nodes of a mesh
/// as it is given come before those that hang on springs and obstacles.
std::uint64_t bodies_digest(const Model& model, std::size_t nodes);

}  // namespace carom
