#include "build/eroding_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/errors.hpp"
#include "build/stage.hpp"

namespace carom {

namespace {

[[noreturn]] void refuse(const CaseErosion& given, const std::string& key, const std::string& found,
                         const std::string& expected, const std::string& remedy) {
  throw CaseError(given.where, "erosion." + key, found, expected, remedy);
}

/// The cells of the parts of that name, and their nodes.
struct ErodingCells {
  std::vector<Index> positions;
  std::set<Index> nodes;
};

ErodingCells cells_of(const CaseErosion& given, const Model& model) {
  ErodingCells out;
  Index first = 0;
  for (const Part& part : model.parts) {
    const auto block = static_cast<Index>(model.mesh->block(part.type) - model.mesh->blocks.data());
    for (std::size_t k = 0; k < part.cells.size() && part.name == *given.part; ++k) {
      out.positions.push_back(first + static_cast<Index>(k));
      for (const Index n : model.mesh->blocks[at(block)].nodes(part.cells[k])) out.nodes.insert(n);
    }
    first += static_cast<Index>(part.cells.size());
  }
  return out;
}

void check_parts(const CaseErosion& given, const Model& model) {
  for (const Part& part : model.parts) {
    if (part.name != *given.part) continue;
    if (part.formulation == Formulation::nodal)
      refuse(given, "part", fmt::format("formulation = \"nodal\" of part \"{}\"", part.name),
             "cells that have points of their own",
             "Leave the formulation out, or take \"full\": what nodes remember cannot go with a cell.");
    const std::vector<std::string> history = part.material.history();
    if (given.plastic_strain && std::ranges::find(history, yielding_by) == history.end())
      refuse(given, "plastic_strain",
             fmt::format("law = \"{}\" of part \"{}\", which does not yield", part.material.law->name, part.name),
             "a law that yields", "Give the part such a law, or let it go at a time.");
    if (given.damage && std::ranges::find(history, damaged_by) == history.end())
      refuse(given, "damage", fmt::format("a material of part \"{}\" that has none", part.name),
             "a material with damage", "Give the material `damage = { D1 = ..., ... }`.");
  }
}

void check_joints(const CaseErosion& given, const Model& model, const std::set<Index>& nodes) {
  const auto goes = [&](Index n) { return nodes.contains(n); };
  const auto refuse_joint = [&](const std::string& what) {
    refuse(given, "part", fmt::format("part \"{}\" with nodes of {}", *given.part, what),
           "cells that nothing else holds on to", "Make the cells there a part of their own that stays.");
  };
  for (const ContactDefinition& contact : model.contacts) {
    const ContactParts parts = parts_of(contact);
    const bool is_joint = parts.nature != ContactNature::touches || !parts.cells.empty();
    if (is_joint && std::ranges::any_of(nodes_of(parts, *model.mesh), goes))
      refuse_joint(fmt::format("contact \"{}\", which holds on to them", name_of(contact)));
  }
  for (const LinearEquation& equation : model.equations)
    if (std::ranges::any_of(equation.terms, [&](const LinearEquation::Term& term) { return goes(term.node); }))
      refuse_joint(equation.name);
  for (const Load& load : model.loads) {
    const auto* pressure = std::get_if<Pressure>(&load);
    if (pressure == nullptr) continue;
    for (const Facet& facet : pressure->surface.facets)
      if (std::ranges::all_of(facet, goes)) refuse_joint("a face under pressure");
  }
}

}  // namespace

bool erodes(const Case& given, const std::string& part) {
  return std::ranges::any_of(given.erosion, [&](const CaseErosion& erosion) { return *erosion.part == part; });
}

void add_erosion(const CaseErosion& given, Model& model) {
  check_parts(given, model);
  ErodingCells cells = cells_of(given, model);
  check_joints(given, model, cells.nodes);
  model.erosion.push_back(
      {*given.part, std::move(cells.positions), given.plastic_strain, given.damage, given.distortion, given.time});
}

void refuse_erosion(const Case& given, const Model& model, const std::vector<std::unique_ptr<Stage>>& stages) {
  if (model.erosion.empty()) return;
  for (const std::unique_ptr<Stage>& stage : stages) {
    const SchemeKind kind = stage->settings().kind;
    if (!is_explicit(kind) || has_massless_contact(kind))
      refuse(given.erosion.front(), "part", fmt::format("scheme.kind = \"{}\"", traits(kind).name),
             "an explicit scheme with the masses of the bodies in all stages",
             "Take \"central_differences\", where cells may go at the end of a step.");
    if (stage->mass().kind() != MassKind::lumped)
      refuse(given.erosion.front(), "part", "a consistent mass", "scheme.mass = \"lumped\"",
             "The mass of a cell that has gone stays with its nodes.");
  }
}

}  // namespace carom
