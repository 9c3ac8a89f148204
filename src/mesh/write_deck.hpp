// Writes a mesh as a deck of Abaqus and CalculiX.
#pragma once

#include <string>

#include "mesh/mesh.hpp"

namespace carom {

/// Nodes, elements, sets of nodes and of elements; the readers of decks give it back, names of groups in upper case and
/// without cells of one point, which decks do not have. Plane cells are CPE elements in a mesh without solids, beside
/// solids shells, which carry no section and so are faces. Throws CaseError for types of cells that decks do not have
/// and names of groups that they cannot hold.
std::string deck_text(const Mesh& mesh);

}  // namespace carom
