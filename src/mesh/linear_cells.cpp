#include "mesh/linear_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/finish_mesh.hpp"

namespace carom {

namespace {

/// Per node its new index; -1 for those that are no corner but in the middle of some cell.
std::vector<Index> kept_nodes(const Mesh& mesh) {
  std::vector<char> is_corner(mesh.node_count(), 0), is_middle(mesh.node_count(), 0);
  for (const CellBlock& block : mesh.blocks) {
    if (dimension(block.type) == 0) continue;
    const auto n = static_cast<std::size_t>(node_count(block.type)),
               corners = static_cast<std::size_t>(corner_count(block.type));
    for (std::size_t i = 0; i < block.connectivity.size(); ++i)
      (i % n < corners ? is_corner : is_middle)[at(block.connectivity[i])] = 1;
  }
  std::vector<Index> kept(mesh.node_count(), -1);
  Index next = 0;
  for (std::size_t n = 0; n < kept.size(); ++n)
    if (is_corner[n] != 0 || is_middle[n] == 0) kept[n] = next++;
  return kept;
}

void drop_nodes(const std::vector<Index>& kept, Mesh& mesh) {
  for (std::size_t n = 0; n < kept.size(); ++n) {
    if (kept[n] < 0) continue;
    mesh.coordinates[at(kept[n])] = mesh.coordinates[n];
    mesh.node_numbers[at(kept[n])] = mesh.node_numbers[n];
  }
  const auto left = static_cast<std::size_t>(std::count_if(kept.begin(), kept.end(), [](Index n) { return n >= 0; }));
  mesh.coordinates.resize(left);
  mesh.node_numbers.resize(left);
  for (auto& [name, nodes] : mesh.node_groups) {
    for (Index& n : nodes) n = kept[at(n)];
    std::erase_if(nodes, [](Index n) { return n < 0; });
  }
}

/// Appends the corners of a block's cells to the blocks; returns where each cell has gone, {-1, -1} for none.
std::vector<CellRef> append_linear(const CellBlock& block, const std::vector<Index>& kept,
                                   std::vector<CellBlock>& blocks) {
  const CellType type = linear_type(block.type);
  auto into = std::find_if(blocks.begin(), blocks.end(), [&](const CellBlock& b) { return b.type == type; });
  const auto n = static_cast<std::size_t>(node_count(block.type)), corners = static_cast<std::size_t>(node_count(type));
  std::vector<CellRef> moved(block.size(), {-1, -1});
  for (std::size_t k = 0; k < block.size(); ++k) {
    const std::span<const Index> nodes(&block.connectivity[n * k], corners);
    if (std::any_of(nodes.begin(), nodes.end(), [&](Index node) { return kept[at(node)] < 0; })) continue;
    if (into == blocks.end()) into = blocks.insert(into, {type, {}, {}});
    moved[k] = {static_cast<Index>(into - blocks.begin()), static_cast<Index>(into->size())};
    for (const Index node : nodes) into->connectivity.push_back(kept[at(node)]);
    into->file_numbers.push_back(block.file_numbers[k]);
  }
  return moved;
}

}  // namespace

Mesh linear_cells(Mesh mesh) {
  const std::vector<Index> kept = kept_nodes(mesh);
  const std::size_t before = mesh.node_count();
  drop_nodes(kept, mesh);
  std::vector<CellBlock> blocks;
  std::vector<std::vector<CellRef>> moved;
  for (const CellBlock& block : mesh.blocks) moved.push_back(append_linear(block, kept, blocks));
  mesh.blocks = std::move(blocks);
  for (auto& [name, cells] : mesh.cell_groups) {
    for (CellRef& cell : cells) cell = moved[at(cell.block)][at(cell.cell)];
    std::erase_if(cells, [](const CellRef& cell) { return cell.block < 0; });
  }
  if (mesh.node_count() < before)
    mesh.report.notes.push_back(
        fmt::format("taken as linear: {} nodes in the middle of cells dropped", before - mesh.node_count()));
  return finished(std::move(mesh));
}

}  // namespace carom
