#include "run/groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string_view>

#include "mesh/cell_topology.hpp"
#include "mesh/orientation.hpp"

namespace carom {

namespace {

/// Nodes of a facet in increasing order; the entries it does not need are -1.
std::array<Index, 4> sorted(std::span<const Index> nodes) {
  std::array<Index, 4> result{-1, -1, -1, -1};
  std::copy(nodes.begin(), nodes.end(), result.begin());
  std::sort(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(nodes.size()));
  return result;
}

/// How to get a mesh without cells of this type, where carom has no such element.
std::string other_mesh(CellType found) {
  switch (found) {
    case CellType::hexa8:
    case CellType::quad4:
    case CellType::line2:
    case CellType::point1:
      return {};
    case CellType::line3:
    case CellType::quad8:
    case CellType::quad9:
    case CellType::hexa20:
    case CellType::hexa27:
      return "Save the mesh with cells of first order (Gmsh: Mesh.ElementOrder = 1; Salome: convert to linear).";
    default:
      return "Mesh with hexahedra, in two dimensions with quadrilaterals (Gmsh: Transfinite and Recombine; Salome: "
             "Hexahedron (i, j, k)), of first order.";
  }
}

}  // namespace

void Groups::refuse(const Located<std::string>& name, const std::string& key, const std::string& found,
                    const std::string& expected, const std::string& remedy) const {
  const std::vector<std::string> names = mesh_.group_names();
  const std::string near = nearest(*name, names);
  std::string mend = near.empty() || near == *name ? "" : fmt::format("Did you mean \"{}\"? ", near);
  constexpr std::size_t most = 12;
  const std::vector<std::string> shown(names.begin(), names.begin() + std::min(most, names.size()));
  mend += names.empty()
              ? "The mesh has no groups."
              : fmt::format("The mesh has: {}{}.", fmt::join(shown, ", "), names.size() > most ? ", ..." : "");
  throw CaseError(name.where, key, found, expected, remedy.empty() ? mend : remedy);
}

void Groups::require(const Located<std::string>& name, const std::string& key) const {
  if (mesh_.has_group(*name)) return;
  refuse(name, key, fmt::format("\"{}\", which the mesh does not have", *name), "the name of a group of the mesh");
}

std::vector<Index> Groups::nodes(const Located<std::string>& name, const std::string& key) const {
  if (!means_all(*name)) {
    require(name, key);
    return mesh_.nodes_of(*name);
  }
  std::vector<char> is_member(mesh_.node_count(), 0);
  for (const CellBlock& block : mesh_.blocks)
    for (const Index n : block.connectivity) is_member[static_cast<std::size_t>(n)] = 1;
  for (const auto& [group, members] : mesh_.node_groups)
    for (const Index n : members) is_member[static_cast<std::size_t>(n)] = 1;
  std::vector<Index> all;
  for (std::size_t n = 0; n < is_member.size(); ++n)
    if (is_member[n] != 0) all.push_back(static_cast<Index>(n));
  return all;
}

std::vector<Index> Groups::all_cells(const Located<std::string>& name, const std::string& key, CellType type,
                                     const std::string& expected) const {
  std::vector<Index> cells;
  for (const CellBlock& block : mesh_.blocks) {
    if (dimension(block.type) != dimension(type)) continue;
    const auto n = static_cast<std::size_t>(node_count(block.type));
    for (std::size_t cell = 0; cell < block.size(); ++cell) {
      const std::span<const Index> nodes(&block.connectivity[n * cell], n);
      if (on_boundary(nodes, block.type, skin().node_dimensions)) continue;
      if (block.type != type) {
        throw CaseError(name.where, key,
                        fmt::format("\"all\", where the mesh has {} cells such as {}", carom::name(block.type),
                                    block.file_numbers[cell]),
                        expected, "Mesh them anew, or name the group that is meant.");
      }
      if (!has_zero_thickness(mesh_, type, nodes)) cells.push_back(static_cast<Index>(cell));
    }
  }
  if (cells.empty()) throw CaseError(name.where, key, "\"all\" in a mesh without such cells", expected);
  return cells;
}

std::vector<Index> Groups::cells(const Located<std::string>& name, const std::string& key, CellType type,
                                 const std::string& expected) const {
  if (means_all(*name)) return all_cells(name, key, type, expected);
  require(name, key);
  std::vector<Index> cells;
  std::set<std::string_view> others;
  if (const auto group = mesh_.cell_groups.find(*name); group != mesh_.cell_groups.end()) {
    for (const CellRef& ref : group->second) {
      const CellType found = mesh_.blocks[static_cast<std::size_t>(ref.block)].type;
      if (found == type) {
        cells.push_back(ref.cell);
      } else if (dimension(found) >= dimension(type)) {
        refuse(name, key, fmt::format("{} cells in \"{}\"", carom::name(found), *name), expected, other_mesh(found));
      } else {
        others.insert(carom::name(found));
      }
    }
  }
  if (cells.empty()) {
    const std::string what = others.empty() ? "nodes" : fmt::format("{} cells", fmt::join(others, " and "));
    refuse(name, key, fmt::format("\"{}\", a group of {}", *name, what), expected);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

const Groups::Skin& Groups::skin() const {
  if (!skin_) skin_ = Skin{carom::outer_facets(mesh_), node_dimensions(mesh_)};
  return *skin_;
}

std::vector<OuterFacet> Groups::outer_facets(const Located<std::string>& name, const std::string& key) const {
  std::vector<char> is_member(mesh_.node_count(), 0);
  for (const Index n : nodes(name, key)) is_member[static_cast<std::size_t>(n)] = 1;
  std::array<std::vector<std::array<Index, 4>>, 5> chosen;  // by number of nodes; nodes sorted, the rest -1
  if (const auto group = mesh_.cell_groups.find(*name); group != mesh_.cell_groups.end()) {
    for (const CellRef& ref : group->second) {
      const CellBlock& block = mesh_.blocks[static_cast<std::size_t>(ref.block)];
      if (block.type != CellType::quad4 && block.type != CellType::line2) continue;
      const auto n = static_cast<std::size_t>(node_count(block.type));
      const std::span<const Index> nodes(&block.connectivity[n * static_cast<std::size_t>(ref.cell)], n);
      if (on_boundary(nodes, block.type, skin().node_dimensions)) chosen[n].push_back(sorted(nodes));
    }
  }
  for (auto& facets : chosen) std::sort(facets.begin(), facets.end());
  std::vector<OuterFacet> result;
  for (const OuterFacet& outer : skin().facets) {
    const std::span<const Index> nodes(outer.facet.begin(), outer.facet.end());
    const auto& of_its_kind = chosen[nodes.size()];
    const auto belongs = [&](Index n) { return is_member[static_cast<std::size_t>(n)] != 0; };
    if (!std::all_of(nodes.begin(), nodes.end(), belongs)) continue;
    if (of_its_kind.empty() || std::binary_search(of_its_kind.begin(), of_its_kind.end(), sorted(nodes)))
      result.push_back(outer);
  }
  if (result.empty()) {
    refuse(name, key, fmt::format("\"{}\", which holds no outer face of the solids", *name),
           "a group of faces on the surface, or of all nodes of such faces");
  }
  return result;
}

std::vector<OuterFacet> Groups::exterior(const std::vector<Located<std::string>>& excluded,
                                         const std::string& key) const {
  std::set<std::array<Index, 4>> out;
  for (const auto& name : excluded)
    for (const OuterFacet& outer : outer_facets(name, key)) out.insert(outer.facet.node);
  std::vector<OuterFacet> facets = skin().facets;
  std::erase_if(facets, [&](const OuterFacet& outer) { return out.contains(outer.facet.node); });
  return facets;
}

std::vector<Facet> Groups::rigid_faces(const Located<std::string>& name, const std::string& key) const {
  require(name, key);
  std::vector<Facet> faces;
  const auto group = mesh_.cell_groups.find(*name);
  if (group != mesh_.cell_groups.end()) {
    for (const CellRef& ref : group->second) {
      const CellBlock& block = mesh_.blocks[static_cast<std::size_t>(ref.block)];
      if (block.type != CellType::quad4 && block.type != CellType::tria3 && block.type != CellType::line2) continue;
      Facet& face = faces.emplace_back();
      face.size = node_count(block.type);
      std::copy_n(block.connectivity.begin() + static_cast<std::ptrdiff_t>(face.size) * ref.cell, face.size,
                  face.node.begin());
    }
  }
  if (faces.empty()) {
    refuse(name, key, fmt::format("\"{}\", a group without TRIA3, QUAD4 or LINE2 cells", *name),
           "a group of faces (edges in two dimensions)");
  }
  return faces;
}

}  // namespace carom
