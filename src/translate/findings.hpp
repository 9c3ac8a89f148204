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
  bool accepts(const std::string& keyword) const;
  /// CaseError that lists all refusals, if there is one; also for accepted names that no keyword of the deck has.
  void check(const std::string& source) const;
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::set<std::string> accepted_;  ///< without blanks
  std::vector<std::string> notes_, refusals_, keywords_;
  Location first_;
};

}  // namespace carom
