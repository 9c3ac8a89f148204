#include "run/groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "mesh/skin.hpp"

namespace carom {

void Groups::refuse(const Located<std::string>& name, const std::string& key, const std::string& found,
                    const std::string& expected) const {
  const std::vector<std::string> names = mesh_.group_names();
  const std::string near = nearest(*name, names);
  std::string mend = near.empty() || near == *name ? "" : fmt::format("Did you mean \"{}\"? ", near);
  constexpr std::size_t most = 12;
  const std::vector<std::string> shown(names.begin(), names.begin() + std::min(most, names.size()));
  mend += names.empty()
              ? "The mesh has no groups."
              : fmt::format("The mesh has: {}{}.", fmt::join(shown, ", "), names.size() > most ? ", ..." : "");
  throw CaseError(name.where, key, found, expected, mend);
}

void Groups::require(const Located<std::string>& name, const std::string& key) const {
  if (mesh_.has_group(*name)) return;
  refuse(name, key, fmt::format("\"{}\", which the mesh does not have", *name), "the name of a group of the mesh");
}

std::vector<Index> Groups::nodes(const Located<std::string>& name, const std::string& key) const {
  if (*name == "all" && !mesh_.has_group("all")) {
    std::vector<Index> all(mesh_.node_count());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  require(name, key);
  return mesh_.nodes_of(*name);
}

std::vector<Index> Groups::hexas(const Located<std::string>& name, const std::string& key) const {
  require(name, key);
  std::vector<Index> cells;
  const auto group = mesh_.cell_groups.find(*name);
  if (group != mesh_.cell_groups.end()) {
    for (const CellRef& ref : group->second) {
      const CellType type = mesh_.blocks[static_cast<std::size_t>(ref.block)].type;
      if (type == CellType::hexa8) {
        cells.push_back(ref.cell);
      } else if (dimension(type) == 3) {
        refuse(name, key, fmt::format("{} cells in \"{}\"", carom::name(type), *name), "HEXA8 cells only");
      }
    }
  }
  if (cells.empty()) {
    refuse(name, key, fmt::format("\"{}\", a group without solid cells", *name), "a group of HEXA8 cells");
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

std::vector<std::array<Index, 4>> Groups::outer_faces(const Located<std::string>& name, const std::string& key) const {
  const std::vector<Index> members = nodes(name, key);
  std::set<std::array<Index, 4>> quads;
  if (const auto group = mesh_.cell_groups.find(*name); group != mesh_.cell_groups.end()) {
    for (const CellRef& ref : group->second) {
      const CellBlock& block = mesh_.blocks[static_cast<std::size_t>(ref.block)];
      if (block.type != CellType::quad4) continue;
      std::array<Index, 4> quad{};
      std::copy_n(block.connectivity.begin() + 4 * static_cast<std::ptrdiff_t>(ref.cell), 4, quad.begin());
      std::sort(quad.begin(), quad.end());
      quads.insert(quad);
    }
  }
  std::vector<std::array<Index, 4>> faces;
  for (const auto& face : skin(mesh_)) {
    std::array<Index, 4> sorted = face;
    std::sort(sorted.begin(), sorted.end());
    const auto is_member = [&](Index n) { return std::binary_search(members.begin(), members.end(), n); };
    const bool chosen = quads.empty() ? std::all_of(face.begin(), face.end(), is_member) : quads.contains(sorted);
    if (chosen) faces.push_back(face);
  }
  if (faces.empty()) {
    refuse(name, key, fmt::format("\"{}\", which holds no outer face of the solids", *name),
           "a group of faces on the surface, or of all nodes of such faces");
  }
  return faces;
}

}  // namespace carom
