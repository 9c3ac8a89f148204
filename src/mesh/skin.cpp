#include "mesh/skin.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>

#include "mesh/cell_topology.hpp"
#include "mesh/orientation.hpp"

namespace carom {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// A facet as its cell has it, and its nodes in increasing order, by which its twins are found.
struct Candidate {
  OuterFacet outer;
  std::array<Index, 4> sorted;
};

/// Corners of the facets of a cell, `size` to each facet.
struct FacetTable {
  std::size_t size;
  std::span<const LocalNode> corners;
};

FacetTable facet_table(CellType type) {
  static constexpr std::array<LocalNode, 24> kHexaFaces = [] {
    std::array<LocalNode, 24> flat{};
    for (std::size_t i = 0; i < 24; ++i) flat[i] = hexa8_faces[i / 4][i % 4];
    return flat;
  }();
  static constexpr std::array<LocalNode, 8> kQuadEdges{0, 1, 1, 2, 2, 3, 3, 0};
  static constexpr std::array<LocalNode, 2> kLineEnds{0, 1};
  switch (type) {
    case CellType::hexa8:
      return {4, kHexaFaces};
    case CellType::quad4:
      return {2, kQuadEdges};
    case CellType::line2:
      return {1, kLineEnds};
    default:
      return {1, {}};
  }
}

std::vector<Candidate> facets_of(const Mesh& mesh, std::size_t block, std::span<const std::uint8_t> dimensions) {
  const CellBlock& cells = mesh.blocks[block];
  const FacetTable table = facet_table(cells.type);
  if (table.corners.empty()) return {};
  const auto n = static_cast<std::size_t>(node_count(cells.type));
  std::vector<Candidate> candidates;
  candidates.reserve(cells.size() * table.corners.size() / table.size);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const std::span<const Index> nodes(&cells.connectivity[n * cell], n);
    if (on_boundary(nodes, cells.type, dimensions) || has_zero_thickness(mesh, cells.type, nodes)) continue;
    for (std::size_t first = 0; first < table.corners.size(); first += table.size) {
      Facet facet{{-1, -1, -1, -1}, static_cast<int>(table.size)};
      for (std::size_t a = 0; a < table.size; ++a) facet.node[a] = nodes[table.corners[first + a]];
      if (on_boundary({facet.begin(), facet.end()}, cells.type, dimensions)) continue;  // it ends in a body
      Candidate& candidate = candidates.emplace_back(
          Candidate{{facet, {static_cast<Index>(block), static_cast<Index>(cell)}}, facet.node});
      std::sort(candidate.sorted.begin(), candidate.sorted.begin() + static_cast<std::ptrdiff_t>(table.size));
    }
  }
  return candidates;
}

/// Appends the candidates without a twin, in their order. Twins are looked for among those with the same smallest node.
void append_single(const std::vector<Candidate>& candidates, std::size_t node_count, std::vector<OuterFacet>& outer) {
  std::vector<std::size_t> begin(node_count + 1, 0), place(candidates.size());
  for (const Candidate& c : candidates) ++begin[at(c.sorted[0]) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < candidates.size(); ++i) place[next[at(candidates[i].sorted[0])]++] = i;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const std::size_t node = at(candidates[i].sorted[0]);
    const auto first = place.begin() + static_cast<std::ptrdiff_t>(begin[node]);
    const auto last = place.begin() + static_cast<std::ptrdiff_t>(begin[node + 1]);
    const auto is_twin = [&](std::size_t j) { return candidates[j].sorted == candidates[i].sorted; };
    if (std::count_if(first, last, is_twin) == 1) outer.push_back(candidates[i].outer);
  }
}

}  // namespace

std::vector<OuterFacet> outer_facets(const Mesh& mesh) {
  const std::vector<std::uint8_t> dimensions = node_dimensions(mesh);
  std::vector<OuterFacet> outer;
  for (std::size_t block = 0; block < mesh.blocks.size(); ++block)
    append_single(facets_of(mesh, block, dimensions), mesh.node_count(), outer);
  return outer;
}

std::vector<Facet> skin(const Mesh& mesh) {
  const std::vector<OuterFacet> outer = outer_facets(mesh);
  std::vector<Facet> facets(outer.size());
  std::transform(outer.begin(), outer.end(), facets.begin(), [](const OuterFacet& o) { return o.facet; });
  return facets;
}

}  // namespace carom
