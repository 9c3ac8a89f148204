#include "translate/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "deck/keyword_table.hpp"

namespace carom {

Findings::Findings(const std::vector<std::string>& accepted) {
  for (const std::string& name : accepted)
    accepted_.insert(without_blanks(name.starts_with('*') ? std::string_view(name).substr(1) : std::string_view(name)));
}

void Findings::note(const Location& where, const std::string& text) {
  const std::string line = to_string(where) + ": " + text;
  if (std::find(notes_.begin(), notes_.end(), line) == notes_.end()) notes_.push_back(line);
}

bool Findings::accepts(const std::string& keyword) const {
  return accepted_.count(without_blanks(keyword)) != 0;
}

void Findings::refuse(const DeckKeyword& keyword, const Location& where, const std::string& what,
                      const std::string& consequence) {
  const std::string line = fmt::format("*{}: {}. {}", keyword.name, what, consequence);
  if (accepts(keyword.name)) return note(where, line + " (accepted)");
  if (refusals_.empty()) first_ = where;
  refusals_.push_back(to_string(where) + ": " + line);
  if (std::find(keywords_.begin(), keywords_.end(), keyword.name) == keywords_.end()) keywords_.push_back(keyword.name);
}

void Findings::check(const std::string& source) const {
  if (refusals_.empty()) return;
  throw CaseError(
      {source, 0, 0}, "",
      fmt::format("{} that Carom does not carry over",
                  refusals_.size() == 1 ? "something" : fmt::format("{} things", refusals_.size())),
      "a deck that loses nothing of its physics",
      fmt::format("--accept \"{}\" runs without:\n  {}", fmt::join(keywords_, ","), fmt::join(refusals_, "\n  ")));
}

}  // namespace carom
