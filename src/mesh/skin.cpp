#include "mesh/skin.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

#include "base/types.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/face_twins.hpp"
#include "mesh/orientation.hpp"

namespace carom {

namespace {

/// The faces of cells that may be on a skin.
struct Candidates {
  std::vector<FaceKey> key;
  std::vector<CellRef> cell;
  std::vector<std::uint8_t> face;

  void reserve(const Mesh& mesh) {
    std::size_t most = 0;
    for (const CellBlock& block : mesh.blocks) most += block.size() * cell_faces(block.type).size();
    key.reserve(most);
    cell.reserve(most);
    face.reserve(most);
  }
};

/// Appends the faces of the cells of a block.
void append_candidates(const Mesh& mesh, std::size_t block, std::span<const std::uint8_t> dimensions,
                       Candidates& candidates) {
  const CellBlock& cells = mesh.blocks[block];
  const std::span<const CellFace> faces = cell_faces(cells.type);
  const bool may_end_in_others = dimension(cells.type) < 3;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const CellRef cell{static_cast<Index>(block), static_cast<Index>(k)};
    const std::span<const Index> nodes = cells.nodes(cell.cell);
    if (may_end_in_others && on_boundary(nodes, cells.type, dimensions)) continue;
    if (has_zero_thickness(mesh, cells.type, nodes)) continue;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      std::array<Index, 4> corner;
      const std::span<const LocalNode> local = faces[f].corners();
      for (std::size_t a = 0; a < local.size(); ++a) corner[a] = nodes[local[a]];
      const std::span<const Index> corners(corner.data(), local.size());
      if (may_end_in_others && on_boundary(corners, cells.type, dimensions)) continue;
      candidates.key.push_back(face_key(corners));
      candidates.cell.push_back(cell);
      candidates.face.push_back(static_cast<std::uint8_t>(f));
    }
  }
}

/// Appends the linear facets of a face.
void append_facets(const Mesh& mesh, const CellRef& cell, int number, std::vector<OuterFacet>& outer) {
  const CellBlock& block = mesh.blocks[at(cell.block)];
  const std::span<const Index> nodes = block.nodes(cell.cell);
  const CellFace& face = cell_faces(block.type)[static_cast<std::size_t>(number)];
  for (const FacePiece& piece : face_pieces(face.type)) {
    Facet facet{{-1, -1, -1, -1}, piece.size};
    for (std::size_t a = 0; a < static_cast<std::size_t>(piece.size); ++a)
      facet.node[a] = nodes[face.node[piece.node[a]]];
    outer.push_back({facet, cell, number});
  }
}

}  // namespace

std::vector<OuterFacet> outer_facets(const Mesh& mesh) {
  const std::vector<std::uint8_t> dimensions = node_dimensions(mesh);
  Candidates candidates;
  candidates.reserve(mesh);
  for (std::size_t block = 0; block < mesh.blocks.size(); ++block)
    append_candidates(mesh, block, dimensions, candidates);
  const std::vector<std::uint32_t> twin = face_twins(candidates.key, mesh.node_count());
  std::vector<OuterFacet> outer;
  for (std::size_t i = 0; i < twin.size(); ++i)
    if (twin[i] == no_twin) append_facets(mesh, candidates.cell[i], candidates.face[i], outer);
  return outer;
}

std::vector<Facet> skin(const Mesh& mesh) {
  const std::vector<OuterFacet> outer = outer_facets(mesh);
  std::vector<Facet> facets(outer.size());
  std::transform(outer.begin(), outer.end(), facets.begin(), [](const OuterFacet& o) { return o.facet; });
  return facets;
}

}  // namespace carom
