#include "solid/node_patches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "kernels/hourglass_flow.hpp"
#include "mesh/cell_size.hpp"
#include "solid/element_table.hpp"

namespace carom {
namespace {

/// A node with the cells about it.
struct Patch {
  Index node = 0;
  std::vector<Index> neighbours;              ///< increasing
  std::vector<Index> cells;                   ///< positions in a list of cells
  std::vector<std::array<Index, 3>> corners;  ///< of each, places among the neighbours, so that its volume is positive
};

/// The other corners of a cell whose first corner is to be `corner`, in the order that keeps its orientation.
std::span<const std::size_t> others(std::size_t corners, std::size_t corner) {
  static constexpr std::size_t of_tetra[4][3] = {{1, 2, 3}, {0, 3, 2}, {3, 0, 1}, {2, 1, 0}};
  static constexpr std::size_t of_triangle[3][2] = {{1, 2}, {2, 0}, {0, 1}};
  if (corners == 4) return of_tetra[corner];
  return of_triangle[corner];
}

/// The patches of the nodes of some cells, by increasing node. Of cell k nodes_of(k) gives the nodes.
template <class NodesOf>
std::vector<Patch> patches_of(std::size_t node_count, std::size_t first, std::size_t count, const NodesOf& nodes_of) {
  std::vector<Index> place(node_count, -1);
  std::vector<Patch> patches;
  for (std::size_t k = first; k < first + count; ++k)
    for (const Index n : nodes_of(k)) place[at(n)] = 0;
  for (std::size_t n = 0; n < node_count; ++n)
    if (place[n] == 0) {
      place[n] = static_cast<Index>(patches.size());
      patches.emplace_back().node = static_cast<Index>(n);
    }
  for (std::size_t k = first; k < first + count; ++k)
    for (const Index n : nodes_of(k)) patches[at(place[at(n)])].cells.push_back(static_cast<Index>(k));
  for (Patch& patch : patches) {
    for (const Index k : patch.cells)
      for (const Index n : nodes_of(at(k)))
        if (n != patch.node) patch.neighbours.push_back(n);
    std::sort(patch.neighbours.begin(), patch.neighbours.end());
    patch.neighbours.erase(std::unique(patch.neighbours.begin(), patch.neighbours.end()), patch.neighbours.end());
    for (const Index k : patch.cells) {
      const auto nodes = nodes_of(at(k));
      const auto own = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), patch.node) - nodes.begin());
      std::array<Index, 3>& corners = patch.corners.emplace_back();
      std::size_t c = 0;
      for (const std::size_t a : others(nodes.size(), own))
        corners[c++] = static_cast<Index>(std::lower_bound(patch.neighbours.begin(), patch.neighbours.end(), nodes[a]) -
                                          patch.neighbours.begin());
    }
  }
  return patches;
}

/// Numbers of neighbours of the patches of a block: few blocks, and few places filled up.
std::size_t size_class(const Patch& patch) {
  const std::size_t n = patch.neighbours.size();
  const std::size_t step = n <= 16 ? 2 : n <= 32 ? 4 : 16;
  return (n + step - 1) / step * step;
}

const CellStages& stages_of(const Part& part, const KernelTable& table) {
  return table.patches[part.type == CellType::tetra4 ? 0 : part.section == Section::axisymmetric ? 2 : 1];
}

/// A block of patches, laid out as CellBatches.
Block patch_block(const Part& part, const std::vector<const Patch*>& patches, const KernelTable& table,
                  const SolidCells& solid) {
  std::size_t neighbours = 0, cells = 0;
  for (const Patch* patch : patches) {
    neighbours = std::max(neighbours, patch->neighbours.size());
    cells = std::max(cells, patch->cells.size());
  }
  CellStages own = stages_of(part, table);
  own.nodes = static_cast<int>(neighbours) + 1;
  own.modes = static_cast<int>(neighbours);
  own.corners = static_cast<int>(cells) * own.directions;
  const auto dimension = at(own.directions);
  Block block = block_of(part, std::make_shared<const CellStages>(own), table);
  block.cells = static_cast<Index>(patches.size());
  const auto lanes = block.lanes();
  const std::size_t whole = (patches.size() + lanes - 1) / lanes * lanes;
  block.offset.assign(whole * at(own.places()), 0);
  if (part.viscosity.is_any()) block.length.assign(whole, infinity);
  for (std::size_t k = 0; k < whole; ++k) {
    const Patch& patch = *patches[std::min(k, patches.size() - 1)];
    Index* batch = block.offset.data() + k / lanes * lanes * at(own.places()) + k % lanes;
    for (std::size_t a = 0; a < at(own.nodes); ++a)
      batch[a * lanes] = 3 * (a == 0 || a > patch.neighbours.size() ? patch.node : patch.neighbours[a - 1]);
    Index* corner = batch + at(own.nodes) * lanes;
    for (std::size_t e = 0; e < patch.cells.size(); ++e)
      for (std::size_t c = 0; c < dimension; ++c) corner[(dimension * e + c) * lanes] = patch.corners[e][c];
    for (const Index cell : patch.cells)
      if (!block.length.empty())
        block.length[k] = std::min(
            block.length[k],
            cell_length(part.type, std::span<const Vec3>(solid.coordinates_of(at(cell))).first(dimension + 1)));
  }
  return block;
}

}  // namespace

