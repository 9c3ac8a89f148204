// *NGEN and *ELGEN: nodes on lines between others, and elements that repeat others.
#pragma once

#include <cstdint>
#include <vector>

#include "deck/statements.hpp"
#include "mesh/deck_sets.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// Adds to the mesh and the sets of a deck while it is read. Throws CaseError at the line.
class DeckGenerator {
 public:
  DeckGenerator(const Statements& statements, Mesh& mesh, std::vector<DeckElement>& elements, DeckSets& node_sets,
                DeckSets& element_sets)
      : statements_(statements), mesh_(mesh), elements_(elements), node_sets_(node_sets), element_sets_(element_sets) {}

  /// *NGEN: the numbers from the first to the last by the increment, evenly on the straight line between the two. The
  /// numbers of the instance count on from `offset`; `largest` grows to those in the mesh.
  void add_nodes(const Statement& s, std::int64_t offset, std::int64_t& largest);

  /// *ELGEN: copies of an element in a row, rows in a layer and layers, whose numbers and those of their nodes grow by
  /// increments. What a line has made is appended to `read`.
  void add_elements(const Statement& s, std::int64_t offset, std::int64_t& largest, std::vector<DeckCells>& read);

 private:
  struct Copies {
    std::int64_t count = 1, nodes = 1, elements = 1;  ///< increments of their numbers
  };
  static Copies copies_of(DeckCursor& at, const char* what);
  /// A copy whose nodes have numbers larger by `nodes`.
  void add_copy(DeckCursor& at, const Statement& s, const DeckElement& master, std::int64_t number, std::int64_t nodes,
                std::int64_t offset);
  /// What is added to the numbers that an instance writes.
  std::int64_t node_offset(int scope) const {
    return scope == 0 ? 0 : mesh_.node_instances[static_cast<std::size_t>(scope) - 1].after;
  }

  const Statements& statements_;
  Mesh& mesh_;
  std::vector<DeckElement>& elements_;
  DeckSets &node_sets_, &element_sets_;
};

}  // namespace carom
