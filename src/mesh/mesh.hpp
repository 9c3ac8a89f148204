// The mesh: coordinates, cells by type and named groups; immutable once read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// Cell types that the readers know. Local node order is Gmsh's for linear cells (VTK's and Abaqus' HEXA8 are the
/// same).
enum class CellType : std::uint8_t {
  point1,
  line2,
  line3,
  tria3,
  tria6,
  quad4,
  quad8,
  quad9,
  tetra4,
  tetra10,
  pyra5,
  pyra13,
  penta6,
  penta15,
  hexa8,
  hexa20,
  hexa27
};

struct CellTraits {
  std::string_view name;  ///< "HEXA8", "QUAD4", ... (upper case, the field's usual names)
  int nodes;
  int corners;
  int dimension;  ///< 0 points, 1 lines, 2 faces, 3 solids
};

inline constexpr std::array<CellTraits, 17> cell_traits{{{"POINT1", 1, 1, 0},
                                                         {"LINE2", 2, 2, 1},
                                                         {"LINE3", 3, 2, 1},
                                                         {"TRIA3", 3, 3, 2},
                                                         {"TRIA6", 6, 3, 2},
                                                         {"QUAD4", 4, 4, 2},
                                                         {"QUAD8", 8, 4, 2},
                                                         {"QUAD9", 9, 4, 2},
                                                         {"TETRA4", 4, 4, 3},
                                                         {"TETRA10", 10, 4, 3},
                                                         {"PYRA5", 5, 5, 3},
                                                         {"PYRA13", 13, 5, 3},
                                                         {"PENTA6", 6, 6, 3},
                                                         {"PENTA15", 15, 6, 3},
                                                         {"HEXA8", 8, 8, 3},
                                                         {"HEXA20", 20, 8, 3},
                                                         {"HEXA27", 27, 8, 3}}};

constexpr const CellTraits& traits(CellType type) {
  return cell_traits[static_cast<std::size_t>(type)];
}
/// Number of nodes of one cell, e.g. 8 for hexa8.
constexpr int node_count(CellType type) {
  return traits(type).nodes;
}
/// Nodes of a cell at most.
inline constexpr std::size_t most_nodes = 27;
/// Number of corners: the nodes of the linear cell, which come first. Mid-side nodes follow in the order of cell_edges,
/// then the centres of faces and of the cell.
constexpr int corner_count(CellType type) {
  return traits(type).corners;
}
constexpr int dimension(CellType type) {
  return traits(type).dimension;
}
constexpr std::string_view name(CellType type) {
  return traits(type).name;
}

/// All cells of one type. connectivity has node_count(type) local node indices per cell.
struct CellBlock {
  CellType type{};
  std::vector<Index> connectivity;
  std::vector<std::int64_t> file_numbers;  ///< the number of each cell in the file the user wrote

  std::size_t size() const { return file_numbers.size(); }
  /// The nodes of one cell.
  std::span<const Index> nodes(Index cell) const {
    const auto n = static_cast<std::size_t>(node_count(type));
    return {connectivity.data() + n * static_cast<std::size_t>(cell), n};
  }
};

/// One cell: block (index into Mesh::blocks) and position in that block.
struct CellRef {
  Index block = 0;
  Index cell = 0;
  friend bool operator==(const CellRef&, const CellRef&) = default;
  friend auto operator<=>(const CellRef&, const CellRef&) = default;
};

/// Numbers above `after` are those of an instance of a deck, whose own count from 1 and follow on it; without a name:
/// of none.
struct NumbersOfInstance {
  std::int64_t after = 0;
  std::string instance;
};

/// What the reader mended or noticed, for `carom mesh` and the log.
struct MeshReport {
  std::string source;             ///< path of the file or "structured block"
  std::string format;             ///< e.g. "Gmsh 2.2 ASCII", "MED 3.3", "block"
  std::size_t turned = 0;         ///< solid cells whose node order was turned because their Jacobian was negative
  std::int64_t first_turned = 0;  ///< file number of the first of them
  /// Smallest over cells of (min det J at the corners / max det J at the corners): solids, and QUAD4 of plane meshes.
  double worst_jacobian = 0.0;
  std::int64_t worst_cell = 0;  ///< file number of that cell
  std::vector<std::string> notes;
};

/// Coordinates (m or the case's unit), cells and groups. Nodes and cells are numbered for locality;
/// the file's numbers are kept in node_numbers and CellBlock::file_numbers. A group's entries are sorted and unique.
/// A name may denote a node group and a cell group at once. Cells of zero thickness (HEXA8 whose two opposite faces
/// coincide) are allowed and kept as they stand. QUAD4 and LINE2 are pieces of boundaries or solids (plane cells,
/// bars): the parts of a case decide.
struct Mesh {
  std::vector<Vec3> coordinates;
  std::vector<std::int64_t> node_numbers;
  std::vector<CellBlock> blocks;                                  ///< at most one per type
  std::vector<NumbersOfInstance> node_instances, cell_instances;  ///< increasing; empty where the file has no instances
  std::map<std::string, std::vector<Index>> node_groups;
  std::map<std::string, std::vector<CellRef>> cell_groups;  ///< points, lines, faces and solids alike
  MeshReport report;

  std::size_t node_count() const { return coordinates.size(); }
  /// The numbers as the user has written them: "405", or "405 of instance PLATE-1".
  std::string node_label(Index node) const;
  std::string cell_label(const CellRef& cell) const;
  std::string cell_label(std::int64_t file_number) const;
  /// The block of this type or nullptr.
  const CellBlock* block(CellType type) const;
  /// Nodes of a group: the node group of that name united with the nodes of the cell group of that name; sorted,
  /// unique. Empty when there is neither.
  std::vector<Index> nodes_of(const std::string& group) const;
  bool has_group(const std::string& group) const;
  /// All group names, for messages with a near spelling.
  std::vector<std::string> group_names() const;
};

}  // namespace carom
