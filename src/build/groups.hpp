// Groups of the mesh as the case names them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
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

  /// The mesh has the group, or the name is "all".
  void look_up(const Located<std::string>& name, const std::string& key) const {
    if (!means_all(*name)) require(name, key);
  }
  /// Nodes of the group; "all", where no group has that name, means every node of cells and groups (and so none that
  /// obstacles or springs hang on).
  std::vector<Index> nodes(const Located<std::string>& name, const std::string& key) const;
  using CellsByType = std::map<CellType, std::vector<Index>>;
  /// The cells of the group of each of `types`, or of `only`, in increasing order; cells of lower dimension are left
  /// out. Others and none are errors that count them; `expected` is what the message says. "all", where no group has
  /// that name, means every cell of the dimension that is no boundary of other cells and not of zero thickness.
  CellsByType cells(const Located<std::string>& name, const std::string& key, std::span<const CellType> types,
                    const std::string& expected, std::optional<CellType> only = {}) const;
  /// The part of the skin (outer_facets of mesh/skin.hpp) that lies in the group: facets of faces
  /// that are boundary cells of it (faces, lines), or whose nodes are all in it where it has no boundary cells of their
  /// dimension.
  std::vector<OuterFacet> outer_facets(const Located<std::string>& name, const std::string& key) const;
  /// Those of a group that is nothing but faces: none of its cells is a body, and each of its nodes is on one of them.
  /// Empty for other groups.
  std::vector<OuterFacet> faces_alone(const Located<std::string>& name, const std::string& key) const;
  /// The whole skin.
  std::shared_ptr<const std::vector<OuterFacet>> outer_facets() const { return skin().facets; }
  /// All of the skin but what lies in the excluded groups.
  std::vector<OuterFacet> exterior(const std::vector<Located<std::string>>& excluded, const std::string& key) const;
  /// Faces of the group (lines in two dimensions) as they are numbered, quadratic ones in linear pieces: the faces of a
  /// rigid surface.
  std::vector<Facet> rigid_faces(const Located<std::string>& name, const std::string& key) const;

 private:
  CellsByType all_cells(int dimension) const;
  std::vector<OuterFacet> find_facets(const Located<std::string>& name, const std::string& key) const;
  CellsByType group_cells(const Located<std::string>& name, const std::string& key, int dimension,
                          const std::string& expected) const;
  std::string counted(const CellsByType& cells) const;
  bool means_all(const std::string& name) const { return name == "all" && !mesh_.has_group(name); }
  void require(const Located<std::string>& name, const std::string& key) const;
  [[noreturn]] void refuse(const Located<std::string>& name, const std::string& key, const std::string& found,
                           const std::string& expected, const std::string& remedy = "") const;

  struct Skin {
    std::shared_ptr<const std::vector<OuterFacet>> facets;
    std::vector<std::uint8_t> node_dimensions;
  };
  const Skin& skin() const;

  const Mesh& mesh_;
  mutable std::optional<Skin> skin_;  ///< made when it is first asked for
};

}  // namespace carom
