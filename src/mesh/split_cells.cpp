#include "mesh/split_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/finish_mesh.hpp"

namespace carom {

namespace {

/// Corners of the parent cell whose mean a node of a child is; the rest -1. A corner stands for itself.
using Corners = std::array<int, 8>;

/// The children of a cell type on the lattice of halves, in the node order of the type.
struct Split {
  std::vector<std::vector<Corners>> children;
};

/// Corners of a cell of dimension d in the unit cube, in the order of LINE2, QUAD4 and HEXA8.
constexpr std::array<std::array<int, 3>, 8> unit_corners{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

/// The corners that a point of the lattice {0, 1, 2}^d lies between.
Corners between(const std::array<int, 3>& point, std::size_t corners) {
  Corners out;
  out.fill(-1);
  std::size_t n = 0;
  for (std::size_t c = 0; c < corners; ++c) {
    bool belongs = true;
    for (std::size_t i = 0; i < 3; ++i) belongs = belongs && (point[i] == 1 || point[i] == 2 * unit_corners[c][i]);
    if (belongs) out[n++] = static_cast<int>(c);
  }
  return out;
}

/// A line, quadrangle or hexahedron; its second and third direction have no middle where it has none.
Split lattice_split(std::size_t corners) {
  Split split;
  for (std::size_t child = 0; child < corners; ++child) {
    std::vector<Corners> nodes;
    for (std::size_t a = 0; a < corners; ++a) {
      std::array<int, 3> point{};
      for (std::size_t i = 0; i < 3; ++i) point[i] = unit_corners[child][i] + unit_corners[a][i];
      nodes.push_back(between(point, corners));
    }
    split.children.push_back(std::move(nodes));
  }
  return split;
}

Corners corner(int c) {
  return {c, -1, -1, -1, -1, -1, -1, -1};
}
Corners middle(int a, int b) {
  return {a, b, -1, -1, -1, -1, -1, -1};
}

Split triangle_split() {
  return {{{corner(0), middle(0, 1), middle(2, 0)},
           {middle(0, 1), corner(1), middle(1, 2)},
           {middle(2, 0), middle(1, 2), corner(2)},
           {middle(0, 1), middle(1, 2), middle(2, 0)}}};
}

/// Four tetrahedra at the corners, and four about one diagonal of the octahedron between them, always the same one,
/// and with the children's nodes in such an order, that there are three shapes at most however often this is done (Bey,
/// Computing 55, 1995).
Split tetrahedron_split() {
  const Corners a = middle(0, 1), b = middle(1, 2), c = middle(0, 2), d = middle(0, 3), e = middle(1, 3),
                f = middle(2, 3);
  return {{{corner(0), a, c, d},
           {a, corner(1), b, e},
           {c, b, corner(2), f},
           {d, e, f, corner(3)},
           {a, c, d, e},
           {b, c, a, e},
           {c, d, e, f},
           {e, b, c, f}}};
}

/// The triangles in two layers.
Split pentahedron_split() {
  const auto raised = [](const Corners& of, int height) {  // 0: below, 1: between, 2: above
    Corners out;
    out.fill(-1);
    std::size_t n = 0;
    for (const int side : {0, 3})
      for (std::size_t i = 0; of[i] >= 0; ++i)
        if (height == 1 || (height == 2) == (side == 3)) out[n++] = of[i] + side;
    return out;
  };
  Split split;
  for (const std::vector<Corners>& triangle : triangle_split().children)
    for (const int layer : {0, 1}) {
      std::vector<Corners> nodes;
      for (const int height : {layer, layer + 1})
        for (const Corners& of : triangle) nodes.push_back(raised(of, height));
      split.children.push_back(std::move(nodes));
    }
  return split;
}

Split split_of(CellType type, const Mesh& mesh) {
  switch (type) {
    case CellType::point1:
      return {{{Corners{0, -1, -1, -1, -1, -1, -1, -1}}}};
    case CellType::line2:
      return lattice_split(2);
    case CellType::tria3:
      return triangle_split();
    case CellType::quad4:
      return lattice_split(4);
    case CellType::hexa8:
      return lattice_split(8);
    case CellType::tetra4:
      return tetrahedron_split();
    case CellType::penta6:
      return pentahedron_split();
    default:
      throw CaseError({mesh.report.source}, "mesh.refine", fmt::format("cells of type {}", name(type)),
                      "POINT1, LINE2, TRIA3, QUAD4, TETRA4, PENTA6 and HEXA8, which can be split",
                      "Make the finer mesh where this one was made.");
  }
}

void refuse_flat(const Mesh& mesh) {
  const CellBlock* hexas = mesh.block(CellType::hexa8);
  if (hexas == nullptr) return;
  for (std::size_t k = 0; k < hexas->size(); ++k) {
    const std::span<const Index> nodes(&hexas->connectivity[8 * k], 8);
    const auto coincide = [&](const std::array<LocalNode, 2>& pair) {
      return mesh.coordinates[at(nodes[pair[0]])] == mesh.coordinates[at(nodes[pair[1]])];
    };
    for (const auto& pairing : opposite_faces(CellType::hexa8)) {
      if (!std::all_of(pairing.begin(), pairing.end(), coincide)) continue;
      throw CaseError({mesh.report.source}, "mesh.refine",
                      fmt::format("cell {} of zero thickness", hexas->file_numbers[k]), "cells that have halves",
                      "Make finer meshes of interface cells where the mesh is made.");
    }
  }
}

/// Makes each new node once: it is known by the corners it lies between.
class NewNodes {
 public:
  explicit NewNodes(Mesh& mesh) : mesh_(mesh), last_(0) {
    for (const std::int64_t number : mesh.node_numbers) last_ = std::max(last_, number);
  }

  Index of(const Corners& corners, std::span<const Index> nodes) {
    std::array<Index, 8> key;
    key.fill(-1);
    std::size_t n = 0;
    for (; n < 8 && corners[n] >= 0; ++n) key[n] = nodes[static_cast<std::size_t>(corners[n])];
    if (n == 1) return key[0];
    std::ranges::sort(std::span(key).first(n));
    const auto [found, is_new] = known_.try_emplace(key, static_cast<Index>(mesh_.coordinates.size()));
    if (!is_new) return found->second;
    Vec3 mean{};
    for (std::size_t i = 0; i < n; ++i)
      mean = add(mean, scaled(mesh_.coordinates[at(key[i])], 1.0 / static_cast<double>(n)));
    mesh_.coordinates.push_back(mean);
    mesh_.node_numbers.push_back(++last_);
    return found->second;
  }

  /// Appends to a node group the new nodes that lie between nodes of it; not those inside of solids.
  void inherit(std::vector<Index>& group) const {
    std::vector<char> is_member(mesh_.coordinates.size(), 0);
    for (const Index n : group) is_member[at(n)] = 1;
    for (const auto& [key, node] : known_) {
      const auto belongs = [&](Index n) { return n < 0 || is_member[at(n)] != 0; };
      if (key[4] < 0 && std::all_of(key.begin(), key.end(), belongs)) group.push_back(node);
    }
    std::sort(group.begin(), group.end());
  }

 private:
  Mesh& mesh_;
  std::int64_t last_;
  std::map<std::array<Index, 8>, Index> known_;
};

}  // namespace

Mesh split_cells(Mesh mesh) {
  refuse_flat(mesh);
  NewNodes nodes(mesh);
  std::vector<Index> children_of;  // per block
  for (CellBlock& block : mesh.blocks) {
    const Split split = split_of(block.type, mesh);
    const auto corners = static_cast<std::size_t>(node_count(block.type));
    CellBlock finer{block.type, {}, {}};
    for (std::size_t k = 0; k < block.size(); ++k) {
      const std::span<const Index> parent(&block.connectivity[corners * k], corners);
      for (const std::vector<Corners>& child : split.children) {
        for (const Corners& node : child) finer.connectivity.push_back(nodes.of(node, parent));
        finer.file_numbers.push_back(block.file_numbers[k]);
      }
    }
    children_of.push_back(static_cast<Index>(split.children.size()));
    block = std::move(finer);
  }
  for (auto& [name, cells] : mesh.cell_groups) {
    std::vector<CellRef> finer;
    for (const CellRef& cell : cells) {
      const Index n = children_of[at(cell.block)];
      for (Index child = 0; child < n; ++child) finer.push_back({cell.block, n * cell.cell + child});
    }
    cells = std::move(finer);
  }
  for (auto& [name, group] : mesh.node_groups) nodes.inherit(group);
  return finished(std::move(mesh));
}

}  // namespace carom
