#include "mesh/mesh_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "mesh/cell_topology.hpp"
#include "mesh/orientation.hpp"

namespace carom {

namespace {

std::string format_box(const Mesh& mesh) {
  if (mesh.coordinates.empty()) return "";
  Vec3 low = mesh.coordinates[0], high = low;
  for (const Vec3& x : mesh.coordinates)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], x[c]);
      high[c] = std::max(high[c], x[c]);
    }
  std::string text;
  for (std::size_t c = 0; c < 3; ++c)
    text += fmt::format("{:<9} {} from {:>12.6g} to {:>12.6g}, length {:.6g}\n", c == 0 ? "box" : "", "xyz"[c], low[c],
                        high[c], high[c] - low[c]);
  return text;
}

std::size_t count_interfaces(const Mesh& mesh) {
  std::size_t count = 0;
  const std::vector<std::uint8_t> dimensions = node_dimensions(mesh);
  for (const CellBlock& block : mesh.blocks) {
    if (opposite_faces(block.type).empty()) continue;
    const auto n = static_cast<std::size_t>(node_count(block.type));
    for (std::size_t cell = 0; cell < block.size(); ++cell) {
      const std::span<const Index> nodes(&block.connectivity[cell * n], n);
      const bool counts = !on_boundary(nodes, block.type, dimensions);
      count += counts && has_zero_thickness(mesh, block.type, nodes) ? 1 : 0;
    }
  }
  return count;
}

std::string format_cells(const Mesh& mesh) {
  std::string text, label = "cells";
  for (const CellBlock& block : mesh.blocks) {
    text += fmt::format("{:<9} {:<8} {:>10}\n", label, name(block.type), block.size());
    label.clear();
  }
  const MeshReport& report = mesh.report;
  if (report.worst_cell != 0)
    text += fmt::format("{:<9} worst Jacobian ratio {:.4g} in cell {}; {} turned\n", "shape", report.worst_jacobian,
                        mesh.cell_label(report.worst_cell),
                        report.turned == 1 ? "1 cell" : fmt::format("{} cells", report.turned));
  if (const std::size_t interfaces = count_interfaces(mesh); interfaces > 0)
    text += fmt::format("{:<9} {} of zero thickness\n", "", interfaces);
  return text;
}

/// "QUAD4 1, HEXA8 20"
std::string cells_by_type(const Mesh& mesh, const std::vector<CellRef>& cells) {
  std::map<Index, std::size_t> counts;
  for (const CellRef& ref : cells) ++counts[ref.block];
  std::vector<std::string> parts;
  for (const auto& [block, count] : counts)
    parts.push_back(fmt::format("{} {}", name(mesh.blocks[static_cast<std::size_t>(block)].type), count));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string format_groups(const Mesh& mesh) {
  const std::vector<std::string> names = mesh.group_names();
  if (names.empty()) return fmt::format("{:<9} none\n", "groups");
  std::size_t width = 4;
  for (const std::string& group : names) width = std::max(width, group.size());
  std::string text = fmt::format("{:<9} {:<{}} {:>10}  {}\n", "groups", "name", width, "nodes", "cells");
  for (const std::string& group : names) {
    const auto cells = mesh.cell_groups.find(group);
    const bool named_nodes = mesh.node_groups.count(group) != 0;
    text += fmt::format("{:<9} {:<{}} {:>10}  {}\n", "", group, width, mesh.nodes_of(group).size(),
                        cells == mesh.cell_groups.end() ? "(node group)"
                        : named_nodes                   ? cells_by_type(mesh, cells->second) + ", and a node group"
                                                        : cells_by_type(mesh, cells->second));
  }
  return text;
}

}  // namespace

std::string mesh_summary(const Mesh& mesh) {
  const auto [low, high] = std::minmax_element(mesh.node_numbers.begin(), mesh.node_numbers.end());
  std::string text = fmt::format("{:<9} {}\n{:<9} {}\n", "mesh", mesh.report.source, "format", mesh.report.format);
  text += fmt::format("{:<9} {}", "nodes", mesh.node_count());
  text += mesh.node_numbers.empty() ? "\n" : fmt::format(", numbered {} to {}\n", *low, *high);
  text += format_box(mesh) + format_cells(mesh) + format_groups(mesh);
  for (const std::string& note : mesh.report.notes) text += fmt::format("{:<9} {}\n", "note", note);
  return text;
}

}  // namespace carom
