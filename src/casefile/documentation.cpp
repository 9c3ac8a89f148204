#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

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

/// The name of the example of a section: that of the section without ".NAME".
std::string file_of(std::string name) {
  constexpr std::string_view any_name = ".NAME";
  for (std::size_t at = name.find(any_name); at != std::string::npos; at = name.find(any_name))
    name.erase(at, any_name.size());
  return name;
}

/// The sections one after the other, each with its example; those of several kinds have one for all.
class Sections {
 public:
  Sections(const ExampleOf& example_of, std::string& text) : example_of_(example_of), text_(text) {}

  void write_example(const std::string& name) {
    if (!written_.insert(name).second) return;
    fmt::format_to(std::back_inserter(text_),
                   "\n<details markdown=\"1\">\n<summary>Example: <code>examples/format/{}.toml</code></summary>\n\n"
                   "```toml\n{}```\n\n</details>\n",
                   name, example_of_(name));
  }

  void write(const std::string& path, const KeyDescription& key);

 private:
  const ExampleOf& example_of_;
  std::string& text_;
  std::set<std::string> written_;
};

void Sections::write(const std::string& path, const KeyDescription& key) {
  const SectionDescription& section = *key.section;
  const bool needed = key.options.need == KeyOptions::Need::required;
  fmt::format_to(std::back_inserter(text_), "\n## {}\n\n{}{}\n", heading_of(path, key), section.doc,
                 needed ? " Required." : "");
  write_values(section, text_);
  write_alternatives(section, text_);
  const std::string name = join(path, key.key);
  write_example(file_of(name));
  const char* of_each = key.shape == Shape::named_sections ? ".NAME" : "";
  for (const KeyDescription& child : section.keys) {
    if (child.section) write(name + of_each, child);
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

std::string case_documentation(const ExampleOf& example_of) {
  const SectionDescription& root = case_schema().description;
  std::string text =
      "# Case files\n\n<!-- Written from the declaration in src/casefile; do not edit. -->\n\n"
      "A case is one TOML file. Unknown keys are errors. All numbers are finite and in the units of the case; nothing "
      "is ever converted.\nSections in `[[double brackets]]` may be given several times. `NAME` is a name of your own. "
      "Tables within a section may be written inline,\nfor example `velocity = { z = -2.0, function = \"ramp\" }`.\n"
      "Each section has an example, a complete case that runs in a second; they stand in `examples/format`.\n"
      "An editor completes keys and shows what is wrong while you type: [how](howto/editor.md).\n"
      "\n## Top of the file\n";
  write_values(root, text);
  Sections sections(example_of, text);
  sections.write_example("top");
  for (const KeyDescription& key : root.keys) {
    if (key.section) sections.write("", key);
  }
  write_units(text);
  return text;
}

}  // namespace carom
