#include "mesh/write_gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <utility>

#include "base/errors.hpp"
#include "mesh/gmsh_cells.hpp"

namespace carom {

namespace {

using Tags = std::map<std::pair<int, std::string>, int>;  ///< by dimension and name

std::int64_t gmsh_number(CellType type) {
  constexpr std::int64_t last = 19;
  for (std::int64_t number = 1; number <= last; ++number) {
    const GmshCellType* cell = gmsh_cell_type(number);
    if (cell != nullptr && cell->type == type) return number;
  }
  return 0;
}

Tags tags_of(const Mesh& mesh) {
  Tags tags;
  const auto add = [&](int dimension, const std::string& name) {
    if (name.find_first_of("+\"") != std::string::npos)
      throw CaseError({mesh.report.source, 0, 0}, "", "a group named " + name, "names without + and quotes",
                      "Rename the set.");
    tags.emplace(std::pair(dimension, name), static_cast<int>(tags.size()) + 1);
  };
  for (const auto& [name, nodes] : mesh.node_groups) add(0, name);
  for (const auto& [name, cells] : mesh.cell_groups)
    for (const CellRef& cell : cells) add(dimension(mesh.blocks[at(cell.block)].type), name);
  return tags;
}

void write_cell(const CellBlock& block, Index cell, int tag, const Mesh& mesh, std::string& text) {
  const std::int64_t number = gmsh_number(block.type);
  const std::span<const LocalNode> order = gmsh_cell_type(number)->order;
  const std::span<const Index> nodes = block.nodes(cell);
  std::array<std::int64_t, most_nodes> written{};
  for (std::size_t i = 0; i < nodes.size(); ++i) written.at(order[i]) = mesh.node_numbers[at(nodes[i])];
  fmt::format_to(std::back_inserter(text), "{} {} 2 {} {}", block.file_numbers[at(cell)], number, tag, tag);
  for (std::size_t i = 0; i < nodes.size(); ++i) fmt::format_to(std::back_inserter(text), " {}", written.at(i));
  text += '\n';
}

/// The cells block by block, each once for each of its groups.
std::size_t write_cells(const Mesh& mesh, const Tags& tags, std::string& text) {
  std::vector<std::pair<CellRef, int>> members;
  for (const auto& [name, cells] : mesh.cell_groups)
    for (const CellRef& cell : cells)
      members.emplace_back(cell, tags.at({dimension(mesh.blocks[at(cell.block)].type), name}));
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
  std::size_t count = 0;
  auto next = members.begin();
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    for (std::size_t c = 0; c < mesh.blocks[b].size(); ++c) {
      const CellRef own{static_cast<Index>(b), static_cast<Index>(c)};
      const bool is_member = next != members.end() && next->first == own;
      if (!is_member) write_cell(mesh.blocks[b], own.cell, 0, mesh, text), ++count;
      for (; next != members.end() && next->first == own; ++next, ++count)
        write_cell(mesh.blocks[b], own.cell, next->second, mesh, text);
    }
  return count;
}

std::size_t write_points(const Mesh& mesh, const Tags& tags, std::string& text) {
  constexpr int point = 15;
  std::int64_t number = 0;
  for (const CellBlock& block : mesh.blocks)
    for (const std::int64_t own : block.file_numbers) number = std::max(number, own);
  std::size_t count = 0;
  for (const auto& [name, nodes] : mesh.node_groups)
    for (const Index node : nodes) {
      const int tag = tags.at({0, name});
      fmt::format_to(std::back_inserter(text), "{} {} 2 {} {} {}\n", ++number, point, tag, tag,
                     mesh.node_numbers[at(node)]);
      ++count;
    }
  return count;
}

}  // namespace

std::string gmsh_text(const Mesh& mesh) {
  const Tags tags = tags_of(mesh);
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  if (!tags.empty()) {
    text += fmt::format("$PhysicalNames\n{}\n", tags.size());
    for (const auto& [key, tag] : tags) text += fmt::format("{} {} \"{}\"\n", key.first, tag, key.second);
    text += "$EndPhysicalNames\n";
  }
  text += fmt::format("$Nodes\n{}\n", mesh.node_count());
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    const Vec3& x = mesh.coordinates[n];
    fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", mesh.node_numbers[n], x[0], x[1], x[2]);
  }
  std::string cells;
  const std::size_t count = write_cells(mesh, tags, cells) + write_points(mesh, tags, cells);
  return text + fmt::format("$EndNodes\n$Elements\n{}\n", count) + cells + "$EndElements\n";
}

}  // namespace carom
