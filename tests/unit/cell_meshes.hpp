// For tests: the structured blocks of mesh/structured_block.hpp meshed with other types of cells.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/finish_mesh.hpp"
#include "mesh/mesh.hpp"
#include "mesh/skin.hpp"

namespace carom::test {

/// Linear cells of `type` that fill a HEXA8 or a QUAD4, as places in its node list; 8 is a new node at its centre.
/// Equal for all cells of a regular grid, so that neighbours fit.
inline std::vector<std::vector<int>> filling(CellType type) {
  switch (type) {
    case CellType::tetra4:  // the six ways along edges from node 0 to node 6
      return {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    case CellType::penta6:
      return {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
    case CellType::pyra5:
      return {{0, 1, 2, 3, 8}, {7, 6, 5, 4, 8}, {0, 4, 5, 1, 8}, {1, 5, 6, 2, 8}, {2, 6, 7, 3, 8}, {3, 7, 4, 0, 8}};
    case CellType::hexa8:
      return {{0, 1, 2, 3, 4, 5, 6, 7}};
    case CellType::tria3:
      return {{0, 1, 2}, {0, 2, 3}};
    case CellType::quad4:
      return {{0, 1, 2, 3}};
    default:
      throw std::logic_error("no cells of this type fill a hexahedron or a quadrilateral");
  }
}

inline CellType linear_of(CellType type) {
  switch (type) {
    case CellType::tetra10:
      return CellType::tetra4;
    case CellType::penta15:
      return CellType::penta6;
    case CellType::pyra13:
      return CellType::pyra5;
    case CellType::hexa20:
    case CellType::hexa27:
      return CellType::hexa8;
    case CellType::tria6:
      return CellType::tria3;
    case CellType::quad8:
    case CellType::quad9:
      return CellType::quad4;
    default:
      return type;
  }
}

/// A mesh that is being filled with cells; nodes between others are made once.
struct CellFiller {
  Mesh mesh;
  std::map<std::vector<Index>, Index> between;

  Index middle(std::vector<Index> of) {
    std::sort(of.begin(), of.end());
    const auto [found, is_new] = between.try_emplace(of, static_cast<Index>(mesh.coordinates.size()));
    if (is_new) {
      Vec3 mean{};
      for (const Index n : of)
        mean = add(mean, scaled(mesh.coordinates[static_cast<std::size_t>(n)], 1.0 / static_cast<double>(of.size())));
      mesh.coordinates.push_back(mean);
      mesh.node_numbers.push_back(static_cast<std::int64_t>(mesh.coordinates.size()));
    }
    return found->second;
  }

  /// A cell of `type` over these corners.
  void add_cell(CellType type, const std::vector<Index>& corners) {
    auto block = std::find_if(mesh.blocks.begin(), mesh.blocks.end(), [&](const auto& b) { return b.type == type; });
    if (block == mesh.blocks.end()) block = mesh.blocks.insert(block, {type, {}, {}});
    std::vector<Index> nodes = corners;
    const auto size = static_cast<std::size_t>(node_count(type));
    const auto at = [&](std::span<const LocalNode> local) {
      std::vector<Index> some;
      for (const LocalNode a : local) some.push_back(corners[a]);
      return some;
    };
    if (size > corners.size())
      for (const auto& edge : cell_edges(type)) nodes.push_back(middle(at(edge)));
    if (type == CellType::quad9) nodes.push_back(middle(corners));
    if (type == CellType::hexa27) {
      nodes.resize(27);
      for (const CellFace& face : cell_faces(type)) nodes[face.node[8]] = middle(at(face.corners()));
      nodes[26] = middle(corners);
    }
    block->connectivity.insert(block->connectivity.end(), nodes.begin(), nodes.end());
    block->file_numbers.push_back(static_cast<std::int64_t>(block->file_numbers.size()) + 1);
  }
};

/// The regular grid of HEXA8 (or QUAD4) in cells of another type, with the groups of its cells and sides; `type_of`
/// gives the type for each of its cells.
template <class TypeOf>
Mesh with_cells_of(const Mesh& grid, const TypeOf& type_of) {
  const CellBlock& cells = *grid.block(grid.block(CellType::hexa8) != nullptr ? CellType::hexa8 : CellType::quad4);
  const auto n = static_cast<std::size_t>(node_count(cells.type));
  CellFiller filler;
  filler.mesh.coordinates = grid.coordinates;
  filler.mesh.node_numbers = grid.node_numbers;
  filler.mesh.node_groups = grid.node_groups;
  filler.mesh.report = grid.report;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::vector<Index> nodes(&cells.connectivity[n * k], &cells.connectivity[n * k] + n);
    for (const std::vector<int>& local : filling(linear_of(type_of(k)))) {
      std::vector<Index> corners;
      for (const int a : local) corners.push_back(a == 8 ? filler.middle(nodes) : nodes[static_cast<std::size_t>(a)]);
      filler.add_cell(type_of(k), corners);
    }
  }
  Mesh& mesh = filler.mesh;
  const std::vector<OuterFacet> outer = outer_facets(mesh);
  for (const auto& [name, refs] : grid.cell_groups) {
    const std::vector<Index> members = grid.nodes_of(name);
    const auto is_member = [&](Index node) { return std::binary_search(members.begin(), members.end(), node); };
    if (dimension(grid.blocks[static_cast<std::size_t>(refs.front().block)].type) == dimension(cells.type)) {
      for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
        if (dimension(mesh.blocks[b].type) == dimension(cells.type))
          for (std::size_t k = 0; k < mesh.blocks[b].size(); ++k)
            mesh.cell_groups[name].push_back({static_cast<Index>(b), static_cast<Index>(k)});
      continue;
    }
    std::set<std::pair<CellRef, int>> done;
    for (const OuterFacet& facet : outer) {
      if (!done.insert({facet.cell, facet.face}).second) continue;
      const CellBlock& block = mesh.blocks[static_cast<std::size_t>(facet.cell.block)];
      const auto first = static_cast<std::size_t>(node_count(block.type)) * static_cast<std::size_t>(facet.cell.cell);
      const CellFace& face = cell_faces(block.type)[static_cast<std::size_t>(facet.face)];
      std::vector<Index> corners;
      for (const LocalNode a : face.corners()) corners.push_back(block.connectivity[first + a]);
      if (!std::all_of(corners.begin(), corners.end(), is_member)) continue;
      const CellType face_type = face.type;
      filler.add_cell(face_type, corners);
      for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
        if (mesh.blocks[b].type == face_type)
          mesh.cell_groups[name].push_back({static_cast<Index>(b), static_cast<Index>(mesh.blocks[b].size()) - 1});
    }
  }
  return finished(std::move(mesh));
}

inline Mesh with_cells(const Mesh& grid, CellType type) {
  return with_cells_of(grid, [type](std::size_t) { return type; });
}

/// Hexahedra (every third cell), whose faces of four nodes the pyramids in the other cells take up: types that fit.
inline Mesh with_mixed_cells(const Mesh& grid) {
  return with_cells_of(grid, [](std::size_t k) { return k % 3 == 0 ? CellType::hexa8 : CellType::pyra5; });
}

/// The types of solids, and of plane cells, that a grid can be meshed with.
inline constexpr std::array<CellType, 9> solid_types{CellType::tetra4,  CellType::tetra10, CellType::penta6,
                                                     CellType::penta15, CellType::pyra5,   CellType::pyra13,
                                                     CellType::hexa8,   CellType::hexa20,  CellType::hexa27};
inline constexpr std::array<CellType, 5> plane_types{CellType::tria3, CellType::tria6, CellType::quad4, CellType::quad8,
                                                     CellType::quad9};

}  // namespace carom::test
