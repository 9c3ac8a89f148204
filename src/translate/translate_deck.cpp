#include "translate/translate_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include "base/terminal_text.hpp"
#include "casefile/read_case.hpp"
#include "translate/rigid.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

/// The first line under *HEADING.
Node title_of(const Statements& statements, const std::string& path) {
  for (const Statement& s : statements.list) {
    DeckCursor at(*s.keyword);
    if (s.keyword->name != "HEADING" || !at.next_line()) continue;
    return text_node(as_utf8(at.line()), at.where());
  }
  return text_node(std::filesystem::path(path).stem().string(), {path, 1, 0});
}

/// The unit system is a label, which steel would have with such a density.
std::string unit_system(const Table& root) {
  double density = 0.0;
  for (const Member& material : std::get<Table>(root.find("materials")->value).members)
    if (const Node* rho = find(material.value, "rho"))
      if (const double* value = std::get_if<double>(&rho->value)) density = std::max(density, *value);
  constexpr double tonnes_per_mm3 = 1e-7, kilograms_per_mm3 = 1e-3;
  if (density > 0.0 && density < tonnes_per_mm3) return "mm-t-s";
  return density > 0.0 && density < kilograms_per_mm3 ? "mm-kg-ms" : "SI";
}

bool begins_as_deck(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string beginning(std::size_t{1} << 16U, '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(file.gcount()));
  return looks_like_deck(beginning);
}

}  // namespace

bool Translation::is_finite() const {
  return std::any_of(steps.begin(), steps.end(), [](const DeckStep& step) { return step.is_finite; });
}

std::set<CellRef> Translation::body_cells() const {
  std::set<CellRef> bodies;
  for (const auto& [name, list] : mesh.names.element_sets)
    for (const DeckNames::Cells& cells : list)
      if (!cells.type->section.empty()) {
        const std::vector<CellRef>& group = mesh.mesh.cell_groups.at(cells.group);
        bodies.insert(group.begin(), group.end());
      }
  return bodies;
}

std::string Translation::numbers_of(const std::vector<CellRef>& cells) const {
  constexpr std::size_t most = 5;
  std::vector<std::string> numbers;
  for (std::size_t k = 0; k < std::min(cells.size(), most); ++k) numbers.push_back(mesh.mesh.cell_label(cells[k]));
  // The instance once, behind the numbers.
  const std::size_t end = numbers.empty() ? std::string::npos : numbers.front().find(' ');
  const std::string instance = end == std::string::npos ? "" : numbers.front().substr(end);
  for (std::string& number : numbers)
    if (number.ends_with(instance)) number.resize(number.size() - instance.size());
  return fmt::format("{}{}{}", fmt::join(numbers, ", "),
                     cells.size() > most ? fmt::format(" and {} more", cells.size() - most) : "", instance);
}

void Translation::append(const std::string& section, Node entry) {
  for (Member& member : root.members)
    if (member.key == section) return std::get<List>(member.value.value).push_back(std::move(entry));
  const Location where = entry.where;
  root.members.push_back({section, where, {List{std::move(entry)}, where}});
}

void Translation::define(const std::string& section, const std::string& name, Node entry) {
  const Location where = entry.where;
  for (Member& member : root.members)
    if (member.key == section)
      return std::get<Table>(member.value.value).members.push_back({name, where, std::move(entry)});
  root.members.push_back({section, where, {Table{{{name, where, std::move(entry)}}}, where}});
}

std::string Translation::node_group(const DeckCursor& at, const Statement& s, std::string_view text) const {
  const std::string key = key_of(mesh.names.node_sets, scope(s), text);
  if (key.empty())
    at.fail(fmt::format("\"{}\"", text), "the name of a node set or the number of a node",
            "Names of an instance have the instance before them, as in PART-1-1.TOP.");
  return mesh.names.node_sets.at(key);
}

TranslatedDeck translate_deck(const std::string& path, const std::vector<std::string>& accepted) {
  return translate_deck(read_included(path, {path, 0, 0}), path, accepted, read_included);
}

