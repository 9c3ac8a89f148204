// The skins of bodies, and their bars, as pieces with edges, neighbours and bodies.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/facet.hpp"
#include "model/model.hpp"

namespace carom {

/// Facets of the skins of solids and plane bodies (mesh/skin.hpp), quadratic ones through their mid-side nodes, and the
/// cells of bars. Nodes have numbers of their own. Nodes and pieces stand body after body; a body is what cells of
/// parts connect by common nodes.
struct SkinPieces {
  struct Piece {
    Facet facet;  ///< numbers of this skin; segments of plane bodies have the body on their left
    std::array<Index, 4> edge{-1, -1, -1, -1};
    CellRef cell;
    Index body = -1;
    double length = 0.0;   ///< cell_length of its cell, in the reference position
    bool is_line = false;  ///< a bar, which has no inside
  };
  struct Edge {
    std::array<Index, 2> node{-1, -1}, piece{-1, -1};  ///< the piece of lower number first
  };

  explicit SkinPieces(const Model& model);

  /// The pieces at a node.
  std::span<const Index> at(Index node) const {
    const auto n = static_cast<std::size_t>(node);
    return {pieces_at.data() + first_at[n], static_cast<std::size_t>(first_at[n + 1] - first_at[n])};
  }
  /// The pieces that belong to a node of piece p, p among them, without bars; increasing.
  void ring(Index p, std::vector<Index>& found) const;
  std::size_t body_count() const { return first_node_of_body.size() - 1; }

  std::vector<Index> nodes;  ///< numbers of the mesh
  std::vector<Piece> pieces;
  std::vector<Edge> edges;
  std::vector<Index> first_node_of_body, first_piece_of_body;  ///< one more than bodies
  std::vector<Index> first_at, pieces_at;

 private:
  void take_pieces(const Model& model);
  void sort_by_body(const Mesh& mesh, std::span<const Index> body);
  void number_nodes(const Mesh& mesh, std::span<const Index> body);
  void find_edges();
  void find_pieces_at_nodes();
};

}  // namespace carom
