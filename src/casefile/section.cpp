#include "casefile/section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "casefile/write_toml.hpp"

namespace carom {

namespace {

/// The declaration of a key: the one of this kind where there are several; nullptr for an unknown key.
const KeyDescription* declared_key(const SectionDescription& section, const std::string& name,
                                   const std::string& kind) {
  const KeyDescription* other_kind = nullptr;
  for (const KeyDescription& key : section.keys) {
    if (key.key != name) continue;
    if (applies(key, kind)) return &key;
    other_kind = &key;
  }
  return other_kind;
}

std::vector<std::string> all_names(const SectionDescription& section) {
  std::vector<std::string> names;
  for (const KeyDescription& key : section.keys) {
    if (std::find(names.begin(), names.end(), key.key) == names.end()) names.push_back(key.key);
  }
  return names;
}

std::vector<std::string> names_for(const SectionDescription& section, const std::string& kind) {
  std::vector<std::string> names;
  for (const KeyDescription& key : section.keys) {
    if (applies(key, kind)) names.push_back(key.key);
  }
  return names;
}

/// The key that the user may have meant, by its name or by another name of the same thing; "" for none.
std::string suggested_key(const std::string& word, const SectionDescription& section) {
  std::string near = nearest(word, all_names(section));
  for (const KeyDescription& key : section.keys) {
    if (near.empty() && !nearest(word, key.options.aliases).empty()) near = key.key;
  }
  return near;
}

std::string plain_list(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// "[time]", "[[stage]]": the sections of the format that take a key of this name.
std::vector<std::string> sections_with(const std::string& name, const SectionDescription& format) {
  std::vector<std::string> sections;
  for (const KeyDescription& key : format.keys) {
    if (!key.section || declared_key(*key.section, name, "") == nullptr) continue;
    const bool is_list = key.shape == Shape::sections, is_named = key.shape == Shape::named_sections;
    sections.push_back(is_list    ? fmt::format("[[{}]]", key.key)
                       : is_named ? fmt::format("[{}.NAME]", key.key)
                                  : fmt::format("[{}]", key.key));
  }
  return sections;
}

/// The kind as far as it is written and right; "" otherwise.
std::string written_kind(const Node& node, const SectionDescription& section, const ReadContext& at) {
  if (section.selector.empty()) return "";
  const bool elsewhere = section.selector.find('.') != std::string::npos;
  const Node* value = find(elsewhere ? at.root : node, section.selector);
  const auto* text = value != nullptr ? std::get_if<std::string>(&value->value) : nullptr;
  if (text == nullptr) return value == nullptr ? section.default_kind : "";
  const auto has = [text](const std::vector<std::string>& words) {
    return std::find(words.begin(), words.end(), *text) != words.end();
  };
  const auto knows = [&](const KeyDescription& key) {
    return key.key == section.selector ? has(key.options.choices) : has(key.options.kinds);
  };
  return std::any_of(section.keys.begin(), section.keys.end(), knows) ? *text : "";
}

/// What may stand there: the keys of the section's kind, where that is known.
CaseError unknown_key(const Member& member, const Node& node, const SectionDescription& section,
                      const ReadContext& at) {
  const std::string kind = written_kind(node, section, at);
  const std::vector<std::string> names = kind.empty() ? all_names(section) : names_for(section, kind);
  const std::string near = suggested_key(member.key, section);
  const std::vector<std::string> elsewhere = sections_with(member.key, at.format);
  return CaseError(member.where, join(at.path, member.key), "an unknown key", "one of " + plain_list(names),
                   !near.empty()       ? fmt::format("Did you mean {}?", near)
                   : elsewhere.empty() ? ""
                                       : fmt::format("{} is a key of {}.", member.key, fmt::join(elsewhere, ", ")));
}

CaseError wrong_kind(const Member& member, const SectionDescription& section, const std::string& kind,
                     const ReadContext& at) {
  std::vector<std::string> kinds;
  for (const KeyDescription& key : section.keys) {
    if (key.key == member.key) kinds.insert(kinds.end(), key.options.kinds.begin(), key.options.kinds.end());
  }
  return CaseError(member.where, join(at.path, member.key),
                   fmt::format("a key that {} = {} does not take", section.selector, toml_string(kind)),
                   fmt::format("one of {}", plain_list(names_for(section, kind))),
                   fmt::format("It belongs to {} = {}.", section.selector, quoted_list(kinds)));
}

CaseError missing_key(const Node& node, const KeyDescription& key, const ReadContext& at) {
  return CaseError(node.where, join(at.path, key.key), "nothing", expected_text(key, at.units),
                   fmt::format("Add {}: {}", key.key, key.doc));
}

/// The kind as written; the value of a selector must be one of its choices before anything else is judged by it.
/// Nothing where it is wrong: of this section that is an error, elsewhere it is one already.
std::optional<std::string> find_kind(const Node& node, const SectionDescription& section, const ReadContext& at) {
  if (section.selector.empty()) return "";
  if (section.selector.find('.') != std::string::npos) {
    const Node* value = find(at.root, section.selector);
    const auto* text = value != nullptr ? std::get_if<std::string>(&value->value) : nullptr;
    const std::vector<CaseError>& errors = at.errors.all();
    const bool is_wrong = std::any_of(errors.begin(), errors.end(),
                                      [&](const CaseError& error) { return error.key() == section.selector; });
    return text == nullptr || is_wrong ? std::nullopt : std::optional(*text);
  }
  const Node* value = find(node, section.selector);
  const auto key = std::find_if(section.keys.begin(), section.keys.end(),
                                [&section](const KeyDescription& k) { return k.key == section.selector; });
  if (value != nullptr) return key->options.choices.at(decode_choice(*value, *key, at.at(key->key)));
  if (section.default_kind.empty()) throw missing_key(node, *key, at);
  return section.default_kind;
}

void check_alternatives(const Node& node, const Alternatives& alternatives, const ReadContext& at) {
  const Table& table = std::get<Table>(node.value);
  std::vector<std::string> given;
  for (const std::string& key : alternatives.keys) {
    if (table.find(key) != nullptr) given.push_back(key);
  }
  const bool exactly_one = alternatives.count == Alternatives::Count::exactly_one;
  if (given.size() == 1 || (!exactly_one && !given.empty())) return;
  throw CaseError(given.empty() ? node.where : table.find(given.back())->where, at.path,
                  given.empty() ? "none of " + plain_list(alternatives.keys)
                                : fmt::format("{} together", fmt::join(given, " and ")),
                  fmt::format("{} of {}", exactly_one ? "exactly one" : "at least one", plain_list(alternatives.keys)));
}

}  // namespace

bool same_but_kinds(const KeyDescription& a, const KeyDescription& b) {
  KeyOptions of_a = a.options;
  of_a.kinds = b.options.kinds;
  const auto initial = [](const KeyDescription& key) {
    return key.default_value ? toml_value(*key.default_value) : std::string{};
  };
  return a.key == b.key && a.shape == b.shape && a.doc == b.doc && of_a == b.options && a.section == b.section &&
         initial(a) == initial(b);
}

std::optional<std::string> check_section(const Node& node, const SectionDescription& section, const ReadContext& at) {
  const auto* table = std::get_if<Table>(&node.value);
  if (table == nullptr) {
    at.errors.add(CaseError(node.where, at.path, describe(node), "a table of keys"));
    return std::nullopt;
  }
  const std::size_t before = at.errors.size();
  for (const Member& member : table->members)
    if (declared_key(section, member.key, "") == nullptr) at.errors.add(unknown_key(member, node, section, at));
  std::optional<std::string> kind;
  at.errors.attempt([&] { kind = find_kind(node, section, at); });
  if (!kind) return kind;
  for (const Member& member : table->members) {
    const KeyDescription* key = declared_key(section, member.key, *kind);
    if (key != nullptr && !applies(*key, *kind)) at.errors.add(wrong_kind(member, section, *kind, at));
  }
  // A key that is missing may be one of those, misspelt.
  if (at.errors.size() != before) return kind;
  for (const Alternatives& alternatives : section.alternatives)
    at.errors.attempt([&] { check_alternatives(node, alternatives, at); });
  for (const KeyDescription& key : section.keys)
    if (required(key, *kind) && table->find(key.key) == nullptr) at.errors.add(missing_key(node, key, at));
  return kind;
}

const List& entries_of(const Node& node, const KeyDescription& key, const ReadContext& at) {
  const auto* list = std::get_if<List>(&node.value);
  const auto is_table = [](const Node& entry) { return std::holds_alternative<Table>(entry.value); };
  if (list == nullptr || !std::all_of(list->begin(), list->end(), is_table) ||
      (list->empty() && key.options.need == KeyOptions::Need::required)) {
    throw CaseError(node.where, at.path, describe(node), expected_text(key, at.units),
                    "Write the name in double brackets, once for each entry.");
  }
  return *list;
}

const Table& members_of(const Node& node, const KeyDescription& key, const ReadContext& at) {
  const auto* table = std::get_if<Table>(&node.value);
  if (table == nullptr || (table->members.empty() && key.options.need == KeyOptions::Need::required)) {
    throw CaseError(node.where, at.path, describe(node), expected_text(key, at.units));
  }
  return *table;
}

std::string written_kind(const Node& node, const Node& root, const SectionDescription& section) {
  if (section.selector.empty()) return "";
  const bool elsewhere = section.selector.find('.') != std::string::npos;
  const Node* value = find(elsewhere ? root : node, section.selector);
  return value != nullptr ? std::get<std::string>(value->value) : section.default_kind;
}

bool is_empty_text(const Node& node) {
  const auto* text = std::get_if<std::string>(&node.value);
  return text != nullptr && text->empty();
}

}  // namespace carom
