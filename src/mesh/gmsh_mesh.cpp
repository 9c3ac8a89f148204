#include "mesh/gmsh_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carom {

namespace {

std::vector<std::string> split_at_plus(const std::string& names) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find('+', begin), names.size());
    if (end > begin) parts.push_back(names.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// " (TETRA20)": types of Gmsh that are not read, by the name of their shape and their number of nodes.
std::string name_of_other(std::int64_t number) {
  static const std::map<std::int64_t, const char*> names{
      {13, "PENTA18"}, {14, "PYRA14"},  {20, "TRIA9"},  {21, "TRIA10"}, {22, "TRIA12"}, {23, "TRIA15"},
      {24, "TRIA15"},  {25, "TRIA21"},  {26, "LINE4"},  {27, "LINE5"},  {28, "LINE6"},  {29, "TETRA20"},
      {30, "TETRA35"}, {31, "TETRA56"}, {36, "QUAD16"}, {92, "HEXA64"}, {93, "HEXA125"}};
  const auto found = names.find(number);
  return found == names.end() ? "" : fmt::format(" ({})", found->second);
}

/// order[i]: the first cell over the same nodes in the same order as cell i (i itself when there is none before).
std::vector<Index> first_alike(const CellBlock& block) {
  const auto n = static_cast<std::ptrdiff_t>(node_count(block.type));
  const auto nodes = [&](Index cell) { return block.connectivity.begin() + cell * n; };
  std::vector<std::pair<std::uint64_t, Index>> hashes(block.size());
  for (std::size_t i = 0; i < hashes.size(); ++i) {
    std::uint64_t hash = 1469598103934665603U;  // FNV-1a
    for (std::ptrdiff_t k = 0; k < n; ++k)
      hash = (hash ^ static_cast<std::uint64_t>(*(nodes(static_cast<Index>(i)) + k))) * 1099511628211U;
    hashes[i] = {hash, static_cast<Index>(i)};
  }
  std::sort(hashes.begin(), hashes.end());
  std::vector<Index> first(block.size());
  for (std::size_t i = 0; i < hashes.size(); ++i) {
    const Index cell = hashes[i].second;
    const bool alike = i > 0 && hashes[i - 1].first == hashes[i].first &&
                       std::equal(nodes(cell), nodes(cell) + n, nodes(hashes[i - 1].second));
    first[static_cast<std::size_t>(cell)] = alike ? first[static_cast<std::size_t>(hashes[i - 1].second)] : cell;
  }
  return first;
}

/// Removes the cells i with first[i] != i and returns the new index of every cell.
std::vector<Index> remove_repeated(CellBlock& block, const std::vector<Index>& first) {
  const auto n = static_cast<std::size_t>(node_count(block.type));
  std::vector<Index> new_index(first.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (static_cast<std::size_t>(first[i]) != i) {
      new_index[i] = new_index[static_cast<std::size_t>(first[i])];
      continue;
    }
    new_index[i] = static_cast<Index>(kept);
    std::copy_n(block.connectivity.begin() + static_cast<std::ptrdiff_t>(i * n), n,
                block.connectivity.begin() + static_cast<std::ptrdiff_t>(kept * n));
    block.file_numbers[kept++] = block.file_numbers[i];
  }
  block.connectivity.resize(kept * n);
  block.file_numbers.resize(kept);
  return new_index;
}

}  // namespace

void GmshMesh::name_physical(int dimension, std::int64_t tag, const std::string& names) {
  groups_[{dimension, tag}].names = split_at_plus(names);
}

void GmshMesh::begin_nodes(const GmshCursor& at, std::int64_t count) {
  if (has_nodes_) at.fail("a second list of nodes", "one", "Remove one of the two $Nodes sections.");
  if (count > std::numeric_limits<Index>::max())
    at.fail(fmt::format("{} nodes", count), "at most 2147483647", "Split the mesh.");
  has_nodes_ = true;
  numbers_ = NodeNumbers(static_cast<std::size_t>(count));
  mesh_.coordinates.reserve(static_cast<std::size_t>(count));
  mesh_.node_numbers.reserve(static_cast<std::size_t>(count));
}

