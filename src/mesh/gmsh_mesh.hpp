// Collects nodes, cells and physical groups of a Gmsh file into a Mesh.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesh/gmsh_cells.hpp"
#include "mesh/gmsh_cursor.hpp"
#include "mesh/mesh.hpp"
#include "mesh/node_numbers.hpp"

namespace carom {

/// Physical groups follow Code_Aster's convention: "A+B" means the groups A and B; a tag without a name gives a group
/// named by the tag; dimension 0 gives node groups, 1 to 3 cell groups. Tag 0 means no group. Every error is thrown as
/// CaseError at the place of the cursor.
class GmshMesh {
 public:
  static constexpr int any_dimension = -1;
  /// $PhysicalNames: the name of a tag of a dimension (0 to 3, or any_dimension).
  void name_physical(int dimension, std::int64_t tag, const std::string& names);
  /// $Nodes begins: count as declared (already compared with the size of the file).
  void begin_nodes(const GmshCursor& at, std::int64_t count);
  void add_node(const GmshCursor& at, std::int64_t number, const Vec3& x);
  /// The type with this number, or CaseError, which says how many cells have it.
  static const GmshCellType& cell_type(const GmshCursor& at, std::int64_t type_number, std::int64_t cells);
  /// nodes: file numbers in the file's order. physical: tags of the type's dimension; a sign is orientation only.
  void add_cell(const GmshCursor& at, const GmshCellType& type, std::int64_t number,
                std::span<const std::int64_t> nodes, std::span<const std::int64_t> physical);
  bool has_nodes() const { return has_nodes_; }
  /// Merges cells over the same nodes: Gmsh 2.2 writes a cell once for each of its physical groups.
  void merge_repeated_cells();
  /// The mesh in file order; notes names without entities.
  Mesh take();

 private:
  struct Group {
    std::vector<std::string> names;
    bool used = false;
  };
  std::size_t block_of(CellType type);
  Group& group(int dimension, std::int64_t tag);

  Mesh mesh_;
  NodeNumbers numbers_;
  bool has_nodes_ = false;
  std::map<std::pair<int, std::int64_t>, Group> groups_;
};

}  // namespace carom
