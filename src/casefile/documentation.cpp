#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "casefile/case_schema.hpp"
#include "casefile/schema.hpp"
#include "casefile/write_toml.hpp"

namespace carom {

namespace {

std::string form(const KeyDescription& key) {
  KeyDescription without_unit = key;
  without_unit.options.unit = Dimension::none;
  return expected_text(without_unit, UnitSystem::si);
}

std::string default_text(const KeyDescription& key) {
  if (!key.options.default_phrase.empty()) return key.options.default_phrase;
  if (key.options.need == KeyOptions::Need::required) return "**required**";
  return key.default_value ? fmt::format("`{}`", toml_value(*key.default_value)) : "";
}

std::string meaning(const KeyDescription& key, const SectionDescription& section) {
  if (key.options.kinds.empty()) return key.doc;
  return fmt::format("{} (`{}` = {} only)", key.doc, section.selector, quoted_list(key.options.kinds));
}

std::string heading_of(const std::string& path, const KeyDescription& key) {
  const std::string child = join(path, key.key);
  switch (key.shape) {
    case Shape::sections:
      return "[[" + child + "]]";
    case Shape::named_sections:
      return "[" + child + ".NAME]";
    default:
      return "[" + child + "]";
  }
}

bool has_values(const SectionDescription& section) {
  const auto plain = [](const KeyDescription& key) { return key.section == nullptr; };
  return std::any_of(section.keys.begin(), section.keys.end(), plain);
}

void write_values(const SectionDescription& section, std::string& text) {
  if (!has_values(section)) return;
  text += "\n| key | value | unit | default | meaning |\n|---|---|---|---|---|\n";
  for (const KeyDescription& key : section.keys) {
    if (key.section) continue;
    fmt::format_to(std::back_inserter(text), "| `{}` | {} | {} | {} | {} |\n", key.key, form(key),
                   name(key.options.unit), default_text(key), meaning(key, section));
  }
}

void write_alternatives(const SectionDescription& section, std::string& text) {
  for (const Alternatives& alternatives : section.alternatives) {
    const bool one = alternatives.count == Alternatives::Count::exactly_one;
    fmt::format_to(std::back_inserter(text), "\n{} of `{}` must be given.\n", one ? "Exactly one" : "At least one",
                   fmt::join(alternatives.keys, "`, `"));
  }
}

void write_section(const std::string& path, const KeyDescription& key, std::string& text) {
  const SectionDescription& section = *key.section;
  const bool needed = key.options.need == KeyOptions::Need::required;
  fmt::format_to(std::back_inserter(text), "\n## {}\n\n{}{}\n", heading_of(path, key), section.doc,
                 needed ? " Required." : "");
  write_values(section, text);
  write_alternatives(section, text);
  const char* of_each = key.shape == Shape::named_sections ? ".NAME" : "";
  for (const KeyDescription& child : section.keys) {
    if (child.section) write_section(join(path, key.key) + of_each, child, text);
  }
}

void write_units(std::string& text) {
  text += "\n## Units\n\n| |";
  for (const UnitSystem system : unit_systems) fmt::format_to(std::back_inserter(text), " {} |", name(system));
  text += "\n|---|---|---|---|\n";
  for (const Dimension dimension : dimensions) {
    fmt::format_to(std::back_inserter(text), "| {} |", name(dimension));
    for (const UnitSystem system : unit_systems) {
      fmt::format_to(std::back_inserter(text), " {} |", unit_name(dimension, system));
    }
    text += "\n";
  }
}

}  // namespace

std::string case_documentation() {
  const SectionDescription& root = case_schema().description;
  std::string text =
      "# Case files\n\n<!-- Written from the declaration in src/casefile; do not edit. -->\n\n"
      "A case is one TOML file. Unknown keys are errors. All numbers are finite and in the units of the case; nothing "
      "is ever converted.\nSections in `[[double brackets]]` may be given several times. `NAME` is a name of your own. "
      "Tables within a section may be written inline,\nfor example `velocity = { z = -2.0, function = \"ramp\" }`.\n"
      "\n## Top of the file\n";
  write_values(root, text);
  for (const KeyDescription& key : root.keys) {
    if (key.section) write_section("", key, text);
  }
  write_units(text);
  return text;
}

}  // namespace carom
