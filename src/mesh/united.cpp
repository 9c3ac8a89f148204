#include "mesh/united.hpp"

#include <algorithm>

#include "base/types.hpp"

namespace carom {

namespace {

std::int64_t largest(const std::vector<std::int64_t>& numbers, std::int64_t least) {
  for (const std::int64_t number : numbers) least = std::max(least, number);
  return least;
}

/// Appends the cells to those of their type; where its block and its cells begin.
CellRef append(const CellBlock& block, Index nodes, std::int64_t numbers, std::vector<CellBlock>& to) {
  auto same = std::find_if(to.begin(), to.end(), [&](const CellBlock& each) { return each.type == block.type; });
  if (same == to.end()) same = to.insert(to.end(), {block.type, {}, {}});
  const CellRef begin{static_cast<Index>(same - to.begin()), static_cast<Index>(same->size())};
  for (const Index n : block.connectivity) same->connectivity.push_back(n + nodes);
  for (const std::int64_t number : block.file_numbers) same->file_numbers.push_back(number + numbers);
  return begin;
}

/// What was seen of the cells of both.
void add_report(const MeshReport& second, std::int64_t numbers, MeshReport& report) {
  report.format += " and " + second.format;
  if (report.turned == 0 && second.turned > 0) report.first_turned = second.first_turned + numbers;
  report.turned += second.turned;
  report.notes.insert(report.notes.end(), second.notes.begin(), second.notes.end());
  if (second.worst_cell == 0 || (report.worst_cell != 0 && report.worst_jacobian <= second.worst_jacobian)) return;
  report.worst_jacobian = second.worst_jacobian;
  report.worst_cell = second.worst_cell + numbers;
}

}  // namespace

std::string common_group(const Mesh& a, const Mesh& b) {
  for (const std::string& name : b.group_names())
    if (a.has_group(name)) return name;
  return {};
}

Mesh united(Mesh first, const Mesh& second) {
  const auto nodes = static_cast<Index>(first.node_count());
  const std::int64_t last_node = largest(first.node_numbers, 0);
  std::int64_t last_cell = 0;
  for (const CellBlock& block : first.blocks) last_cell = largest(block.file_numbers, last_cell);
  first.coordinates.insert(first.coordinates.end(), second.coordinates.begin(), second.coordinates.end());
  for (const std::int64_t number : second.node_numbers) first.node_numbers.push_back(number + last_node);
  std::vector<CellRef> begin;
  for (const CellBlock& block : second.blocks) begin.push_back(append(block, nodes, last_cell, first.blocks));
  for (const auto& [name, members] : second.node_groups)
    for (const Index n : members) first.node_groups[name].push_back(n + nodes);
  for (const auto& [name, members] : second.cell_groups) {
    std::vector<CellRef>& all = first.cell_groups[name];
    for (const CellRef& cell : members) {
      const CellRef& from = begin[at(cell.block)];
      all.push_back({from.block, from.cell + cell.cell});
    }
    std::sort(all.begin(), all.end());
  }
  const auto append_instances = [](const std::vector<NumbersOfInstance>& from, std::int64_t last,
                                   std::vector<NumbersOfInstance>& to) {
    if (!to.empty()) to.push_back({last, ""});
    for (const NumbersOfInstance& each : from) to.push_back({each.after + last, each.instance});
  };
  append_instances(second.node_instances, last_node, first.node_instances);
  append_instances(second.cell_instances, last_cell, first.cell_instances);
  add_report(second.report, last_cell, first.report);
  return first;
}

}  // namespace carom
