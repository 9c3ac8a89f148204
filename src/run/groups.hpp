// Groups of the mesh as the case names them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "casefile/case.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// Looks groups up; a name that the mesh does not have is a CaseError at the place where the user wrote it, with a near
/// spelling and the groups there are.
class Groups {
 public:
  explicit Groups(const Mesh& mesh) : mesh_(mesh) {}

  /// Nodes of the group; "all" means every node.
  std::vector<Index> nodes(const Located<std::string>& name, const std::string& key) const;
  /// HEXA8 cells of the group; solid cells of another type are an error.
  std::vector<Index> hexas(const Located<std::string>& name, const std::string& key) const;
  /// Outer faces of the HEXA8 cells, normals outward, that lie in the group (QUAD4 cells of it, or faces whose four
  /// nodes are in it when it has none).
  std::vector<std::array<Index, 4>> outer_faces(const Located<std::string>& name, const std::string& key) const;

 private:
  void require(const Located<std::string>& name, const std::string& key) const;
  [[noreturn]] void refuse(const Located<std::string>& name, const std::string& key, const std::string& found,
                           const std::string& expected) const;

  const Mesh& mesh_;
};

}  // namespace carom
