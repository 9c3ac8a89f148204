// A deck of Abaqus or CalculiX as a case.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "casefile/case.hpp"
#include "casefile/document.hpp"
#include "deck/deck.hpp"

namespace carom {

struct TranslatedDeck {
  Node tree;  ///< as read_toml would give it; places are those of the deck
  std::vector<std::string> notes;
};

/// Translates a deck into the tree of a case whose mesh is the deck itself. What is not carried over and changes the
/// physics is refused in one message unless its keyword is among `accepted`. Throws CaseError.
TranslatedDeck translate_deck(const std::string& path, const std::vector<std::string>& accepted);
/// The same from the bytes of a deck; `path` names it in messages.
TranslatedDeck translate_deck(std::string bytes, const std::string& path, const std::vector<std::string>& accepted,
                              const IncludeReader& include);

/// A case from a case file or a deck, told apart by how they begin.
struct ReadCase {
  Case given;
  std::vector<std::string> notes;  ///< of the translation
};
/// What others can say of a case that will not be run.
struct FurtherLooks {
  /// Adds what is wrong with the mesh of a case that is wrong elsewhere.
  std::function<void(const Case& partial, CaseErrors& errors)> at_wrong_case = [](const Case&, CaseErrors&) {};
  /// Throws what would be wrong with a deck if all that is not carried over were accepted.
  std::function<void(const Case& given)> at_refused_deck = [](const Case&) {};
};
ReadCase read_case_or_deck(const std::string& path, const std::vector<std::string>& accepted,
                           const FurtherLooks& looks = {});

}  // namespace carom