void GmshMesh::add_node(const GmshCursor& at, std::int64_t number, const Vec3& x) {
  if (number < 1) at.fail(fmt::format("node number {}", number), "a positive number", "Number the nodes from 1.");
  if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
    at.fail(fmt::format("node {} at ({}, {}, {})", number, x[0], x[1], x[2]), "finite coordinates",
            "Write the mesh again; a coordinate overflowed or was never set.");
  if (!numbers_.insert(number, static_cast<Index>(mesh_.coordinates.size())))
    at.fail(fmt::format("node number {} a second time", number), "every node number once",
            "Renumber the nodes, for instance by saving the mesh again from Gmsh.");
  mesh_.coordinates.push_back(x);
  mesh_.node_numbers.push_back(number);
}

const GmshCellType& GmshMesh::cell_type(const GmshCursor& at, std::int64_t type_number, std::int64_t cells) {
  const GmshCellType* type = gmsh_cell_type(type_number);
  if (type == nullptr)
    at.fail(
        fmt::format("{} cell{} of type {}{}", cells, cells == 1 ? "" : "s", type_number, name_of_other(type_number)),
        "types 1 to 12 or 15 to 19 (points; lines, triangles, quadrangles, tetrahedra, pyramids, pentahedra and "
        "hexahedra of order 1 and 2)",
        type_number == 13 || type_number == 14
            ? "Mesh without nodes at the centres of faces (Mesh.SecondOrderIncomplete = 1), or with order 1."
            : "Mesh with order 1 or 2 (Mesh.ElementOrder).");
  return *type;
}

std::size_t GmshMesh::block_of(CellType type) {
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b)
    if (mesh_.blocks[b].type == type) return b;
  mesh_.blocks.push_back({type, {}, {}});
  return mesh_.blocks.size() - 1;
}

GmshMesh::Group& GmshMesh::group(int dimension, std::int64_t tag) {
  Group& found = groups_[{dimension, tag}];
  const auto any = groups_.find({any_dimension, tag});
  if (found.names.empty() && any != groups_.end()) {
    found.names = any->second.names;
    any->second.used = true;
  }
  if (found.names.empty()) found.names.push_back(std::to_string(tag));
  found.used = true;
  return found;
}

void GmshMesh::add_cell(const GmshCursor& at, const GmshCellType& type, std::int64_t number,
                        std::span<const std::int64_t> nodes, std::span<const std::int64_t> physical) {
  std::array<Index, 27> local{};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    local[i] = numbers_.find(nodes[type.order[i]]);
    if (local[i] < 0)
      at.fail(fmt::format("node {} in cell {}", nodes[type.order[i]], number), "the number of a node in $Nodes",
              "Save the mesh again with all its nodes, or correct the cell.");
  }
  const std::size_t b = block_of(type.type);
  CellBlock& block = mesh_.blocks[b];
  if (block.size() >= static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    at.fail("more than 2147483647 cells of one type", "fewer", "Split the mesh.");
  const CellRef cell{static_cast<Index>(b), static_cast<Index>(block.size())};
  block.connectivity.insert(block.connectivity.end(), local.begin(),
                            local.begin() + static_cast<std::ptrdiff_t>(nodes.size()));
  block.file_numbers.push_back(number);
  const int dim = dimension(type.type);
  for (const std::int64_t tag : physical) {
    if (tag == 0) continue;
    for (const std::string& name :
         group(dim, tag < 0 && tag != std::numeric_limits<std::int64_t>::min() ? -tag : tag).names) {
      if (dim == 0)
        mesh_.node_groups[name].push_back(local[0]);
      else
        mesh_.cell_groups[name].push_back(cell);
    }
  }
}

void GmshMesh::merge_repeated_cells() {
  std::vector<std::vector<Index>> new_index;
  std::size_t merged = 0;
  for (CellBlock& block : mesh_.blocks) {
    const std::size_t before = block.size();
    new_index.push_back(remove_repeated(block, first_alike(block)));
    merged += before - block.size();
  }
  if (merged == 0) return;
  for (auto& [name, cells] : mesh_.cell_groups)
    for (CellRef& ref : cells)
      ref.cell = new_index[static_cast<std::size_t>(ref.block)][static_cast<std::size_t>(ref.cell)];
  mesh_.report.notes.push_back(
      fmt::format("{} repeated cells (one for each physical group of a cell) merged into one each", merged));
}

Mesh GmshMesh::take() {
  for (const auto& [key, group] : groups_)
    if (!group.used)
      mesh_.report.notes.push_back(
          fmt::format("physical name \"{}\"{} names nothing in this file", fmt::join(group.names, "+"),
                      key.first == any_dimension ? "" : fmt::format(" of dimension {}", key.first)));
  return std::move(mesh_);
}

}  // namespace carom
