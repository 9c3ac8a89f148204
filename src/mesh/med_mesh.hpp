// From the tree of a MED file to a mesh.
#pragma once

#include <string>
#include <string_view>

#include "mesh/hdf5_tree.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// The one mesh of a MED 2.2 to 4 file: nodes, cells of the types of CellType, families of nodes and
/// cells (each names the groups it belongs to). MED orients its solids the other way round than Gmsh; they are brought
/// to our order (mirrored_order), so that a cell written as MED's manual asks comes out with a positive Jacobian.
/// With several computing steps the first is read; MED 2 has none. Throws CaseError with the path inside the file.
Mesh med_mesh(const Hdf5Tree& tree, const std::string& source);

/// MED's name of a type of cells, "HE8"; "" where it has none.
std::string_view med_code(CellType type);

/// Where MED has node i of a cell, both counted from 0.
std::size_t med_position(CellType type, std::size_t i);

}  // namespace carom
