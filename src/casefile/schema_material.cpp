#include <algorithm>
#include <cmath>

#include "casefile/case_schema.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

std::string summaries() {
  std::string text = "The constitutive law (docs/material_laws.md): ";
  for (const Law& law : laws()) text += (&law == &laws().front() ? "" : "; ") + law.summary;
  return text + ".";
}

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const Law& law : laws()) names.push_back(law.name);
  return names;
}

/// The laws that pass; empty when all do.
template <class Takes>
std::vector<std::string> kinds_of(const Takes& takes) {
  std::vector<std::string> names;
  for (const Law& law : laws())
    if (takes(law)) names.push_back(law.name);
  if (names.size() == laws().size()) names.clear();
  return names;
}

bool has(const Law& law, const LawParameter& parameter) {
  return std::find(law.parameters.begin(), law.parameters.end(), parameter) != law.parameters.end();
}

KeyDescription describe(const LawParameter& parameter) {
  KeyDescription key{parameter.key, Shape::number, parameter.meaning, {}, {}, {}};
  key.options.range = range_of(parameter.range);
  key.options.unit = parameter.unit;
  key.options.need = parameter.initial ? Need::optional : Need::required;
  key.options.aliases = parameter.aliases;
  key.options.kinds = kinds_of([&parameter](const Law& law) { return has(law, parameter); });
  key.options.default_phrase = parameter.initial_phrase;
  if (parameter.initial && parameter.initial_phrase.empty()) key.default_value = Node{*parameter.initial, {}};
  return key;
}

/// A parameter as a key of the laws that take it in this form.
void add_parameter(SectionSchema<CaseMaterial>& s, const LawParameter& parameter) {
  const KeyDescription key = describe(parameter);
  const auto is_it = [&key](const KeyDescription& other) {
    return other.key == key.key && other.options.kinds == key.options.kinds;
  };
  if (std::any_of(s.description.keys.begin(), s.description.keys.end(), is_it)) return;
  SectionSchema<CaseMaterial>::Handlers handlers;
  handlers.read = [key](CaseMaterial& material, const Node& node, const ReadContext& at) {
    decode(node, key, at, material.values[key.key]);
  };
  handlers.write = [key, parameter](const CaseMaterial& material, const Node&) -> std::optional<Node> {
    const double value = *material.value(key.key);
    if (!parameter.initial_phrase.empty() && value == *parameter.initial) return std::nullopt;
    return encode(value, key.options);
  };
  handlers.absent = [parameter](CaseMaterial& material, const ReadContext&, const Location& where) {
    material.values[parameter.key] = {parameter.initial.value_or(0.0), where};
  };
  s.add(key, handlers);
}

void add_curve(SectionSchema<CaseMaterial>& s, const Law& law) {
  const auto is_it = [&law](const KeyDescription& other) { return other.key == law.curve_key; };
  if (law.curve_key.empty() || std::any_of(s.description.keys.begin(), s.description.keys.end(), is_it)) return;
  KeyDescription key{law.curve_key, Shape::pairs, law.curve_meaning, {}, {}, {}};
  key.options.range = at_least(0.0);
  key.options.kinds = kinds_of([&law](const Law& other) { return other.curve_key == law.curve_key; });
  SectionSchema<CaseMaterial>::Handlers handlers;
  handlers.read = [key](CaseMaterial& material, const Node& node, const ReadContext& at) {
    decode(node, key, at, material.curve);
  };
  handlers.write = [key](const CaseMaterial& material, const Node&) -> std::optional<Node> {
    if (material.curve->empty()) return std::nullopt;
    return encode(material.curve, key.options);
  };
  s.add(key, handlers);
}

/// The rules of the law between its values.
void check_material(CaseMaterial& material, const Node& node, const ReadContext& at) {
  const Material made = material.made();
  if (made.law->check == nullptr) return;
  const std::optional<LawProblem> problem = made.law->check(made);
  if (!problem) return;
  const Node* place = find(node, problem->key);
  throw CaseError(place != nullptr ? place->where : node.where, at.at(problem->key).path, problem->found,
                  problem->expected, problem->remedy);
}

}  // namespace

Material CaseMaterial::made() const {
  Material material(*law, *rho, {});
  for (std::size_t p = 0; p < material.values.size(); ++p) material.values[p] = *value(material.law->parameters[p].key);
  material.curve = *curve;
  return material;
}

SectionSchema<CaseMaterial> material_section() {
  SectionSchema<CaseMaterial> s("A material; NAME is what [[part]] refers to.");
  s.description.selector = "law";
  s.key("law", &CaseMaterial::law, summaries(), {.choices = law_names(), .need = Need::required});
  for (const LawParameter& parameter : laws().front().parameters) add_parameter(s, parameter);
  s.key("rho", &CaseMaterial::rho, "Density.",
        {.unit = Dimension::density, .range = greater_than(0.0), .need = Need::required, .aliases = {"density"}});
  for (const Law& law : laws()) {
    for (const LawParameter& parameter : law.parameters) add_parameter(s, parameter);
    add_curve(s, law);
  }
  s.finish = check_material;
  return s;
}

}  // namespace carom
