// What a translation has to say: notes, and what it cannot carry over.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "deck/deck.hpp"

namespace carom {

/// Collects what is not carried over. What changes the physics is refused, all of it in one message, unless the user
/// has accepted the keyword; then it is a note.
class Findings {
 public:
  /// Accepted keywords in any case, with or without blanks.
  explicit Findings(const std::vector<std::string>& accepted);

  void note(const Location& where, const std::string& text);
  /// `what` of the keyword is not carried over; `consequence` says what that means.
  void refuse(const DeckKeyword& keyword, const Location& where, const std::string& what,
              const std::string& consequence);
  /// Adds an error for each accepted word that is no keyword, and a note for each that nothing is refused of.
  void check_accepted(const Deck& deck, const std::string& source, CaseErrors& errors);
  /// Has something of this keyword been accepted, or would it have to be?
  bool is_left_out(const std::string& keyword) const;
  bool empty() const { return refusals_.empty(); }
  /// CaseError that lists all refusals, what is wrong whatever is accepted (`errors`), and, where nothing is, what
  /// would be wrong with the deck when all is accepted (`rest`). Nothing where there is neither refusal nor error.
  void check(const std::string& source, const CaseErrors& errors, const CaseErrors& rest = {}) const;
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::vector<std::string> words_;  ///< accepted, as written
  std::set<std::string> accepted_;  ///< without blanks
  std::set<std::string> used_;      ///< accepted ones of which something is left out, without blanks
  std::vector<std::string> notes_, refusals_, keywords_;
};

}  // namespace carom
