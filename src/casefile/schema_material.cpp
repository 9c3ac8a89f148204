#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "casefile/case_schema.hpp"
#include "casefile/write_toml.hpp"
#include "material/damaged_law.hpp"
#include "material/loaded_law.hpp"

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

/// The keys that name a library.
void add_library_keys(SectionSchema<CaseMaterial>& s) {
  s.key(
      "library", &CaseMaterial::library,
      "A library with laws of your own (docs/user_laws.md), relative to the folder of the case file. `law` is then one "
      "of its laws, and the parameters of that are the other keys.");
  s.key(
      "checksum", &CaseMaterial::checksum,
      "Of the file of `library`; another one is refused. case.resolved.toml has it, so that a run goes on with the law "
      "that it began with.");
}

/// Those that take the parameter in this form.
std::vector<std::string> kinds_with(const LawParameter& parameter) {
  return kinds_of([&parameter](const Law& law) {
    return std::find(law.parameters.begin(), law.parameters.end(), parameter) != law.parameters.end();
  });
}

KeyDescription describe(const LawParameter& parameter, const std::vector<std::string>& kinds) {
  KeyDescription key{parameter.key, Shape::number, parameter.meaning, {}, {}, {}};
  key.options.range = range_of(parameter.range);
  key.options.unit = parameter.unit;
  key.options.need = parameter.initial ? Need::optional : Need::required;
  key.options.aliases = parameter.aliases;
  key.options.kinds = kinds;
  key.options.default_phrase = parameter.initial_phrase;
  key.options.remedy = parameter.remedy;
  if (parameter.initial && parameter.initial_phrase.empty()) key.default_value = Node{*parameter.initial, {}};
  return key;
}

