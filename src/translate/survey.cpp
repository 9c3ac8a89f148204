// What is not understood of each keyword, by the table of keywords.
#include <fmt/format.h>

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

void survey_keyword(const DeckKeyword& keyword, Findings& findings) {
  const KeywordEntry* entry = find_keyword(keyword.name);
  if (keyword.name == "KEYWORD") refuse_dyna(keyword.where);
  if (entry == nullptr) {
    findings.refuse(keyword, keyword.where, "an unknown keyword", "What it means would be lost.");
    return;
  }
  switch (entry->use) {
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
      findings.refuse(keyword, keyword.where, "the parameter " + parameter.name + " is not known",
                      "What it changes would be lost.");
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