NodePatches make_node_patches(const Model& model, const SolidCells& solid, const KernelTable& table) {
  NodePatches out;
  out.cells.mesh = solid.mesh;
  out.cells.power_bound = table.power_bound;
  if (std::none_of(solid.blocks.begin(), solid.blocks.end(),
                   [](const Block& block) { return block.is_nodal() && !block.is_rigid; }))
    return out;
  std::vector<std::vector<Index>> of_cell(solid.size());
  out.part_begin.assign(1, 0);
  out.cells.node_begin.assign(1, 0);
  std::size_t history = solid.history_size();
  for (const Block& nodal : solid.blocks) {
    if (!nodal.is_nodal() || nodal.is_rigid) continue;
    const Part& part = model.parts[nodal.part];
    const std::vector<Patch> patches = patches_of(solid.mesh->node_count(), at(nodal.first), at(nodal.cells),
                                                  [&](std::size_t k) { return solid.nodes_of(k); });
    for (const Patch& patch : patches)
      if (const Valence own{patch.node, patch.neighbours.size(), patch.cells.size()}; !own.is_within_patch())
        throw CaseError(Location{solid.mesh->report.source}, "parts." + part.name,
                        fmt::format("node {} with {} neighbours and {} cells", solid.mesh->node_label(patch.node),
                                    own.neighbours, own.cells),
                        fmt::format("at most {} neighbours and {} cells about a node of formulation \"nodal\"",
                                    most_neighbours, most_patch_cells),
                        "mesh the part without such a fan, or take formulation = \"full\"");
    std::vector<const Patch*> order;
    for (const Patch& patch : patches) order.push_back(&patch);
    std::stable_sort(order.begin(), order.end(),
                     [](const Patch* a, const Patch* b) { return size_class(*a) < size_class(*b); });
    for (std::size_t begin = 0; begin < order.size();) {
      std::size_t end = begin + 1;
      while (end < order.size() && size_class(*order[end]) == size_class(*order[begin])) ++end;
      const std::vector<const Patch*> equal(order.begin() + static_cast<std::ptrdiff_t>(begin),
                                            order.begin() + static_cast<std::ptrdiff_t>(end));
      Block block = patch_block(part, equal, table, solid);
      block.part = nodal.part;
      block.first = static_cast<Index>(out.cells.size());
      block.history_first = history;
      history += block.history_size();
      for (std::size_t k = 0; k < equal.size(); ++k) {
        const Patch& patch = *equal[k];
        for (const Index cell : patch.cells) of_cell[at(cell)].push_back(block.first + static_cast<Index>(k));
        out.parts.insert(out.parts.end(), patch.cells.begin(), patch.cells.end());
        out.part_begin.push_back(out.parts.size());
        std::vector<Index>& nodes = out.cells.node_list;
        nodes.push_back(patch.node);
        nodes.insert(nodes.end(), patch.neighbours.begin(), patch.neighbours.end());
        nodes.insert(nodes.end(), block.nodes() - 1 - patch.neighbours.size(), patch.node);
        out.cells.node_begin.push_back(nodes.size());
      }
      out.cells.blocks.push_back(std::move(block));
      begin = end;
    }
  }
  out.begin.assign(1, 0);
  for (const std::vector<Index>& own : of_cell) {
    out.of_cell.insert(out.of_cell.end(), own.begin(), own.end());
    out.begin.push_back(out.of_cell.size());
  }
  cut_and_colour(out.cells);
  return out;
}

Valence largest_valence(const Mesh& mesh, CellType type, std::span<const Index> cells) {
  Valence largest;
  const CellBlock& block = *mesh.block(type);
  for (const Patch& patch :
       patches_of(mesh.node_count(), 0, cells.size(), [&](std::size_t k) { return block.nodes(cells[k]); })) {
    const Valence own{patch.node, patch.neighbours.size(), patch.cells.size()};
    if (!own.is_within_patch()) return own;
    if (own.neighbours > largest.neighbours) largest = own;
  }
  return largest;
}

}  // namespace carom
