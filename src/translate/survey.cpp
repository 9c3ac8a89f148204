// What is not understood of each keyword, by the table of keywords.
#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "deck/keyword_table.hpp"
#include "translate/translation.hpp"

namespace carom {

namespace {

/// Elements that go with the keyword of their properties.
void note_left_out(const DeckKeyword& keyword, Findings& findings) {
  const std::string* type = keyword.name == "ELEMENT" ? keyword.parameter("TYPE") : nullptr;
  const DeckElementType* known = type == nullptr ? nullptr : deck_element_type(upper_case(*type));
  if (known != nullptr && known->kind == DeckElementType::Kind::unknown)
    findings.note(keyword.where, fmt::format("{}: {}", known->name, known->remark));
}

std::string did_you_mean(const std::string& near, const char* before) {
  return near.empty() ? "" : fmt::format("Did you mean {}{}? ", before, near);
}

std::vector<std::string> parameters_of(const KeywordEntry& entry) {
  std::vector<std::string> names;
  for (std::string_view list : {entry.parameters, entry.noted})
    while (!list.empty()) {
      const std::size_t comma = std::min(list.find(','), list.size());
      names.emplace_back(list.substr(0, comma));
      list.remove_prefix(std::min(comma + 1, list.size()));
    }
  return names;
}

void survey_keyword(const DeckKeyword& keyword, Findings& findings) {
  const KeywordEntry* entry = find_keyword(keyword.name);
  if (entry == nullptr) {
    std::vector<std::string> names;
    for (const KeywordEntry& each : keyword_table()) names.emplace_back(each.name);
    findings.refuse(keyword, keyword.where, "an unknown keyword",
                    did_you_mean(nearest(keyword.name, names), "*") + "What it means would be lost.");
    return;
  }
  switch (entry->use) {
    case KeywordUse::refused_mesh:
      return;  // which the mesh has said
    case KeywordUse::refused:
      findings.refuse(keyword, keyword.where, "not carried out", std::string(entry->meaning));
      return;
    case KeywordUse::output:
    case KeywordUse::solver:
      findings.note(keyword.where, fmt::format("*{}: {}", keyword.name, entry->meaning));
      return;
    default:
      break;
  }
  note_left_out(keyword, findings);
  for (const DeckParameter& parameter : keyword.parameters) {
    if (is_listed(entry->parameters, parameter.name)) continue;
    if (is_listed(entry->noted, parameter.name))
      findings.note(keyword.where, fmt::format("*{}: {} changes nothing here", keyword.name, parameter.name));
    else
      findings.refuse(
          keyword, keyword.where, "the parameter " + parameter.name + " is not known",
          did_you_mean(nearest(parameter.name, parameters_of(*entry)), "") + "What it changes would be lost.");
  }
}

}  // namespace

void survey(Translation& t) {
  const DeckKeyword* last = nullptr;
  for (const Statement& s : t.statements.list) {
    if (s.keyword != last) survey_keyword(*s.keyword, t.findings);
    last = s.keyword;
  }
}

}  // namespace carom
