// Groups of the mesh as the case names them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "casefile/case.hpp"
#include "mesh/mesh.hpp"
#include "mesh/skin.hpp"

namespace carom {

/// Looks groups up; a name that the mesh does not have is a CaseError at the place where the user wrote it, with a near
/// spelling and the groups there are.
class Groups {
 public:
  explicit Groups(const Mesh& mesh) : mesh_(mesh) {}

  /// Nodes of the group; "all", where no group has that name, means every node of cells and groups (and so none that
  /// obstacles or springs hang on).
  std::vector<Index> nodes(const Located<std::string>& name, const std::string& key) const;
  /// Cells of this type in the group, in increasing order; cells of lower dimension beside them are left out, others
  /// are an error. `expected` is what the message says. "all", where no group has that name, means every cell of the
  /// type that is no boundary of other cells and not of zero thickness; other cells of its dimension are an error.
  std::vector<Index> cells(const Located<std::string>& name, const std::string& key, CellType type,
                           const std::string& expected) const;
  /// The part of the skin (outer_facets of mesh/skin.hpp) that lies in the group: facets that are boundary cells of it
  /// (QUAD4, LINE2), or whose nodes are all in it where it has no boundary cells of their kind.
  std::vector<OuterFacet> outer_facets(const Located<std::string>& name, const std::string& key) const;
  /// All of the skin but what lies in the excluded groups.
  std::vector<OuterFacet> exterior(const std::vector<Located<std::string>>& excluded, const std::string& key) const;
  /// Face cells of the group (TRIA3, QUAD4; LINE2 in two dimensions) as they are numbered: the faces of a rigid
  /// surface.
  std::vector<Facet> rigid_faces(const Located<std::string>& name, const std::string& key) const;

 private:
  std::vector<Index> all_cells(const Located<std::string>& name, const std::string& key, CellType type,
                               const std::string& expected) const;
  bool means_all(const std::string& name) const { return name == "all" && !mesh_.has_group(name); }
  void require(const Located<std::string>& name, const std::string& key) const;
  [[noreturn]] void refuse(const Located<std::string>& name, const std::string& key, const std::string& found,
                           const std::string& expected, const std::string& remedy = "") const;

  struct Skin {
    std::vector<OuterFacet> facets;
    std::vector<std::uint8_t> node_dimensions;
  };
  const Skin& skin() const;

  const Mesh& mesh_;
  mutable std::optional<Skin> skin_;  ///< made when it is first asked for
};

}  // namespace carom
