#include "mesh/skin.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "base/types.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/face_twins.hpp"
#include "mesh/orientation.hpp"

namespace carom {

namespace {

/// The faces of all cells by number, block after block; those that cannot be on a skin are flagged.
class CellFaces {
 public:
  explicit CellFaces(const Mesh& mesh) : mesh_(mesh) {
    std::size_t first = 0;
    for (const CellBlock& block : mesh.blocks) {
      blocks_.push_back({&block, cell_faces(block.type), first});
      first += block.size() * blocks_.back().faces.size();
    }
    is_out_.resize(first);
    const std::vector<std::uint8_t> dimensions = node_dimensions(mesh);
    for (const Block& block : blocks_) flag(block, dimensions);
  }

  std::size_t size() const { return is_out_.size(); }
  bool is_out(std::size_t i) const { return is_out_[i]; }
  /// Faces of a cell of the largest block.
  std::size_t per_cell() const {
    const auto largest = std::max_element(blocks_.begin(), blocks_.end(), [](const Block& a, const Block& b) {
      return a.cells->size() < b.cells->size();
    });
    return largest == blocks_.end() ? 0 : largest->faces.size();
  }
  /// The cell and its face.
  std::pair<CellRef, int> at_number(std::size_t i) const {
    const Block& block = block_of(i);
    const std::size_t own = i - block.first;
    return {{static_cast<Index>(&block - blocks_.data()), static_cast<Index>(own / block.faces.size())},
            static_cast<int>(own % block.faces.size())};
  }
  FaceKey key(std::size_t i) const {
    if (is_out_[i]) return no_face;
    const Block& block = block_of(i);
    const std::size_t own = i - block.first;
    std::array<Index, 4> corner;
    return face_key(corners(block.faces[own % block.faces.size()],
                            block.cells->nodes(static_cast<Index>(own / block.faces.size())), corner));
  }

 private:
  struct Block {
    const CellBlock* cells;
    std::span<const CellFace> faces;
    std::size_t first;  ///< number of its first face
  };

  const Block& block_of(std::size_t i) const {
    std::size_t b = blocks_.size() - 1;
    while (blocks_[b].first > i || blocks_[b].faces.empty()) --b;
    return blocks_[b];
  }
  static std::span<const Index> corners(const CellFace& face, std::span<const Index> nodes,
                                        std::array<Index, 4>& corner) {
    const std::span<const LocalNode> local = face.corners();
    for (std::size_t a = 0; a < local.size(); ++a) corner[a] = nodes[local[a]];
    return {corner.data(), local.size()};
  }
  void flag(const Block& block, std::span<const std::uint8_t> dimensions) {
    const CellType type = block.cells->type;
    const std::size_t faces = block.faces.size();
    const bool may_end_in_others = dimension(type) < 3;
    for (std::size_t k = 0; k < block.cells->size() && faces > 0; ++k) {
      const std::span<const Index> nodes = block.cells->nodes(static_cast<Index>(k));
      const bool none =
          (may_end_in_others && on_boundary(nodes, type, dimensions)) || has_zero_thickness(mesh_, type, nodes);
      if (!none && !may_end_in_others) continue;
      for (std::size_t f = 0; f < faces; ++f) {
        std::array<Index, 4> corner;
        is_out_[block.first + faces * k + f] =
            none || on_boundary(corners(block.faces[f], nodes, corner), type, dimensions);
      }
    }
  }

  const Mesh& mesh_;
  std::vector<Block> blocks_;
  std::vector<bool> is_out_;
};

std::vector<std::uint32_t> twins(const Mesh& mesh, const CellFaces& faces) {
  return face_twins(
      faces.size(), faces.per_cell(), [&](std::size_t i) { return faces.key(i); }, mesh.node_count());
}

}  // namespace

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

std::vector<OuterFacet> outer_facets(const Mesh& mesh) {
  const CellFaces faces(mesh);
  const std::vector<std::uint32_t> twin = twins(mesh, faces);
  std::vector<OuterFacet> outer;
  for (std::size_t i = 0; i < twin.size(); ++i) {
    if (twin[i] != no_twin || faces.is_out(i)) continue;
    const auto [cell, face] = faces.at_number(i);
    append_facets(mesh, cell, face, outer);
  }
  return outer;
}

std::vector<SharedFace> shared_faces(const Mesh& mesh, const std::function<bool(const CellRef&)>& is_wanted) {
  const CellFaces faces(mesh);
  const std::vector<std::uint32_t> twin = twins(mesh, faces);
  std::vector<SharedFace> shared;
  for (std::size_t i = 0; i < twin.size(); ++i) {
    if (twin[i] == no_twin || faces.is_out(i)) continue;
    const auto [cell, face] = faces.at_number(i);
    if (!is_wanted(cell)) continue;
    const auto [other, other_face] = faces.at_number(twin[i]);
    shared.push_back({cell, face, other, other_face});
  }
  return shared;
}

std::vector<Facet> skin(const Mesh& mesh) {
  const std::vector<OuterFacet> outer = outer_facets(mesh);
  std::vector<Facet> facets(outer.size());
  std::transform(outer.begin(), outer.end(), facets.begin(), [](const OuterFacet& o) { return o.facet; });
  return facets;
}

}  // namespace carom
