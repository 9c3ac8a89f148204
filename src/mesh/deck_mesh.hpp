// A mesh from a deck of Abaqus or CalculiX, and how its names and numbers are called there.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "deck/statements.hpp"
#include "mesh/deck_elements.hpp"
#include "mesh/deck_sets.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// The names of a deck, in upper case and with the instance before them ("PART-1-1.TOP"), and the groups they are.
/// NSET, ELSET and SURFACE may have the same name: where a node set or a surface would then be mixed up with another
/// group, its group is called "NAME (nodes)" or "NAME (surface)".
struct DeckNames {
  /// The cells of one element type of an ELSET, the group of which is "ELSET TYPE" where it has several.
  struct Cells {
    std::string group;
    const DeckElementType* type = nullptr;
  };
  struct Spring {
    std::string from, to;  ///< groups of one node each; `to` is empty where it is the ground
  };
  enum class SurfaceKind : std::uint8_t { faces, nodes };
  struct Surface {
    std::string group;
    SurfaceKind kind{};
    std::string faces;  ///< the group that is a slave of contact: of a surface of nodes "NAME (faces)", "" without any
    bool is_side_chosen = false;  ///< rigid faces of no named side, which look to the bodies
    double roundness = 0.0;       ///< of an analytical surface: how far its faces are from its arcs
  };
  std::map<std::string, std::string> node_sets;  ///< also nodes that loads and supports name by their number, "5"
  std::map<std::string, std::vector<Cells>> element_sets;
  std::map<std::string, std::string> masses;           ///< ELSET of point masses: the group of their nodes
  std::map<std::string, std::string> inertias;         ///< of rotary inertias likewise
  std::map<std::string, std::vector<Spring>> springs;  ///< ELSET of springs
  std::map<std::string, Surface> surfaces;
  std::map<std::string, std::string> loaded_faces;  ///< "EALL P3", "17 P3": the group of these faces
};

struct DeckMesh {
  Mesh mesh;  ///< in the order of the file, not finished
  DeckNames names;
  bool is_whole = true;  ///< false: more is wrong than types of elements, and groups are missing
  std::vector<DeckNote> notes{};
  std::vector<DeckCells> read{};
};

/// Nodes, cells and groups of a deck: what is no mesh is left alone. Names in loads by number become groups, and so do
/// the faces that pressures name. The numbers of an instance count on from the largest before. Throws CaseError.
DeckMesh deck_mesh(const Statements& statements, const std::string& source);
/// The same, with what is wrong added to `errors`. Elements of types that Carom does not have are members of their
/// sets, which have no cells then.
DeckMesh deck_mesh(const Statements& statements, const std::string& source, CaseErrors& errors);

/// Surfaces that general contact with rigid bodies has: all outer faces of the bodies that deform, and the side of a
/// rigid body, by its ELSET, that they are on.
inline constexpr const char* all_exterior = "ALL EXTERIOR";
std::string rigid_side_of(const DeckScope& scope, const std::string& set);

/// The key in `scope` of a name or number as it is written there, or "" where `names` has none: with the instance
/// before it, or else as it stands.
template <class Map>
std::string key_of(const Map& names, const DeckScope& scope, std::string_view text) {
  const std::string name = deck_name(text);
  if (names.count(scope.prefix + name) != 0) return scope.prefix + name;
  return names.count(name) != 0 ? name : std::string();
}

/// From the bytes of a deck to the finished mesh.
Mesh read_deck_mesh(std::string bytes, const std::string& source, const IncludeReader& include);

}  // namespace carom
