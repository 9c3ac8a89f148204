// Faces of the elements of a deck as cells of their own.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "deck/deck_cursor.hpp"
#include "mesh/deck_sets.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// The block of this type, made where there is none.
std::size_t block_of(Mesh& mesh, CellType type);

/// Is it a cell of a part?
bool deforms(const DeckElement& element);

/// Adds faces to a mesh, each once.
class DeckFaces {
 public:
  DeckFaces(Mesh& mesh, const std::vector<DeckElement>& elements) : mesh_(mesh), elements_(elements) {}

  /// Appends the faces `label` of these elements to `to`: "S3" the third as Abaqus counts (docs/decks.md), which is
  /// also the order of cell_faces; "SPOS" and "SNEG" the cells themselves, where these are faces, their
  /// nodes in the order of that side; "" those of the cells that are on the outside of the mesh, or the cells
  /// themselves as "SPOS". New cells are numbered from last + 1 on. Errors are thrown at the place of the cursor.
  void append(const std::vector<Index>& elements, const std::string& label, const DeckCursor& at,
              std::vector<CellRef>& to, std::int64_t& last);
  /// The faces on the outside of the mesh all of whose nodes are given.
  std::vector<CellRef> between(const std::vector<Index>& nodes, std::int64_t& last);
  /// True when bars have all their nodes among these, and no other cells have.
  bool bars_alone_between(const std::vector<Index>& nodes) const;
  /// Does the SPOS side of that face among these which is nearest to the middle of the bodies look there?
  bool looks_at_bodies(const std::vector<Index>& elements) const;

 private:
  CellRef face(const CellRef& cell, std::size_t number, std::int64_t& last);
  CellRef side(const CellRef& cell, bool is_negative, std::int64_t& last);
  const std::vector<std::uint32_t>& outer(const CellRef& cell);

  Mesh& mesh_;
  const std::vector<DeckElement>& elements_;
  std::unordered_map<std::uint64_t, CellRef> made_;                      ///< by element and face
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> outer_;  ///< by cell: its faces on the outside
  std::unordered_map<std::uint64_t, bool> is_turned_;  ///< cells that are faces: their nodes are in the other order
  bool knows_outer_ = false;
};

}  // namespace carom
