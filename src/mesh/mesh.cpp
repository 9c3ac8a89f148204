#include "mesh/mesh.hpp"

#include <algorithm>
#include <array>
#include <iterator>

namespace carom {

namespace {

struct CellTraits {
  std::string_view name;
  int nodes;
  int dimension;
};

constexpr std::array<CellTraits, 17> kTraits{{{"POINT1", 1, 0},
                                              {"LINE2", 2, 1},
                                              {"LINE3", 3, 1},
                                              {"TRIA3", 3, 2},
                                              {"TRIA6", 6, 2},
                                              {"QUAD4", 4, 2},
                                              {"QUAD8", 8, 2},
                                              {"QUAD9", 9, 2},
                                              {"TETRA4", 4, 3},
                                              {"TETRA10", 10, 3},
                                              {"PYRA5", 5, 3},
                                              {"PYRA13", 13, 3},
                                              {"PENTA6", 6, 3},
                                              {"PENTA15", 15, 3},
                                              {"HEXA8", 8, 3},
                                              {"HEXA20", 20, 3},
                                              {"HEXA27", 27, 3}}};

const CellTraits& traits(CellType type) {
  return kTraits.at(static_cast<std::size_t>(type));
}

}  // namespace

int node_count(CellType type) {
  return traits(type).nodes;
}
int dimension(CellType type) {
  return traits(type).dimension;
}
std::string_view name(CellType type) {
  return traits(type).name;
}

const CellBlock* Mesh::block(CellType type) const {
  const auto found = std::find_if(blocks.begin(), blocks.end(), [&](const CellBlock& b) { return b.type == type; });
  return found == blocks.end() ? nullptr : &*found;
}

std::vector<Index> Mesh::nodes_of(const std::string& group) const {
  std::vector<Index> nodes;
  if (const auto found = node_groups.find(group); found != node_groups.end()) nodes = found->second;
  if (const auto found = cell_groups.find(group); found != cell_groups.end()) {
    for (const CellRef& ref : found->second) {
      const CellBlock& cells = blocks[static_cast<std::size_t>(ref.block)];
      const auto n = carom::node_count(cells.type);
      const auto first = cells.connectivity.begin() + static_cast<std::ptrdiff_t>(ref.cell) * n;
      nodes.insert(nodes.end(), first, first + n);
    }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

bool Mesh::has_group(const std::string& group) const {
  return node_groups.count(group) != 0 || cell_groups.count(group) != 0;
}

std::vector<std::string> Mesh::group_names() const {
  std::vector<std::string> names;
  for (const auto& [group, nodes] : node_groups) names.push_back(group);
  for (const auto& [group, cells] : cell_groups) names.push_back(group);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace carom
