// The sets of a deck while it is read: nodes and elements by number and by name.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "deck/deck_cursor.hpp"
#include "deck/statements.hpp"
#include "mesh/deck_elements.hpp"
#include "mesh/mesh.hpp"
#include "mesh/node_numbers.hpp"

namespace carom {

/// An element of a deck; which of `cell` and `node` it has is said by its type.
struct DeckElement {
  const DeckElementType* type = nullptr;
  CellRef cell;                 ///< of a cell
  std::array<Index, 2> node{};  ///< of a point mass, rotary inertia or spring
  std::int64_t number = 0;      ///< as written
};

/// The cells of an *ELEMENT, or of a line of *ELGEN: from `begin` up to `end` of its block.
struct DeckCells {
  const DeckKeyword* keyword = nullptr;
  int scope = 0;
  CellRef begin;
  Index end = 0;
};

/// What a reader has to say of a place of the deck.
struct DeckNote {
  Location where;
  std::string text;
};

/// Sets of one kind, with the instance before their names, and the entries by their numbers in each scope.
class DeckSets {
 public:
  /// `entry`: "node" or "element", for messages; `keyword`: the parameter that names a set, "NSET".
  DeckSets(std::string entry, std::string parameter) : entry_(std::move(entry)), parameter_(std::move(parameter)) {}

  /// Room for about so many numbers in each scope.
  void expect(const std::vector<std::size_t>& counts);
  /// False when the number is there already.
  bool insert(int scope, std::int64_t number, Index index) {
    highest_[at(scope)] = std::max(highest_[at(scope)], number);
    return numbers_[at(scope)].insert(number, index);
  }
  Index find(int scope, std::int64_t number) const { return numbers_[at(scope)].find(number); }

  std::vector<Index>& set(const std::string& name) { return sets_[name]; }
  const std::map<std::string, std::vector<Index>>& all() const { return sets_; }
  /// *NSET or *ELSET: its data lines, appended to the set.
  void read(const Statement& statement, const Statements& statements, std::vector<DeckNote>& notes);
  /// The entries of a name or number as written in a data line ("TOP", "5", "PART-1-1.5"); nullptr where there is none.
  const std::vector<Index>* entries(std::string_view text, int scope, const Statements& statements);

 private:
  void append_range(DeckCursor& at, const std::string& name, int scope, std::vector<Index>& to,
                    std::vector<DeckNote>& notes) const;

  std::string entry_, parameter_;
  std::vector<NodeNumbers> numbers_;   ///< by scope
  std::vector<std::int64_t> highest_;  ///< by scope
  std::map<std::string, std::vector<Index>> sets_;
  std::vector<Index> single_;
};

}  // namespace carom