namespace {

/// What has become of a deck: the tree as if all that is not carried over were accepted, whole where nothing is wrong.
struct Attempt {
  Node tree;
  Findings findings;
  CaseErrors errors;
};

/// A keyword that gives a name to what others refer to, and the keywords behind it that go with it, whether Carom has
/// them or not (Abaqus keywords, "Material options" and "Interaction properties").
struct NamedKeyword {
  std::string name, parameter;  ///< of those that refer to it
  std::string what;             ///< in the note
  std::set<std::string> options;
};

const std::array<NamedKeyword, 3>& named_keywords() {
  static const std::array<NamedKeyword, 3> all{
      {{"MATERIAL",
        "MATERIAL",
        "the material {} is left out: nothing is made of it",
        {"ELASTIC",
         "PLASTIC",
         "DENSITY",
         "HYPERELASTIC",
         "HYPERFOAM",
         "VISCOELASTIC",
         "EXPANSION",
         "CONDUCTIVITY",
         "SPECIFIC HEAT",
         "INELASTIC HEAT FRACTION",
         "RATE DEPENDENT",
         "DAMPING",
         "CREEP",
         "POTENTIAL",
         "DEPVAR",
         "USER MATERIAL",
         "USER OUTPUT VARIABLES",
         "UNIAXIAL TEST DATA",
         "BIAXIAL TEST DATA",
         "PLANAR TEST DATA",
         "VOLUMETRIC TEST DATA",
         "DAMAGE INITIATION",
         "DAMAGE EVOLUTION",
         "DAMAGE STABILIZATION",
         "CYCLIC HARDENING",
         "CONCRETE DAMAGED PLASTICITY",
         "CONCRETE COMPRESSION HARDENING",
         "CONCRETE TENSION STIFFENING",
         "CRUSHABLE FOAM",
         "CRUSHABLE FOAM HARDENING",
         "DRUCKER PRAGER",
         "DRUCKER PRAGER HARDENING",
         "MOHR COULOMB",
         "EOS",
         "TENSILE FAILURE",
         "SHEAR FAILURE",
         "NO COMPRESSION",
         "NO TENSION",
         "MULLINS EFFECT",
         "PERMEABILITY",
         "LATENT HEAT"}},
       {"SURFACE INTERACTION",
        "INTERACTION",
        "the interaction {} is left out: no contact has it",
        {"SURFACE BEHAVIOR", "FRICTION", "COHESIVE BEHAVIOR", "CONTACT DAMPING", "DAMAGE INITIATION",
         "DAMAGE EVOLUTION", "DAMAGE STABILIZATION", "GAP CONDUCTANCE", "GAP HEAT GENERATION", "GAP RADIATION"}},
       {"AMPLITUDE", "AMPLITUDE", "the amplitude {} is left out: nothing follows it", {}}}};
  return all;
}

/// The names in upper case that a parameter of other keywords says; interactions also stand in data lines.
std::set<std::string> names_referred_to(const Statements& statements, const NamedKeyword& of) {
  std::set<std::string> names;
  for (const Statement& s : statements.list) {
    if (const std::string* name = s.keyword->parameter(of.parameter)) names.insert(upper_case(*name));
    if (s.keyword->name != "CONTACT PROPERTY ASSIGNMENT") continue;
    for (DeckCursor at(*s.keyword); at.next_line();)
      while (!at.at_end()) names.insert(upper_case(at.field()));
  }
  return names;
}

/// Takes away what nothing refers to, as CAE writes all that its model has: it may be what Carom has not.
void take_unused(Statements& statements, Findings& findings) {
  for (const NamedKeyword& of : named_keywords()) {
    const std::set<std::string> used = names_referred_to(statements, of);
    bool is_within = false;
    std::erase_if(statements.list, [&](const Statement& s) {
      const DeckKeyword& keyword = *s.keyword;
      const std::string* name = keyword.name == of.name ? keyword.parameter("NAME") : nullptr;
      if (keyword.name == of.name)
        is_within = name != nullptr && !used.contains(upper_case(*name));
      else
        is_within = is_within && of.options.contains(keyword.name);
      if (is_within && name != nullptr) findings.note(keyword.where, fmt::format(fmt::runtime(of.what), *name));
      return is_within;
    });
  }
}

/// What needs the mesh and the steps.
void translate_on_mesh(Translation& t) {
  for (void (*const translate)(Translation&) :
       {translate_discrete, translate_actions, translate_rigid_parts, translate_equations, translate_contacts,
        translate_steps, translate_probes})
    t.errors.attempt([&] { translate(t); });
}

/// Cells of parts have a section, but for those of rigid bodies, which say so themselves, and of instances that are
/// shown alone.
void refuse_loose_cells(Translation& t) {
  std::set<CellRef> loose = t.body_cells();
  const auto remove = [&](const std::string& group) {
    for (const CellRef& cell : t.mesh.mesh.cell_groups.at(group)) loose.erase(cell);
  };
  if (const Node* parts = t.root.find("part"))
    for (const Node& part : std::get<List>(parts->value))
      remove(std::get<std::string>(std::get<Table>(part.value).find("cells")->value));
  for (const DeckRigidBody& body : t.rigid_bodies)
    for (const CellRef& cell : body.cells) loose.erase(cell);
  for (const Statement& s : t.statements.list) {
    if (s.keyword->name != "DISPLAY BODY" || !s.keyword->has("INSTANCE")) continue;
    for (const auto& [set, list] : t.mesh.names.element_sets)
      if (set.starts_with(s.keyword->required("INSTANCE") + "."))
        for (const DeckNames::Cells& cells : list) remove(cells.group);
  }
  for (const DeckCells& read : t.mesh.read) {
    const std::vector<CellRef> own(loose.lower_bound(read.begin), loose.lower_bound({read.begin.block, read.end}));
    if (own.empty()) continue;
    const std::string* set = read.keyword->parameter("ELSET");
    t.errors.add(
        CaseError(read.keyword->where, "*ELEMENT",
                  fmt::format("{} {} without a section", own.size() == 1 ? "element" : "elements", t.numbers_of(own)),
                  "a *SOLID SECTION of all solids, plane cells and bars",
                  set == nullptr ? "Give the *ELEMENT an ELSET, and that a *SOLID SECTION with its MATERIAL."
                                 : fmt::format("Add *SOLID SECTION, ELSET={}, MATERIAL=...", *set)));
  }
}

Attempt attempt(std::string bytes, const std::string& path, const std::vector<std::string>& accepted,
                const IncludeReader& include) {
  const Deck deck = read_deck(std::move(bytes), path, include);
  Statements statements = statements_of(deck);
  Attempt made{{}, Findings(accepted), {}};
  std::vector<std::string> materials;
  for (const DeckKeyword& keyword : deck.keywords)
    if (keyword.name == "MATERIAL" && keyword.has("NAME")) materials.push_back(keyword.required("NAME"));
  take_unused(statements, made.findings);
  const DeckMesh mesh = deck_mesh(statements, path, made.errors);
  Translation t{statements, mesh, made.findings, made.errors, {}, {}, false, {}, std::move(materials)};
  survey(t);
  for (const DeckNote& note : mesh.notes) made.findings.note(note.where, note.text);
  const std::size_t before = made.errors.size();
  find_steps(t);
  const bool has_steps = made.errors.size() == before && !t.steps.empty();
  const Location top{path, 1, 0};
  t.root.members.push_back({"title", top, title_of(statements, path)});
  TableMaker of_mesh(top);
  of_mesh.text("file", std::filesystem::path(path).filename().string());
  t.root.members.push_back({"mesh", top, {}});
  const std::size_t before_bodies = made.errors.size();
  if (mesh.is_whole) t.rigid_bodies = rigid_bodies_of(t);
  translate_bodies(t);
  if (mesh.is_whole && made.errors.size() == before_bodies) refuse_loose_cells(t);
  if (has_steps && mesh.is_whole) translate_on_mesh(t);
  const auto leaves_cells = {"SHELL SECTION", "BEAM SECTION", "BEAM GENERAL SECTION", "MEMBRANE SECTION"};
  const auto shows = [](const Statement& s) { return s.keyword->name == "DISPLAY BODY"; };
  t.leaves_faces = t.leaves_faces || std::ranges::any_of(statements.list, shows);
  if (t.leaves_faces || std::any_of(leaves_cells.begin(), leaves_cells.end(),
                                    [&](const char* name) { return made.findings.is_left_out(name); }))
    of_mesh.text("unused", "ignore");  // faces and the like
  t.root.members[1].value = of_mesh.node();
  made.findings.check_accepted(deck, path, made.errors);
  if (!made.errors.empty()) return made;
  const std::string units = unit_system(t.root);
  made.findings.note(top, "units = \"" + units + "\" by the size of the densities; a label, nothing is converted");
  t.root.members.insert(t.root.members.begin() + 1, {"units", top, text_node(units, top)});
  made.tree = {std::move(t.root), top};
  return made;
}

}  // namespace

