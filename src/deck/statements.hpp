// The keywords of a deck as they act: those of a part once for each of its instances.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "deck/deck.hpp"

namespace carom {

/// Where an instance stands: shifted, then turned about the line from a to b, by the right hand.
struct Placement {
  Vec3 shift{};
  struct Turn {
    Vec3 a{}, b{};
    double degrees = 0.0;
  };
  std::optional<Turn> turn;

  Vec3 of(const Vec3& x) const;
};

/// What names and numbers belong to: the deck itself, or an instance, whose names begin with "INSTANCE.".
struct DeckScope {
  std::string prefix;
  Placement placement;
};

struct Statement {
  const DeckKeyword* keyword = nullptr;
  int scope = 0;
};

struct Statements {
  std::vector<DeckScope> scopes;  ///< the first is that of the deck
  std::vector<Statement> list;

  /// The scope of an instance by its name in upper case, or -1.
  int instance(const std::string& name) const;
};

/// Takes parts and instances apart. The deck must outlive the result. Throws CaseError where they are not closed, not
/// known or given twice.
Statements statements_of(const Deck& deck);

}  // namespace carom
