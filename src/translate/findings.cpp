#include "translate/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "deck/keyword_table.hpp"

namespace carom {

namespace {

/// The name of a keyword as the table has it, where it has it.
std::string keyword_of(const std::string& word) {
  const std::string text = upper_case(word.starts_with('*') ? word.substr(1) : word);
  const KeywordEntry* entry = find_keyword(text);
  return entry != nullptr ? std::string(entry->name) : text;
}

std::string lines_of(const CaseErrors& errors) {
  std::string text;
  for (const CaseError& error : errors.all()) text += fmt::format("\n  {}", error.what());
  return text;
}

}  // namespace

Findings::Findings(const std::vector<std::string>& accepted) : words_(accepted) {
  for (const std::string& word : accepted) accepted_.insert(without_blanks(keyword_of(word)));
}

void Findings::note(const Location& where, const std::string& text) {
  const std::string line = to_string(where) + ": " + text;
  if (std::find(notes_.begin(), notes_.end(), line) == notes_.end()) notes_.push_back(line);
}

void Findings::refuse(const DeckKeyword& keyword, const Location& where, const std::string& what,
                      const std::string& consequence) {
  const std::string line = fmt::format("*{}: {}. {}", keyword.name, what, consequence);
  const std::string name = without_blanks(keyword.name);
  if (accepted_.count(name) != 0) {
    used_.insert(name);
    return note(where, line + " (accepted)");
  }
  const std::string placed = to_string(where) + ": " + line;
  if (std::find(refusals_.begin(), refusals_.end(), placed) == refusals_.end()) refusals_.push_back(placed);
  if (std::find(keywords_.begin(), keywords_.end(), keyword.name) == keywords_.end()) keywords_.push_back(keyword.name);
}

bool Findings::is_left_out(const std::string& keyword) const {
  return used_.count(without_blanks(keyword)) != 0 ||
         std::find(keywords_.begin(), keywords_.end(), keyword) != keywords_.end();
}

void Findings::check_accepted(const Deck& deck, const std::string& source, CaseErrors& errors) {
  std::vector<std::string> names;
  for (const DeckKeyword& keyword : deck.keywords) names.push_back(keyword.name);
  for (const std::string& word : words_) {
    const std::string name = keyword_of(word);
    if (used_.count(without_blanks(name)) != 0) continue;
    const bool is_keyword = find_keyword(name) != nullptr ||
                            std::any_of(names.begin(), names.end(),
                                        [&](const auto& n) { return without_blanks(n) == without_blanks(name); });
    if (is_keyword) {
      note({source, 0, 0}, fmt::format("--accept {}: nothing of the deck has to be accepted for it", name));
      continue;
    }
    for (const KeywordEntry& entry : keyword_table()) names.emplace_back(entry.name);
    const std::string near = nearest(name, names);
    errors.add(CaseError({source, 0, 0}, "--accept", "\"" + word + "\"", "names of keywords",
                         near.empty() ? "" : fmt::format("Did you mean \"{}\"?", near)));
  }
}

void Findings::check(const std::string& source, const CaseErrors& errors, const CaseErrors& rest) const {
  if (refusals_.empty()) return errors.check();
  std::string what = refusals_.size() == 1 ? "something" : fmt::format("{} things", refusals_.size());
  what += " that Carom does not carry over";
  if (!errors.empty()) what += fmt::format(", and {} that {} wrong", errors.size(), errors.size() == 1 ? "is" : "are");
  std::string text =
      fmt::format("--accept \"{}\" runs without:\n  {}", fmt::join(keywords_, ","), fmt::join(refusals_, "\n  "));
  if (!errors.empty()) text += "\nTo be changed whatever is accepted:" + lines_of(errors);
  if (!rest.empty()) text += "\nAccepted, the rest would still be refused:" + lines_of(rest);
  throw CaseError({source, 0, 0}, "", what, "a deck that loses nothing of its physics", text);
}

}  // namespace carom