TranslatedDeck translate_deck(std::string bytes, const std::string& path, const std::vector<std::string>& accepted,
                              const IncludeReader& include) {
  Attempt made = attempt(std::move(bytes), path, accepted, include);
  made.findings.check(path, made.errors);
  return {std::move(made.tree), made.findings.notes()};
}

ReadCase read_case_or_deck(const std::string& path, const std::vector<std::string>& accepted,
                           const FurtherLooks& looks) {
  CaseErrors errors;
  if (!begins_as_deck(path)) {
    if (!accepted.empty())
      throw CaseError({path, 0, 0}, "", "a case file, with --accept", "a deck of Abaqus or CalculiX with --accept");
    ReadCase read{read_case(path, errors), {}};
    if (!errors.empty()) looks.at_wrong_case(read.given, errors);
    errors.check();
    return read;
  }
  Attempt made = attempt(read_included(path, {path, 0, 0}), path, accepted, read_included);
  if (!made.errors.empty()) made.findings.check(path, made.errors);
  Case given = case_of(made.tree, path, errors);
  if (made.findings.empty()) {
    if (!errors.empty()) looks.at_wrong_case(given, errors);
    errors.check();
    return {std::move(given), made.findings.notes()};
  }
  if (errors.empty()) errors.attempt([&] { looks.at_refused_deck(given); });
  made.findings.check(path, {}, errors);
  return {};
}

}  // namespace carom
