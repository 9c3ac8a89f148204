#include "mesh/mesh.hpp"

#include <algorithm>
#include <iterator>

namespace carom {

namespace {

/// The nodes whose flag is set.
std::vector<Index> marked(const std::vector<char>& flags) {
  std::vector<Index> nodes;
  for (std::size_t n = 0; n < flags.size(); ++n)
    if (flags[n] != 0) nodes.push_back(static_cast<Index>(n));
  return nodes;
}

std::string label_of(std::int64_t number, const std::vector<NumbersOfInstance>& instances) {
  const auto behind = std::ranges::lower_bound(instances, number, {}, &NumbersOfInstance::after);
  if (behind == instances.begin() || std::prev(behind)->instance.empty()) return std::to_string(number);
  const NumbersOfInstance& own = *std::prev(behind);
  return std::to_string(number - own.after) + " of instance " + own.instance;
}

}  // namespace

std::string Mesh::node_label(Index node) const {
  return label_of(node_numbers[at(node)], node_instances);
}

std::string Mesh::cell_label(const CellRef& cell) const {
  return cell_label(blocks[at(cell.block)].file_numbers[at(cell.cell)]);
}

std::string Mesh::cell_label(std::int64_t file_number) const {
  return label_of(file_number, cell_instances);
}

const CellBlock* Mesh::block(CellType type) const {
  const auto found = std::find_if(blocks.begin(), blocks.end(), [&](const CellBlock& b) { return b.type == type; });
  return found == blocks.end() ? nullptr : &*found;
}

std::vector<Index> Mesh::nodes_of(const std::string& group) const {
  const auto cells = cell_groups.find(group);
  const auto named = node_groups.find(group);
  if (cells == cell_groups.end()) return named == node_groups.end() ? std::vector<Index>{} : named->second;
  std::vector<char> is_member(node_count(), 0);
  if (named != node_groups.end())
    for (const Index n : named->second) is_member[static_cast<std::size_t>(n)] = 1;
  for (const CellRef& ref : cells->second)
    for (const Index n : blocks[static_cast<std::size_t>(ref.block)].nodes(ref.cell))
      is_member[static_cast<std::size_t>(n)] = 1;
  return marked(is_member);
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
