#include "build/unused_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "mesh/cell_topology.hpp"

namespace carom {

namespace {

using Marks = std::vector<std::vector<char>>;  ///< per block and cell

Marks used_cells(const Case& given, const Mesh& mesh, const Parts& parts) {
  Marks used;
  const std::vector<std::uint8_t> dimensions = node_dimensions(mesh);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const CellBlock& block = mesh.blocks[b];
    const auto n = static_cast<std::size_t>(node_count(block.type));
    std::vector<char>& marks = used.emplace_back(block.size(), dimension(block.type) == 0 ? 1 : 0);
    for (std::size_t k = 0; k < block.size(); ++k) {
      const CellRef cell{static_cast<Index>(b), static_cast<Index>(k)};
      const std::span<const Index> nodes(&block.connectivity[k * n], n);
      if (parts.part_of(cell) != nullptr || on_boundary(nodes, block.type, dimensions)) marks[k] = 1;
    }
  }
  const auto take = [&](const std::string& group) {
    const auto found = mesh.cell_groups.find(group);
    if (found == mesh.cell_groups.end()) return;
    for (const CellRef& cell : found->second) used[at(cell.block)][at(cell.cell)] = 1;
  };
  for (const CaseContact& contact : given.contacts) {
    if (const Located<std::string>* cells = contact.own_cells()) take(**cells);
  }
  return used;
}

/// "27 HEXA8 in \"HIGH\" (cell 28 and others), 4 QUAD4 in no group (cell 99 and others)"
std::string list_of(const Mesh& mesh, const Marks& used) {
  struct Some {
    std::size_t count = 0;
    std::string first;
  };
  std::map<std::pair<std::string, CellType>, Some> found;
  std::vector<std::vector<char>> named;
  for (const std::vector<char>& marks : used) named.push_back(marks);
  const auto add = [&](const std::string& group, std::size_t block, std::size_t cell) {
    Some& some = found[{group, mesh.blocks[block].type}];
    if (some.count++ == 0) some.first = mesh.cell_label(CellRef{static_cast<Index>(block), static_cast<Index>(cell)});
  };
  for (const auto& [name, cells] : mesh.cell_groups) {
    for (const CellRef& cell : cells) {
      if (used[at(cell.block)][at(cell.cell)] != 0) continue;
      named[at(cell.block)][at(cell.cell)] = 1;
      add("\"" + name + "\"", at(cell.block), at(cell.cell));
    }
  }
  for (std::size_t b = 0; b < named.size(); ++b)
    for (std::size_t k = 0; k < named[b].size(); ++k)
      if (named[b][k] == 0) add("no group", b, k);
  std::string text;
  for (const auto& [key, some] : found)
    text += fmt::format("{}{} {} in {} (cell {}{})", text.empty() ? "" : ", ", some.count, name(key.second), key.first,
                        some.first, some.count > 1 ? " and others" : "");
  return text;
}

}  // namespace

void refuse_unused_cells(const Case& given, const Mesh& mesh, const Parts& parts) {
  if (given.mesh.unused == CaseMesh::Unused::ignore) return;
  const Marks used = used_cells(given, mesh, parts);
  const bool all = std::all_of(used.begin(), used.end(), [](const std::vector<char>& marks) {
    return std::find(marks.begin(), marks.end(), 0) == marks.end();
  });
  if (all) return;
  const Location& where = given.mesh.file->empty() ? given.mesh.where : given.mesh.file.where;
  throw CaseError(where, "mesh", "cells that nothing takes: " + list_of(mesh, used),
                  "every solid, free face and free line in a [[part]], an interface or a rigid surface",
                  mesh.report.format.starts_with("deck")
                      ? "Faces of a deck belong to a *RIGID BODY that a contact meets: give them one, or take their "
                        "*ELEMENT out of the deck."
                      : "Give them a part, or say mesh.unused = \"ignore\" if the run is meant to go without them.");
}

}  // namespace carom
