#include <nlohmann/json.hpp>

#include "casefile/case_schema.hpp"
#include "casefile/schema.hpp"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Node& node) {
  return std::visit(
      [](const auto& value) -> Json {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, List>) {
          Json list = Json::array();
          for (const Node& entry : value) list.push_back(to_json(entry));
          return list;
        } else if constexpr (std::is_same_v<T, Table> || std::is_same_v<T, Date>) {
          return nullptr;  // no key has a table or a date as its default
        } else {
          return value;
        }
      },
      node.value);
}

Json section_schema(const SectionDescription& section);

void add_range(const Range& range, Json& schema) {
  using Side = Bound::Side;
  if (range.low) schema[range.low->side == Side::closed ? "minimum" : "exclusiveMinimum"] = range.low->value;
  if (range.high) schema[range.high->side == Side::closed ? "maximum" : "exclusiveMaximum"] = range.high->value;
}

Json number_schema(const char* type, const KeyOptions& options) {
  Json schema{{"type", type}};
  add_range(options.range, schema);
  return schema;
}

Json text_schema(const KeyOptions& options) {
  Json schema{{"type", "string"}};
  if (options.choices.empty()) return schema;
  schema["enum"] = options.choices;
  if (!options.others.empty()) return {{"anyOf", {schema, {{"type", "string"}, {"description", options.others}}}}};
  return schema;
}

Json list_schema(const Json& entry) {
  return {{"type", "array"}, {"items", entry}};
}

Json tuple_schema(std::size_t size, const Json& entry) {
  return {{"type", "array"}, {"items", entry}, {"minItems", size}, {"maxItems", size}};
}

Json named_schema(const Json& entry) {
  return {{"type", "object"}, {"additionalProperties", entry}};
}

Json shape_schema(const KeyDescription& key) {
  const KeyOptions& options = key.options;
  switch (key.shape) {
    case Shape::boolean:
      return {{"type", "boolean"}};
    case Shape::integer:
      return number_schema("integer", options);
    case Shape::number:
      return number_schema("number", options);
    case Shape::text:
      return text_schema(options);
    case Shape::vector:
      return tuple_schema(3, number_schema("number", options));
    case Shape::pair:
      return tuple_schema(2, number_schema("number", options));
    case Shape::integers:
      return tuple_schema(3, number_schema("integer", options));
    case Shape::integer_pair:
      return tuple_schema(2, number_schema("integer", options));
    case Shape::numbers:
      return list_schema(number_schema("number", options));
    case Shape::pairs:
      return list_schema(tuple_schema(2, number_schema("number", options)));
    case Shape::texts:
      return list_schema(text_schema(options));
    case Shape::formulas:
      return tuple_schema(3, text_schema(options));
    case Shape::named_vectors:
      return named_schema(tuple_schema(3, number_schema("number", options)));
    case Shape::section:
      return section_schema(*key.section);
    case Shape::sections:
      return list_schema(section_schema(*key.section));
    case Shape::named_sections:
      return named_schema(section_schema(*key.section));
  }
  return {};
}

Json key_schema(const KeyDescription& key) {
  Json schema = shape_schema(key);
  std::string text = key.doc;
  if (!name(key.options.unit).empty()) text += " Unit: " + std::string(name(key.options.unit)) + ".";
  if (!key.options.default_phrase.empty()) text += " Default: " + key.options.default_phrase + ".";
  schema["description"] = text;
  if (key.default_value) schema["default"] = to_json(*key.default_value);
  return schema;
}

/// Keys that are declared more than once, for different kinds, may have any of their forms.
void add_property(const KeyDescription& key, Json& properties) {
  const Json schema = key_schema(key);
  if (!properties.contains(key.key)) {
    properties[key.key] = schema;
    return;
  }
  Json& before = properties[key.key];
  if (!before.contains("anyOf")) before = Json{{"anyOf", Json::array({before})}};
  before["anyOf"].push_back(schema);
}

Json names(const std::vector<std::string>& keys) {
  Json list = Json::array();
  for (const std::string& key : keys) list.push_back({{"required", Json::array({key})}});
  return list;
}

void add_alternatives(const SectionDescription& section, Json& schema) {
  for (const Alternatives& alternatives : section.alternatives) {
    const bool one = alternatives.count == Alternatives::Count::exactly_one;
    schema["allOf"].push_back({{one ? "oneOf" : "anyOf", names(alternatives.keys)}});
  }
}

std::vector<std::string> kinds_of(const SectionDescription& section) {
  for (const KeyDescription& key : section.keys) {
    if (key.key == section.selector) return key.options.choices;
  }
  return {};
}

/// What a section of this kind must have and must not have.
Json kind_schema(const SectionDescription& section, const std::string& kind) {
  Json refused = Json::object();
  Json needed = Json::array();
  for (const KeyDescription& key : section.keys) {
    if (!applies(key, kind) && !refused.contains(key.key)) refused[key.key] = false;
  }
  for (const KeyDescription& key : section.keys) {
    if (applies(key, kind)) refused.erase(key.key);
    if (required(key, kind) && !required(key, "")) needed.push_back(key.key);
  }
  Json schema = Json::object();
  if (!refused.empty()) schema["properties"] = refused;
  if (!needed.empty()) schema["required"] = needed;
  return schema;
}

void add_kinds(const SectionDescription& section, Json& schema) {
  for (const std::string& kind : kinds_of(section)) {
    Json condition{{"properties", {{section.selector, {{"const", kind}}}}}};
    if (kind != section.default_kind) condition["required"] = Json::array({section.selector});
    schema["allOf"].push_back({{"if", condition}, {"then", kind_schema(section, kind)}});
  }
}

/// Sections whose keys depend on a key of another section: the condition stands at the root.
void add_distant_kinds(const SectionDescription& root, Json& schema) {
  for (const KeyDescription& child : root.keys) {
    if (!child.section) continue;
    const std::size_t dot = child.section->selector.find('.');
    if (dot == std::string::npos) continue;
    const std::string other = child.section->selector.substr(0, dot);
    const std::string selector = child.section->selector.substr(dot + 1);
    for (const KeyDescription& section : root.keys) {
      if (section.key != other) continue;
      SectionDescription local = *section.section;
      local.selector = selector;
      for (const std::string& kind : kinds_of(local)) {
        const Json condition{{"properties", {{other, {{"properties", {{selector, {{"const", kind}}}}}}}}}};
        const Json consequence{{"properties", {{child.key, kind_schema(*child.section, kind)}}}};
        schema["allOf"].push_back({{"if", condition}, {"then", consequence}});
      }
    }
  }
}

Json section_schema(const SectionDescription& section) {
  Json properties = Json::object();
  Json needed = Json::array();
  for (const KeyDescription& key : section.keys) {
    add_property(key, properties);
    if (required(key, "")) needed.push_back(key.key);
  }
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!needed.empty()) schema["required"] = needed;
  add_alternatives(section, schema);
  if (section.selector.find('.') == std::string::npos) add_kinds(section, schema);
  if (section.opened_by.empty()) return schema;
  const Json condition{{"required", Json::array({section.opened_by})}};
  const Json opened{{"required", Json::array({section.selector})}};
  return {{"type", "object"},
          {"properties", {{section.opened_by, properties[section.opened_by]}}},
          {"if", condition},
          {"then", opened},
          {"else", schema}};
}

}  // namespace

std::string json_schema() {
  const SectionDescription& root = case_schema().description;
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Carom case"}};
  schema["description"] = root.doc;
  schema.update(section_schema(root));
  add_distant_kinds(root, schema);
  return schema.dump(2) + "\n";
}

}  // namespace carom
