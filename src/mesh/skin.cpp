#include "mesh/skin.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>

#include "base/types.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/orientation.hpp"

namespace carom {

namespace {

constexpr Index none = std::numeric_limits<Index>::max();

/// A face of a cell, and its corners in increasing order, by which its twins are found; the rest none.
struct Candidate {
  CellRef cell;
  int face;
  std::array<Index, 4> sorted;
};

std::span<const Index> nodes_of(const Mesh& mesh, const CellRef& cell) {
  const CellBlock& block = mesh.blocks[at(cell.block)];
  const auto n = static_cast<std::size_t>(node_count(block.type));
  return std::span(block.connectivity).subspan(n * at(cell.cell), n);
}

/// Appends the faces of the cells of a block that may be on a skin.
void append_candidates(const Mesh& mesh, std::size_t block, std::span<const std::uint8_t> dimensions,
                       std::vector<Candidate>& candidates) {
  const CellBlock& cells = mesh.blocks[block];
  const std::span<const CellFace> faces = cell_faces(cells.type);
  candidates.reserve(candidates.size() + cells.size() * faces.size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const CellRef cell{static_cast<Index>(block), static_cast<Index>(k)};
    const std::span<const Index> nodes = nodes_of(mesh, cell);
    if (on_boundary(nodes, cells.type, dimensions) || has_zero_thickness(mesh, cells.type, nodes)) continue;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      Candidate candidate{cell, static_cast<int>(f), {none, none, none, none}};
      const std::span<const LocalNode> corners = faces[f].corners();
      std::transform(corners.begin(), corners.end(), candidate.sorted.begin(), [&](LocalNode a) { return nodes[a]; });
      const auto end = candidate.sorted.begin() + static_cast<std::ptrdiff_t>(corners.size());
      if (on_boundary({candidate.sorted.begin(), end}, cells.type, dimensions)) continue;  // it ends in a body
      std::sort(candidate.sorted.begin(), candidate.sorted.end());
      candidates.push_back(candidate);
    }
  }
}

/// Appends the linear facets of a face.
void append_facets(const Mesh& mesh, const Candidate& candidate, std::vector<OuterFacet>& outer) {
  const std::span<const Index> nodes = nodes_of(mesh, candidate.cell);
  const CellFace& face =
      cell_faces(mesh.blocks[at(candidate.cell.block)].type)[static_cast<std::size_t>(candidate.face)];
  for (const FacePiece& piece : face_pieces(face.type)) {
    Facet facet{{-1, -1, -1, -1}, piece.size};
    for (std::size_t a = 0; a < static_cast<std::size_t>(piece.size); ++a)
      facet.node[a] = nodes[face.node[piece.node[a]]];
    outer.push_back({facet, candidate.cell, candidate.face});
  }
}

/// The candidates without a twin, in their order. Twins are looked for among those with the same smallest node.
std::vector<Candidate> single(const std::vector<Candidate>& candidates, std::size_t node_count) {
  std::vector<std::size_t> begin(node_count + 1, 0), place(candidates.size());
  for (const Candidate& c : candidates) ++begin[at(c.sorted[0]) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < candidates.size(); ++i) place[next[at(candidates[i].sorted[0])]++] = i;
  std::vector<Candidate> found;
  for (const Candidate& candidate : candidates) {
    const std::size_t node = at(candidate.sorted[0]);
    const auto first = place.begin() + static_cast<std::ptrdiff_t>(begin[node]);
    const auto last = place.begin() + static_cast<std::ptrdiff_t>(begin[node + 1]);
    const auto is_twin = [&](std::size_t j) { return candidates[j].sorted == candidate.sorted; };
    if (std::count_if(first, last, is_twin) == 1) found.push_back(candidate);
  }
  return found;
}

}  // namespace

std::vector<OuterFacet> outer_facets(const Mesh& mesh) {
  const std::vector<std::uint8_t> dimensions = node_dimensions(mesh);
  std::vector<Candidate> candidates;
  for (std::size_t block = 0; block < mesh.blocks.size(); ++block)
    append_candidates(mesh, block, dimensions, candidates);
  std::vector<OuterFacet> outer;
  for (const Candidate& candidate : single(candidates, mesh.node_count())) append_facets(mesh, candidate, outer);
  return outer;
}

std::vector<Facet> skin(const Mesh& mesh) {
  const std::vector<OuterFacet> outer = outer_facets(mesh);
  std::vector<Facet> facets(outer.size());
  std::transform(outer.begin(), outer.end(), facets.begin(), [](const OuterFacet& o) { return o.facet; });
  return facets;
}

}  // namespace carom
