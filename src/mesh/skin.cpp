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
    for (const CellBlock& block : mesh.blocks)
      first_.push_back(first_.back() + block.size() * cell_faces(block.type).size());
    is_out_.resize(first_.back());
    const std::vector<std::uint8_t> dimensions = node_dimensions(mesh);
    for (std::size_t block = 0; block < mesh.blocks.size(); ++block) flag(block, dimensions);
  }

  std::size_t size() const { return is_out_.size(); }
  bool is_out(std::size_t i) const { return is_out_[i]; }
  /// The cell and its face.
  std::pair<CellRef, int> at_number(std::size_t i) const {
    const auto block = static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), i) - first_.begin()) - 1;
    const std::size_t faces = cell_faces(mesh_.blocks[block].type).size(), own = i - first_[block];
    return {{static_cast<Index>(block), static_cast<Index>(own / faces)}, static_cast<int>(own % faces)};
  }
  FaceKey key(std::size_t i) const {
    if (is_out_[i]) return no_face;
    const auto [cell, face] = at_number(i);
    const CellBlock& block = mesh_.blocks[at(cell.block)];
    std::array<Index, 4> corner{};
    return face_key(corners(block, block.nodes(cell.cell), static_cast<std::size_t>(face), corner));
  }

 private:
  static std::span<const Index> corners(const CellBlock& block, std::span<const Index> nodes, std::size_t face,
                                        std::array<Index, 4>& corner) {
    const std::span<const LocalNode> local = cell_faces(block.type)[face].corners();
    for (std::size_t a = 0; a < local.size(); ++a) corner[a] = nodes[local[a]];
    return {corner.data(), local.size()};
  }
  void flag(std::size_t number, std::span<const std::uint8_t> dimensions) {
    const CellBlock& block = mesh_.blocks[number];
    const std::size_t faces = cell_faces(block.type).size();
    const bool may_end_in_others = dimension(block.type) < 3;
    for (std::size_t k = 0; k < block.size() && faces > 0; ++k) {
      const std::span<const Index> nodes = block.nodes(static_cast<Index>(k));
      const bool none = (may_end_in_others && on_boundary(nodes, block.type, dimensions)) ||
                        has_zero_thickness(mesh_, block.type, nodes);
      for (std::size_t f = 0; f < faces; ++f) {
        std::array<Index, 4> corner{};
        is_out_[first_[number] + faces * k + f] =
            none || (may_end_in_others && on_boundary(corners(block, nodes, f, corner), block.type, dimensions));
      }
    }
  }

  const Mesh& mesh_;
  std::vector<std::size_t> first_{0};
  std::vector<bool> is_out_;
};

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
  const CellFaces faces(mesh);
  const std::vector<std::uint32_t> twin = face_twins(
      faces.size(), [&](std::size_t i) { return faces.key(i); }, mesh.node_count());
  std::vector<OuterFacet> outer;
  for (std::size_t i = 0; i < twin.size(); ++i) {
    if (twin[i] != no_twin || faces.is_out(i)) continue;
    const auto [cell, face] = faces.at_number(i);
    append_facets(mesh, cell, face, outer);
  }
  return outer;
}

std::vector<Facet> skin(const Mesh& mesh) {
  const std::vector<OuterFacet> outer = outer_facets(mesh);
  std::vector<Facet> facets(outer.size());
  std::transform(outer.begin(), outer.end(), facets.begin(), [](const OuterFacet& o) { return o.facet; });
  return facets;
}

}  // namespace carom