/// A parameter as a key of the laws that take it in this form.
void add_parameter(SectionSchema<CaseMaterial>& s, const LawParameter& parameter,
                   const std::vector<std::string>& kinds) {
  const KeyDescription key = describe(parameter, kinds);
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

/// Of the curves, for laws that have several.
void add_rates(SectionSchema<CaseMaterial>& s, const Law& law) {
  const auto is_it = [&law](const KeyDescription& other) { return other.key == law.rates_key; };
  if (law.rates_key.empty() || std::any_of(s.description.keys.begin(), s.description.keys.end(), is_it)) return;
  KeyDescription key{law.rates_key, Shape::numbers, law.rates_meaning, {}, {}, {}};
  key.options.unit = Dimension::rate;
  key.options.range = at_least(0.0);
  key.options.kinds = kinds_of([&law](const Law& other) { return other.rates_key == law.rates_key; });
  SectionSchema<CaseMaterial>::Handlers handlers;
  handlers.read = [key](CaseMaterial& material, const Node& node, const ReadContext& at) {
    decode(node, key, at, material.rates);
  };
  handlers.write = [key](const CaseMaterial& material, const Node&) -> std::optional<Node> {
    if (material.rates.empty()) return std::nullopt;
    return encode(material.rates, key.options);
  };
  s.add(key, handlers);
}

SectionSchema<JohnsonCookDamage> damage_section() {
  SectionSchema<JohnsonCookDamage> s(
      "Johnson and Cook's damage, of laws that yield: the `damage` of a point grows from 0 by the plastic strain over "
      "that at fracture, [D1 + D2 exp(D3 eta)] [1 + D4 ln(rate / reference_rate)] [1 + D5 theta], where eta is the "
      "mean over the von Mises stress, tension positive (docs/material_laws.md). It does not soften the stress; "
      "[[erosion]] can go by it, fields and probes have it by its name.");
  s.key("D1", &JohnsonCookDamage::D1, "Strain at fracture that is left at a high eta.",
        {.need = Need::required, .aliases = {"d1", "D_1"}});
  s.key("D2", &JohnsonCookDamage::D2, "What eta = 0 adds to it.", {.range = at_least(0.0), .aliases = {"d2", "D_2"}});
  s.key("D3", &JohnsonCookDamage::D3,
        "Exponent of eta; below 0 where tension breaks sooner. Abaqus' d3 has the other sign.",
        {.aliases = {"d3", "D_3"}});
  s.key("D4", &JohnsonCookDamage::D4, "Factor of the logarithm of the rate; 0: no influence of the rate.",
        {.aliases = {"d4", "D_4"}});
  s.key("D5", &JohnsonCookDamage::D5,
        "Factor of theta, the temperature between the law's reference_temperature (0) and melting_temperature (1); 0: "
        "no influence of the temperature.",
        {.aliases = {"d5", "D_5"}});
  s.key("reference_rate", &JohnsonCookDamage::reference_rate,
        "Rate of plastic strain below which there is no influence of the rate.",
        {.unit = Dimension::rate,
         .range = greater_than(0.0),
         .aliases = {"epsilon_0", "strain_rate"},
         .default_phrase = "that of the law; needed beside D4 where it has none"});
  return s;
}

/// The rules between the values of the damage.
void check_damage_of(const Material& made, const Node& node, const ReadContext& at) {
  const std::optional<LawProblem> problem = check_damage(made);
  if (!problem) return;
  const Node& damage = *find(node, "damage");
  throw CaseError(find(damage, problem->key)->where, at.at("damage").at(problem->key).path, problem->found,
                  problem->expected, problem->remedy);
}

/// The rules of the law between its values.
void check_material(CaseMaterial& material, const Node& node, const ReadContext& at) {
  const Material made = material.made();
  if (made.damage) check_damage_of(made, node, at);
  if (made.law->check == nullptr) return;
  const std::optional<LawProblem> problem = made.law->check(made);
  if (!problem) return;
  const Node* place = problem->key.empty() ? nullptr : find(node, problem->key);
  throw CaseError(place != nullptr ? place->where : node.where,
                  problem->key.empty() ? at.path : at.at(problem->key).path, problem->found, problem->expected,
                  problem->remedy);
}

/// The keys of a law of a library; `choices`: all laws that it has.
SectionSchema<CaseMaterial> library_section(const Law& law, const std::vector<std::string>& choices) {
  SectionSchema<CaseMaterial> s("A material with a law of a library.");
  s.key("law", &CaseMaterial::law, law.summary, {.choices = choices, .need = Need::required});
  s.key("rho", &CaseMaterial::rho, "Density.",
        {.unit = Dimension::density, .range = greater_than(0.0), .need = Need::required, .aliases = {"density"}});
  for (const LawParameter& parameter : law.parameters) add_parameter(s, parameter, {});
  add_library_keys(s);
  return s;
}

/// The text of a key that must be there.
std::string text_of(const Node& node, const KeyDescription& key, const ReadContext& at) {
  const Node* value = find(node, key.key);
  if (value == nullptr) throw CaseError(node.where, at.at(key.key).path, "nothing", expected_text(key, at.units));
  std::string text;
  if (key.options.choices.empty())
    decode(*value, key, at.at(key.key), text);
  else
    text = key.options.choices[decode_choice(*value, key, at.at(key.key))];
  return text;
}

const LawLibrary& library_of(const Node& node, const ReadContext& at) {
  namespace fs = std::filesystem;
  const std::string given = text_of(node, {"library", Shape::text, "", {}, {}, {}}, at);
  const auto refuse = [&](const char* key, const std::string& found, const std::string& expected, const char* remedy) {
    throw CaseError(find(node, key)->where, at.at(key).path, found, expected, remedy);
  };
  const LawLibrary* library = nullptr;
  try {
    library = &load_laws(fs::absolute(fs::path(at.file).parent_path() / given).string());
  } catch (const LawLibraryError& e) {
    refuse("library", fmt::format("{}: {}", toml_string(given), e.what()), e.expected, "");
  }
  if (find(node, "checksum") == nullptr) return *library;
  if (const std::string checksum = text_of(node, {"checksum", Shape::text, "", {}, {}, {}}, at);
      checksum != library->checksum)
    refuse("checksum", fmt::format("{} of the library \"{}\", version {}", library->checksum, given, library->version),
           checksum,
           "The library has been made anew since: its laws may answer otherwise. Put the old one back, or run anew "
           "without this key.");
  return *library;
}

/// Where a material names a library, its keys are those of the law of it.
std::optional<SectionSchema<CaseMaterial>> of_library(const Node& node, const ReadContext& at) {
  if (find(node, "library") == nullptr) return std::nullopt;
  const LawLibrary& library = library_of(node, at);
  KeyDescription key{"law", Shape::text, "", {}, {}, {}};
  for (const Law& law : library.laws) key.options.choices.push_back(law.name);
  const Law& law = *library.find(text_of(node, key, at));
  SectionSchema<CaseMaterial> s = library_section(law, key.options.choices);
  s.finish = [&law, &library](CaseMaterial& material, const Node& own, const ReadContext& here) {
    material.loaded = &law;
    material.checksum.value = library.checksum;
    check_material(material, own, here);
  };
  return s;
}

}  // namespace

Material CaseMaterial::made() const {
  Material material(*row(), *rho, {});
  for (std::size_t p = 0; p < material.values.size(); ++p) material.values[p] = *value(material.law->parameters[p].key);
  material.curve = *curve;
  material.rates = rates;
  material.damage = damage;
  return material;
}

SectionSchema<CaseMaterial> material_section() {
  SectionSchema<CaseMaterial> s("A material; NAME is what [[part]] refers to.");
  s.description.selector = "law";
  s.description.opened_by = "library";
  s.key("law", &CaseMaterial::law, summaries(), {.choices = law_names(), .need = Need::required});
  for (const LawParameter& parameter : laws().front().parameters) add_parameter(s, parameter, kinds_with(parameter));
  s.key("rho", &CaseMaterial::rho, "Density.",
        {.unit = Dimension::density, .range = greater_than(0.0), .need = Need::required, .aliases = {"density"}});
  for (const Law& law : laws()) {
    for (const LawParameter& parameter : law.parameters) add_parameter(s, parameter, kinds_with(parameter));
    add_curve(s, law);
    add_rates(s, law);
  }
  s.table("damage", &CaseMaterial::damage, damage_section(), {.kinds = kinds_of(yields)});
  add_library_keys(s);
  s.finish = check_material;
  s.instead_of_read = of_library;
  s.instead_of_write = [](const CaseMaterial& material) -> std::optional<SectionSchema<CaseMaterial>> {
    if (material.library->empty()) return std::nullopt;
    return library_section(*material.loaded, {});
  };
  return s;
}

}  // namespace carom
