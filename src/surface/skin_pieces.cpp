#include "surface/skin_pieces.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "math/vec3.hpp"
#include "mesh/cell_size.hpp"
#include "mesh/cell_topology.hpp"
#include "model/bodies.hpp"
#include "model/outer_facets.hpp"

namespace carom {
namespace {

double reference_length(const Mesh& mesh, const CellRef& cell) {
  const CellBlock& block = mesh.blocks[static_cast<std::size_t>(cell.block)];
  const std::span<const Index> own = block.nodes(cell.cell);
  std::array<Vec3, most_nodes> x;
  for (std::size_t a = 0; a < own.size(); ++a) x[a] = mesh.coordinates[static_cast<std::size_t>(own[a])];
  return cell_length(block.type, std::span(x).first(own.size()));
}

/// Turns a segment so that its cell is on the left.
void turn_to_left(const Mesh& mesh, SkinPieces::Piece& piece) {
  const CellBlock& block = mesh.blocks[static_cast<std::size_t>(piece.cell.block)];
  const auto at = [&](Index n) { return mesh.coordinates[static_cast<std::size_t>(n)]; };
  Vec3 centre{};
  const auto corners = static_cast<std::size_t>(corner_count(block.type));
  for (const Index n : block.nodes(piece.cell.cell).first(corners))
    centre = add(centre, scaled(at(n), 1.0 / static_cast<double>(corners)));
  const Vec3 along = subtract(at(piece.facet[1]), at(piece.facet[0])), in = subtract(centre, at(piece.facet[0]));
  if (along[0] * in[1] - along[1] * in[0] < 0.0) std::swap(piece.facet.node[0], piece.facet.node[1]);
}

}  // namespace

SkinPieces::SkinPieces(const Model& model) {
  const std::vector<Index> body = bodies_of_nodes(model);
  take_pieces(model);
  sort_by_body(*model.mesh, body);
  number_nodes(*model.mesh, body);
  find_edges();
  find_pieces_at_nodes();
}

/// With node numbers of the mesh.
void SkinPieces::take_pieces(const Model& model) {
  const Mesh& mesh = *model.mesh;
  std::vector<std::vector<bool>> is_in_part;
  for (const CellBlock& block : mesh.blocks) is_in_part.emplace_back(block.size(), false);
  for (const Part& part : model.parts) {
    if (part.cells.empty()) continue;
    const auto b = static_cast<Index>(mesh.block(part.type) - mesh.blocks.data());
    for (const Index cell : part.cells) {
      is_in_part[static_cast<std::size_t>(b)][static_cast<std::size_t>(cell)] = true;
      if (dimension(part.type) != 1) continue;
      const std::span<const Index> own = mesh.block(part.type)->nodes(cell);
      for (const FacePiece& line : face_pieces(part.type)) {
        Piece piece{.facet = {{own[line.node[0]], own[line.node[1]], -1, -1}, 2}, .cell = {b, cell}, .is_line = true};
        pieces.push_back(piece);
      }
    }
  }
  const auto skin = outer_facets(model);
  for (const OuterFacet& outer : *skin) {
    const auto& block = mesh.blocks[static_cast<std::size_t>(outer.cell.block)];
    if (dimension(block.type) < 2) continue;
    if (!is_in_part[static_cast<std::size_t>(outer.cell.block)][static_cast<std::size_t>(outer.cell.cell)]) continue;
    Piece piece{.facet = outer.facet, .cell = outer.cell};
    if (outer.facet.size == 2) turn_to_left(mesh, piece);
    pieces.push_back(piece);
  }
  for (Piece& piece : pieces) piece.length = reference_length(mesh, piece.cell);
}

void SkinPieces::sort_by_body(const Mesh& mesh, std::span<const Index> body) {
  const auto body_of = [&](const Piece& piece) { return body[static_cast<std::size_t>(piece.facet[0])]; };
  std::stable_sort(pieces.begin(), pieces.end(),
                   [&](const Piece& a, const Piece& b) { return body_of(a) < body_of(b); });
  std::vector<Index> number(mesh.node_count(), -1);
  Index bodies = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    Index& own = number[static_cast<std::size_t>(body_of(pieces[p]))];
    if (own < 0) {
      own = bodies++;
      first_piece_of_body.push_back(static_cast<Index>(p));
    }
    pieces[p].body = own;
  }
  first_piece_of_body.push_back(static_cast<Index>(pieces.size()));
}

void SkinPieces::number_nodes(const Mesh& mesh, std::span<const Index> body) {
  for (const Piece& piece : pieces) nodes.insert(nodes.end(), piece.facet.begin(), piece.facet.end());
  const auto key = [&](Index n) { return std::pair(body[static_cast<std::size_t>(n)], n); };
  std::sort(nodes.begin(), nodes.end(), [&](Index a, Index b) { return key(a) < key(b); });
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<Index> number(mesh.node_count(), -1);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    number[static_cast<std::size_t>(nodes[k])] = static_cast<Index>(k);
    if (k == 0 || key(nodes[k]).first != key(nodes[k - 1]).first) first_node_of_body.push_back(static_cast<Index>(k));
  }
  first_node_of_body.push_back(static_cast<Index>(nodes.size()));
  for (Piece& piece : pieces)
    for (std::size_t a = 0; a < static_cast<std::size_t>(piece.facet.size); ++a)
      piece.facet.node[a] = number[static_cast<std::size_t>(piece.facet.node[a])];
}

void SkinPieces::find_edges() {
  struct Side {
    std::array<Index, 2> node;
    Index piece;
    std::size_t local;
  };
  std::vector<Side> sides;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Facet& facet = pieces[p].facet;
    const auto n = static_cast<std::size_t>(facet.size), count = n == 2 ? 1 : n;
    for (std::size_t a = 0; a < count; ++a) {
      const Index i = facet[a], j = facet[(a + 1) % n];
      sides.push_back({{std::min(i, j), std::max(i, j)}, static_cast<Index>(p), a});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.node, a.piece, a.local) < std::tie(b.node, b.piece, b.local);
  });
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (s == 0 || sides[s].node != sides[s - 1].node)
      edges.push_back({sides[s].node, {sides[s].piece, -1}});
    else if (edges.back().piece[1] < 0)
      edges.back().piece[1] = sides[s].piece;
    pieces[static_cast<std::size_t>(sides[s].piece)].edge[sides[s].local] = static_cast<Index>(edges.size()) - 1;
  }
}

void SkinPieces::find_pieces_at_nodes() {
  first_at.assign(nodes.size() + 1, 0);
  for (const Piece& piece : pieces)
    for (const Index n : piece.facet) ++first_at[static_cast<std::size_t>(n) + 1];
  std::partial_sum(first_at.begin(), first_at.end(), first_at.begin());
  pieces_at.resize(static_cast<std::size_t>(first_at.back()));
  std::vector<Index> next = first_at;
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const Index n : pieces[p].facet)
      pieces_at[static_cast<std::size_t>(next[static_cast<std::size_t>(n)]++)] = static_cast<Index>(p);
}

void SkinPieces::ring(Index p, std::vector<Index>& found) const {
  found.clear();
  for (const Index n : pieces[static_cast<std::size_t>(p)].facet)
    for (const Index other : at(n))
      if (!pieces[static_cast<std::size_t>(other)].is_line) found.push_back(other);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

}  // namespace carom
