#include "mesh/deck_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/terminal_text.hpp"

namespace carom {

void DeckSets::expect(const std::vector<std::size_t>& counts) {
  for (const std::size_t count : counts) numbers_.emplace_back(count);
  highest_.assign(counts.size(), 0);
}

const std::vector<Index>* DeckSets::entries(std::string_view text, int scope, const Statements& statements) {
  const std::string name = deck_name(text);
  for (const std::string& key : {statements.scopes[at(scope)].prefix + name, name})
    if (const auto found = sets_.find(key); found != sets_.end()) return &found->second;
  const std::size_t dot = name.find('.');
  const int own = dot == std::string::npos ? scope : statements.instance(name.substr(0, dot));
  const auto number = as_integer(std::string_view(name).substr(dot == std::string::npos ? 0 : dot + 1));
  const Index index = own < 0 || !number ? -1 : find(own, *number);
  if (index < 0) return nullptr;
  single_.assign(1, index);
  return &single_;
}

/// Numbers that are no entries are left out with a note; a range without any is wrong.
void DeckSets::append_range(DeckCursor& at, const std::string& name, int scope, std::vector<Index>& to,
                            std::vector<DeckNote>& notes) const {
  const std::int64_t first = at.integer("the first number"), last = at.at_end() ? first : at.integer("the last number");
  const std::int64_t step = at.at_end() ? 1 : at.integer("the increment");
  constexpr std::int64_t most = 2'000'000'000;
  if (step < 1 || step > most || first < 0 || last < first || last > most)
    at.fail(fmt::format("{}, {}, {}", first, last, step), "first, last and a positive increment");
  const std::size_t before = to.size();
  for (std::int64_t number = first; number <= std::min(last, highest_[carom::at(scope)]); number += step) {
    const Index index = find(scope, number);
    if (index >= 0) to.push_back(index);
  }
  const std::size_t wanted = static_cast<std::size_t>((last - first) / step) + 1, found = to.size() - before;
  if (found == wanted) return;
  const std::string range = fmt::format("{} to {}{}", first, last, step == 1 ? "" : fmt::format(" by {}", step));
  if (found == 0)
    at.fail(fmt::format("the range {} for {}, none of which is the number of a{} {}", range, name,
                        entry_ == "element" ? "n" : "", entry_),
            fmt::format("numbers of {}s, the largest of which is {}", entry_, highest_[carom::at(scope)]),
            "Are the numbers those of another part or instance?");
  notes.push_back({at.where(), fmt::format("{}: {} of the {} numbers of the range {} are no {}s; left out", name,
                                           wanted - found, wanted, range, entry_)});
}

void DeckSets::read(const Statement& statement, const Statements& statements, std::vector<DeckNote>& notes) {
  const DeckKeyword& keyword = *statement.keyword;
  const std::string name = statements.scopes[at(statement.scope)].prefix + keyword.required(parameter_);
  int scope = statement.scope;
  if (keyword.has("INSTANCE")) {
    scope = statements.instance(keyword.required("INSTANCE"));
    if (scope < 0)
      keyword.fail(fmt::format("the unknown instance {}", keyword.required("INSTANCE")), "the NAME of an *INSTANCE");
  }
  std::vector<Index> found;
  for (DeckCursor at(keyword); at.next_line();) {
    if (keyword.has("GENERATE")) {
      append_range(at, name, scope, found, notes);
      continue;
    }
    while (!at.at_end()) {
      const std::string_view text = at.field();
      if (text.empty()) continue;
      const std::vector<Index>* more = entries(text, scope, statements);
      if (more == nullptr)
        at.fail(printable(text), fmt::format("the number of a{} {} or the name of a set before this one",
                                             entry_ == "element" ? "n" : "", entry_));
      found.insert(found.end(), more->begin(), more->end());
    }
  }
  std::vector<Index>& set = sets_[name];
  set.insert(set.end(), found.begin(), found.end());
  std::sort(set.begin(), set.end());  // a set that names itself would grow without end
  set.erase(std::unique(set.begin(), set.end()), set.end());
}

}  // namespace carom
