#include "build/redundant_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>
#include <vector>

#include "base/errors.hpp"
#include "contact/contact_kind.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

/// Nodes of parts of which some component can move.
std::vector<char> moving_nodes(const Model& model) {
  std::vector<char> free_components(model.mesh->node_count(), 0);
  for (const Part& part : model.parts) {
    const auto n = static_cast<std::size_t>(node_count(part.type));
    const std::vector<Index>& connectivity = model.mesh->block(part.type)->connectivity;
    for (const Index cell : part.cells)
      for (std::size_t a = 0; a < n; ++a)
        free_components[static_cast<std::size_t>(connectivity[n * static_cast<std::size_t>(cell) + a])] = 7;
  }
  for (const PrescribedMotion& motion : model.motions) {
    const auto& value = motion.function.value;
    if (!is_zero(value)) continue;
    for (const Index n : motion.nodes) {
      char& free = free_components[static_cast<std::size_t>(n)];
      free = static_cast<char>(static_cast<unsigned>(free) & ~(1U << static_cast<unsigned>(motion.component)));
    }
  }
  return free_components;
}

}  // namespace

void refuse_redundant_contacts(const Case& given, const Model& model) {
  // Contact of all with all has no faces that a tie holds.
  const auto is_tie_beside_all = [&](std::size_t tie, std::size_t all) {
    return std::holds_alternative<TieContact>(model.contacts[tie]) &&
           std::holds_alternative<CaseAll>(given.contacts[all].of);
  };
  for (std::size_t j = 1; j < model.contacts.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      if (is_tie_beside_all(i, j) || is_tie_beside_all(j, i)) continue;
      const std::size_t overlap = shared_places(model.contacts[i], model.contacts[j]);
      if (overlap == 0) continue;
      const CaseContact &first = given.contacts[i], &second = given.contacts[j];
      throw CaseError(second.where, "contact",
                      fmt::format("\"{}\" between surfaces that \"{}\" (line {}) sees already, on {} of their pieces",
                                  *second.name, *first.name, first.where.line, overlap),
                      "every pair of surfaces in one contact",
                      "Twice the same contact is twice as stiff, and multipliers have no single value: remove one, or "
                      "`exclude` its faces from kind = \"all\".");
    }
  }
}

void refuse_faces_of_parts(const Case& given, const Model& model) {
  const std::vector<char> moves = moving_nodes(model);
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const RigidShape* shape = parts_of(model.contacts[c]).shape;
    const auto* rigid = shape == nullptr ? nullptr : std::get_if<RigidSurface>(shape);
    if (rigid == nullptr) continue;
    for (const Facet& facet : rigid->surface.facets) {
      const auto is_free = [&](Index n) { return moves[static_cast<std::size_t>(n)] != 0; };
      if (!std::all_of(facet.begin(), facet.end(), is_free)) continue;
      const Located<std::string>& surface = *given.contacts[c].own_cells();
      throw CaseError(surface.where, "contact.surface",
                      fmt::format("faces of a part that can move in \"{}\", such as that of node {}", *surface,
                                  model.mesh->node_label(facet[0])),
                      "faces that belong to no part, or to one that is held",
                      "A rigid surface stays where it is; contact with a part is kind = \"pair\".");
    }
  }
}

}  // namespace carom
