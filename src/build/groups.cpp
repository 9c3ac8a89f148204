#include "build/groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <span>
#include <string_view>

#include "mesh/cell_topology.hpp"
#include "mesh/orientation.hpp"

namespace carom {

namespace {

/// Corners of a face in increasing order; the entries it does not need are larger than any.
std::array<Index, 4> sorted_corners(CellType face, std::span<const Index> nodes) {
  std::array<Index, 4> result;
  result.fill(std::numeric_limits<Index>::max());
  std::copy_n(nodes.begin(), corner_count(face), result.begin());
  std::sort(result.begin(), result.end());
  return result;
}

std::span<const Index> nodes_of_cell(const Mesh& mesh, const CellRef& cell) {
  const CellBlock& block = mesh.blocks[static_cast<std::size_t>(cell.block)];
  const auto n = static_cast<std::size_t>(node_count(block.type));
  return std::span(block.connectivity).subspan(n * static_cast<std::size_t>(cell.cell), n);
}

/// The face that a facet is, or is a piece of, with its nodes.
struct WholeFace {
  CellType type{};
  std::vector<Index> nodes;

  WholeFace(const Mesh& mesh, const OuterFacet& outer) {
    const CellFace& face =
        cell_faces(mesh.blocks[static_cast<std::size_t>(outer.cell.block)].type)[static_cast<std::size_t>(outer.face)];
    const std::span<const Index> of_cell = nodes_of_cell(mesh, outer.cell);
    type = face.type;
    for (const LocalNode a : face.nodes()) nodes.push_back(of_cell[a]);
  }
};

/// How to get a mesh without cells of this type, where their corners would do.
std::string other_mesh(CellType found, std::span<const CellType> types) {
  if (std::find(types.begin(), types.end(), linear_type(found)) == types.end()) return {};
  return "Say mesh.order = \"linear\" to take them by their corners, or save the mesh with cells of first order (Gmsh: "
         "Mesh.ElementOrder = 1; Salome: convert to linear).";
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

Groups::CellsByType Groups::all_cells(int dimension) const {
  CellsByType found;
  for (const CellBlock& block : mesh_.blocks) {
    if (carom::dimension(block.type) != dimension) continue;
    const auto n = static_cast<std::size_t>(node_count(block.type));
    for (std::size_t cell = 0; cell < block.size(); ++cell) {
      const std::span<const Index> nodes(&block.connectivity[n * cell], n);
      if (on_boundary(nodes, block.type, skin().node_dimensions) || has_zero_thickness(mesh_, block.type, nodes))
        continue;
      found[block.type].push_back(static_cast<Index>(cell));
    }
  }
  return found;
}

/// Of this dimension and higher ones; an error where there are only lower ones.
Groups::CellsByType Groups::group_cells(const Located<std::string>& name, const std::string& key, int dimension,
                                        const std::string& expected) const {
  require(name, key);
  CellsByType found;
  std::set<std::string_view> others;
  if (const auto group = mesh_.cell_groups.find(*name); group != mesh_.cell_groups.end()) {
    for (const CellRef& ref : group->second) {
      const CellType type = mesh_.blocks[static_cast<std::size_t>(ref.block)].type;
      if (carom::dimension(type) >= dimension)
        found[type].push_back(ref.cell);
      else
        others.insert(carom::name(type));
    }
  }
  if (found.empty()) {
    const std::string what = others.empty() ? "nodes" : fmt::format("{} cells", fmt::join(others, " and "));
    refuse(name, key, fmt::format("\"{}\", a group of {}", *name, what), expected);
  }
  return found;
}

/// "48 TETRA4 cells (2 and others), 1 PYRA5 cell (7)": with their numbers in the file.
std::string Groups::counted(const CellsByType& cells) const {
  std::string text;
  for (const auto& [type, list] : cells)
    text += fmt::format("{}{} {} cell{} ({}{})", text.empty() ? "" : ", ", list.size(), carom::name(type),
                        list.size() == 1 ? "" : "s",
                        mesh_.cell_label(mesh_.block(type)->file_numbers[static_cast<std::size_t>(list.front())]),
                        list.size() == 1 ? "" : " and others");
  return text;
}

Groups::CellsByType Groups::cells(const Located<std::string>& name, const std::string& key,
                                  std::span<const CellType> types, const std::string& expected,
                                  std::optional<CellType> only) const {
  const bool is_all = means_all(*name);
  const int dimension = carom::dimension(types.front());
  CellsByType found = is_all ? all_cells(dimension) : group_cells(name, key, dimension, expected);
  const auto where = [&](const CellsByType& some) {
    return is_all ? "\"all\", where the mesh has " + counted(some) : fmt::format("{} in \"{}\"", counted(some), *name);
  };
  if (only) std::erase_if(found, [&](const auto& entry) { return entry.first != *only; });
  CellsByType others = found;
  std::erase_if(others,
                [&](const auto& entry) { return std::find(types.begin(), types.end(), entry.first) != types.end(); });
  if (!others.empty()) {
    const std::string remedy = other_mesh(others.begin()->first, types);
    refuse(name, key, where(others), expected,
           remedy.empty() && is_all ? "Mesh them anew, or name the group that is meant." : remedy);
  }
  if (found.empty() && only)
    refuse(name, key, fmt::format("\"{}\" without {} cells", *name, carom::name(*only)), expected,
           "Leave `type` out, or name a type that the group has (`carom mesh` lists them).");
  if (found.empty()) throw CaseError(name.where, key, "\"all\" in a mesh without such cells", expected);
  return found;
}

const Groups::Skin& Groups::skin() const {
  if (!skin_)
    skin_ = Skin{std::make_shared<const std::vector<OuterFacet>>(carom::outer_facets(mesh_)), node_dimensions(mesh_)};
  return *skin_;
}

std::vector<OuterFacet> Groups::find_facets(const Located<std::string>& name, const std::string& key) const {
  std::vector<char> is_member(mesh_.node_count(), 0);
  for (const Index n : nodes(name, key)) is_member[static_cast<std::size_t>(n)] = 1;
  std::array<std::vector<std::array<Index, 4>>, 3> chosen;  // by dimension
  if (const auto group = mesh_.cell_groups.find(*name); group != mesh_.cell_groups.end()) {
    for (const CellRef& ref : group->second) {
      const CellType type = mesh_.blocks[static_cast<std::size_t>(ref.block)].type;
      if (dimension(type) != 1 && dimension(type) != 2) continue;
      const std::span<const Index> nodes = nodes_of_cell(mesh_, ref);
      if (on_boundary(nodes, type, skin().node_dimensions))
        chosen[static_cast<std::size_t>(dimension(type))].push_back(sorted_corners(type, nodes));
    }
  }
  for (auto& faces : chosen) std::sort(faces.begin(), faces.end());
  std::vector<OuterFacet> result;
  for (const OuterFacet& outer : *skin().facets) {
    const WholeFace face(mesh_, outer);
    const auto& of_its_kind = chosen[static_cast<std::size_t>(dimension(face.type))];
    const auto belongs = [&](Index n) { return is_member[static_cast<std::size_t>(n)] != 0; };
    const bool are_corners_in = std::all_of(face.nodes.begin(), face.nodes.begin() + corner_count(face.type), belongs);
    const bool is_in = of_its_kind.empty()
                           ? std::all_of(face.nodes.begin(), face.nodes.end(), belongs)
                           : are_corners_in && std::binary_search(of_its_kind.begin(), of_its_kind.end(),
                                                                  sorted_corners(face.type, face.nodes));
    if (is_in) result.push_back(outer);
  }
  return result;
}

std::vector<OuterFacet> Groups::outer_facets(const Located<std::string>& name, const std::string& key) const {
  std::vector<OuterFacet> result = find_facets(name, key);
  if (result.empty()) {
    refuse(name, key, fmt::format("\"{}\", which holds no outer face of the solids", *name),
           "a group of faces on the surface, or of all nodes of such faces");
  }
  return result;
}

std::vector<OuterFacet> Groups::faces_alone(const Located<std::string>& name, const std::string& key) const {
  if (means_all(*name)) return {};
  if (const auto group = mesh_.cell_groups.find(*name); group != mesh_.cell_groups.end())
    for (const CellRef& ref : group->second) {
      const CellType type = mesh_.blocks[static_cast<std::size_t>(ref.block)].type;
      if (dimension(type) == 3 || !on_boundary(nodes_of_cell(mesh_, ref), type, skin().node_dimensions)) return {};
    }
  std::vector<OuterFacet> facets = find_facets(name, key);
  std::vector<char> is_on_face(mesh_.node_count(), 0);
  for (const OuterFacet& outer : facets)
    for (const Index n : WholeFace(mesh_, outer).nodes) is_on_face[static_cast<std::size_t>(n)] = 1;
  const std::vector<Index> all = nodes(name, key);
  const bool is_alone = std::ranges::all_of(all, [&](Index n) { return is_on_face[static_cast<std::size_t>(n)] != 0; });
  return is_alone ? facets : std::vector<OuterFacet>{};
}

std::vector<OuterFacet> Groups::exterior(const std::vector<Located<std::string>>& excluded,
                                         const std::string& key) const {
  std::set<std::array<Index, 4>> out;
  for (const auto& name : excluded)
    for (const OuterFacet& outer : outer_facets(name, key)) out.insert(outer.facet.node);
  std::vector<OuterFacet> facets = *skin().facets;
  std::erase_if(facets, [&](const OuterFacet& outer) { return out.contains(outer.facet.node); });
  return facets;
}

std::vector<Facet> Groups::rigid_faces(const Located<std::string>& name, const std::string& key) const {
  require(name, key);
  std::vector<Facet> faces;
  const auto group = mesh_.cell_groups.find(*name);
  if (group != mesh_.cell_groups.end()) {
    for (const CellRef& ref : group->second) {
      const CellType type = mesh_.blocks[static_cast<std::size_t>(ref.block)].type;
      if (dimension(type) != 1 && dimension(type) != 2) continue;
      const std::span<const Index> nodes = nodes_of_cell(mesh_, ref);
      for (const FacePiece& piece : face_pieces(type)) {
        Facet& face = faces.emplace_back();
        face.size = piece.size;
        for (std::size_t a = 0; a < static_cast<std::size_t>(piece.size); ++a) face.node[a] = nodes[piece.node[a]];
      }
    }
  }
  if (faces.empty()) {
    refuse(name, key, fmt::format("\"{}\", a group without faces and lines", *name),
           "a group of faces (edges in two dimensions)");
  }
  return faces;
}

}  // namespace carom
