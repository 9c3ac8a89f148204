#include "solid/assembly.hpp"

#include <algorithm>
#include <cassert>
#include <map>

#include "base/types.hpp"

namespace carom {
namespace {

/// Cells of each node: begin offsets and cell positions.
struct NodeCells {
  std::vector<std::size_t> begin;
  std::vector<std::size_t> cells;
};

NodeCells cells_of_nodes(const SolidCells& solid) {
  const std::size_t node_count = solid.mesh->node_count();
  NodeCells result{std::vector<std::size_t>(node_count + 1, 0), {}};
  for (std::size_t c = 0; c < solid.size(); ++c)
    for (const Index n : solid.nodes_of(c)) ++result.begin[at(n) + 1];
  for (std::size_t n = 0; n < node_count; ++n) result.begin[n + 1] += result.begin[n];
  result.cells.resize(result.begin.back());
  std::vector<std::size_t> next(result.begin.begin(), result.begin.end() - 1);
  for (std::size_t c = 0; c < solid.size(); ++c)
    for (const Index n : solid.nodes_of(c)) result.cells[next[at(n)]++] = c;
  return result;
}

}  // namespace

CsrMatrix node_graph(std::span<const SolidCells* const> solids, std::span<const std::vector<Index>> links) {
  std::vector<NodeCells> incident;
  for (const SolidCells* solid : solids) incident.push_back(cells_of_nodes(*solid));
  std::multimap<Index, Index> tied;
  for (const std::vector<Index>& nodes : links)
    for (const Index a : nodes)
      for (const Index b : nodes) tied.emplace(a, b);
  const std::size_t node_count = solids[0]->mesh->node_count();
  CsrMatrix graph;
  graph.size = static_cast<Index>(node_count);
  graph.row_begin.assign(1, 0);
  std::vector<Index> row;
  for (std::size_t n = 0; n < node_count; ++n) {
    row.clear();
    for (std::size_t s = 0; s < solids.size(); ++s)
      for (std::size_t k = incident[s].begin[n]; k < incident[s].begin[n + 1]; ++k)
        for (const Index m : solids[s]->nodes_of(incident[s].cells[k])) row.push_back(m);
    const auto [first, last] = tied.equal_range(static_cast<Index>(n));
    for (auto tie = first; tie != last; ++tie) row.insert(row.end(), {tie->first, tie->second});
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    graph.column.insert(graph.column.end(), row.begin(), row.end());
    graph.row_begin.push_back(static_cast<std::int64_t>(graph.column.size()));
  }
  graph.value.assign(graph.column.size(), 0.0);
  return graph;
}

CsrMatrix dof_graph(const CsrMatrix& nodes) {
  CsrMatrix graph;
  graph.size = 3 * nodes.size;
  graph.row_begin.assign(1, 0);
  graph.column.reserve(9 * nodes.column.size());
  for (Index n = 0; n < nodes.size; ++n)
    for (int i = 0; i < 3; ++i) {
      for (std::int64_t k = nodes.row_begin[at(n)]; k < nodes.row_begin[at(n) + 1]; ++k)
        for (Index j = 0; j < 3; ++j) graph.column.push_back(3 * nodes.column[at(k)] + j);
      graph.row_begin.push_back(static_cast<std::int64_t>(graph.column.size()));
    }
  graph.value.assign(graph.column.size(), 0.0);
  return graph;
}

void add_diagonal(CsrMatrix& matrix, Index row, double value) {
  if (matrix.row_begin[at(row)] == matrix.row_begin[at(row) + 1])
    append_diagonal(matrix, row, value);
  else
    matrix.value[entry(matrix, row, row)] += value;
}

void append_diagonal(CsrMatrix& matrix, Index row, double value) {
  const auto r = static_cast<std::size_t>(row);
  const std::int64_t at = matrix.row_begin[r];
  assert(matrix.row_begin[r + 1] == at);
  matrix.column.insert(matrix.column.begin() + at, row);
  matrix.value.insert(matrix.value.begin() + at, value);
  for (std::size_t k = r + 1; k < matrix.row_begin.size(); ++k) ++matrix.row_begin[k];
}

std::size_t entry(const CsrMatrix& matrix, Index row, Index column) {
  const auto first = matrix.column.begin() + matrix.row_begin[at(row)];
  const auto last = matrix.column.begin() + matrix.row_begin[at(row) + 1];
  return static_cast<std::size_t>(std::lower_bound(first, last, column) - matrix.column.begin());
}

}  // namespace carom
