#include "translate/translate_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "casefile/read_case.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

/// The first line under *HEADING, in ASCII.
Node title_of(const Statements& statements, const std::string& path) {
  for (const Statement& s : statements.list) {
    DeckCursor at(*s.keyword);
    if (s.keyword->name != "HEADING" || !at.next_line()) continue;
    std::string title(at.line());
    for (char& c : title)
      if (c < 32 || c > 126) c = '?';
    return text_node(title, at.where());
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

TranslatedDeck translate_deck(std::string bytes, const std::string& path, const std::vector<std::string>& accepted,
                              const IncludeReader& include) {
  const Deck deck = read_deck(std::move(bytes), path, include);
  const Statements statements = statements_of(deck);
  const DeckMesh mesh = deck_mesh(statements, path);
  Findings findings(accepted);
  Translation t{statements, mesh, findings, {}, {}, {}};
  survey(t);
  find_steps(t);
  t.rigid_bodies = rigid_bodies_of(t);
  const Location top{path, 1, 0};
  t.root.members.push_back({"title", top, title_of(statements, path)});
  TableMaker of_mesh(top);
  of_mesh.text("file", std::filesystem::path(path).filename().string());
  const auto leaves_cells = {"SHELL SECTION", "BEAM SECTION", "BEAM GENERAL SECTION", "MEMBRANE SECTION"};
  if (std::any_of(leaves_cells.begin(), leaves_cells.end(), [&](const char* name) { return findings.accepts(name); }))
    of_mesh.text("unused", "ignore");
  t.root.members.push_back({"mesh", top, of_mesh.node()});
  translate_bodies(t);
  translate_discrete(t);
  translate_actions(t);
  translate_equations(t);
  translate_contacts(t);
  translate_steps(t);
  translate_probes(t);
  findings.check(path);
  const std::string units = unit_system(t.root);
  findings.note(top, "units = \"" + units + "\" by the size of the densities; a label, nothing is converted");
  t.root.members.insert(t.root.members.begin() + 1, {"units", top, text_node(units, top)});
  return {{std::move(t.root), top}, findings.notes()};
}

ReadCase read_case_or_deck(const std::string& path, const std::vector<std::string>& accepted) {
  if (!begins_as_deck(path)) {
    if (!accepted.empty())
      throw CaseError({path, 0, 0}, "", "a case file, with --accept", "a deck of Abaqus or CalculiX with --accept");
    return {read_case(path), {}};
  }
  TranslatedDeck translated = translate_deck(path, accepted);
  return {case_of(translated.tree, path), std::move(translated.notes)};
}

}  // namespace carom
