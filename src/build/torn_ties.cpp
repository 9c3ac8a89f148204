#include "build/torn_ties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.hpp"
#include "math/vec3.hpp"
#include "rows/admissible.hpp"

namespace carom {

namespace {

const Location& place_of(const Case& given, const Model& model, const ConstraintRows& bonds, std::size_t r) {
  const Index source = bonds.source[r];
  if (source >= 0) return given.contacts[static_cast<std::size_t>(source)].where;
  return model.equations[static_cast<std::size_t>(-1 - source)].where;
}

double largest(std::span<const double> x) {
  double most = 0.0;
  for (const double entry : x) most = std::max(most, std::abs(entry));
  return most;
}

/// Larger than what rounding makes of values up to `scale`.
bool parts(const ConstraintRows& bonds, std::size_t r, std::span<const double> x, double scale) {
  constexpr double rounding = 1e-9;
  return norm(bonds.relative(r, x)) > rounding * scale;
}

void refuse_ties(const Case& given, const Model& model, const ContactGeometry& contact, std::span<const double> x,
                 const std::string& what, const std::string& remedy) {
  const ConstraintRows& bonds = contact.bonds();
  const double scale = largest(x);
  for (std::size_t r = 0; r < bonds.size(); ++r) {
    if (is_equation(bonds.law[r]) || !parts(bonds, r, x, scale)) continue;
    throw CaseError(place_of(given, model, bonds, r), "contact",
                    fmt::format("initial {} that part what is tied, by {:.4g}: {}", what, norm(bonds.relative(r, x)),
                                contact.describe(bonds, r)),
                    "initial values that both sides of a tie share", remedy);
  }
}

void refuse_equations(const Case& given, const Model& model, const ContactGeometry& contact, std::span<const double> x,
                      const std::string& what, const std::string& remedy) {
  const ConstraintRows& rows = contact.equations();
  const double scale = largest(x);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (!parts(rows, r, x, scale)) continue;
    const LinearEquation& equation = model.equations[static_cast<std::size_t>(-1 - rows.source[r])];
    const LinearEquation::Term& first = equation.terms.front();
    const double now = x[3 * static_cast<std::size_t>(first.node) + static_cast<std::size_t>(first.component)];
    throw CaseError(place_of(given, model, rows, r), "equation",
                    fmt::format("initial {} that break {}: {:.4g} along {} at node {}", what, equation.name, now,
                                "xyz"[first.component], model.mesh->node_label(first.node)),
                    fmt::format("{:.4g} there, as the other terms ask", now - rows.relative(r, x)[0]), remedy);
  }
}

}  // namespace

void refuse_torn_ties(const Case& given, const Model& model, const ContactGeometry& contact,
                      std::span<const double> displacement, std::span<const double> velocity) {
  refuse_ties(given, model, contact, displacement, "displacements", "Give the nodes of both parts the same motion.");
  refuse_ties(given, model, contact, velocity, "velocities",
              "Give both parts the same velocity. Bodies that come together first and stay so are contact, not a tie.");
}

void refuse_broken_equations(const Case& given, const Model& model, const ContactGeometry& contact,
                             std::span<const double> displacement, std::span<const double> velocity) {
  refuse_equations(given, model, contact, displacement, "displacements", "Give it by an [[initial]] of that node.");
  refuse_equations(given, model, contact, velocity, "velocities (with those that supports impose at the start)",
                   "Give it by an [[initial]] of that node, or let the imposed velocity begin at zero.");
}

void refuse_parting_velocities(const Case& given, const Model& model, const ContactGeometry& contact, std::size_t stage,
                               std::span<const double> velocity, const std::vector<Velocity>& known) {
  const ConstraintRows& bonds = contact.bonds();
  const double scale = largest(velocity);
  for (std::size_t r = 0; r < bonds.size(); ++r) {
    if (!any_dof(bonds, r, [&](std::size_t i) { return known[i] == Velocity::given; })) continue;
    const bool is_part = any_dof(bonds, r, [&](std::size_t i) { return known[i] == Velocity::unknown; });
    if (!is_part && !parts(bonds, r, velocity, scale)) continue;
    throw CaseError(
        place_of(given, model, bonds, r), bonds.source[r] < 0 ? "equation" : "contact",
        fmt::format("velocities that begin with stage[{}] and {} {}", stage - 1,
                    is_part ? "are given to some only of the nodes of" : "break", contact.describe(bonds, r)),
        "velocities of all nodes that it couples, which satisfy it",
        "Give all of them theirs by an [[stage.initial]].");
  }
}

void refuse_floating_ties(const Case& given, const Model& model, const ContactGeometry& contact,
                          EnforcementKind enforcement, const std::vector<std::vector<Index>>& free_bodies,
                          std::size_t nodes) {
  std::vector<bool> floats(nodes, false);
  for (const std::vector<Index>& body : free_bodies)
    for (const Index n : body) floats[static_cast<std::size_t>(n)] = true;
  const ConstraintRows& bonds = contact.bonds();
  for (std::size_t r = 0; r < bonds.size(); ++r) {
    const auto begin = bonds.node.begin() + bonds.begin[r], end = bonds.node.begin() + bonds.begin[r + 1];
    const auto can_move = [&](Index n) { return floats[static_cast<std::size_t>(n)]; };
    const Location& where = place_of(given, model, bonds, r);
    const bool is_of_equation = is_equation(bonds.law[r]);
    const char *key = is_of_equation ? "equation" : "contact", *what = is_of_equation ? "an equation" : "a tie";
    if (enforcement == EnforcementKind::lagrange && std::any_of(begin, end, can_move))
      throw CaseError(where, key,
                      fmt::format("{}, in statics with enforcement = \"lagrange\", that alone holds a body", what),
                      "bodies that supports hold, or another enforcement",
                      "Take enforcement = \"penalty\" or \"augmented_lagrangian\".");
    if (!std::all_of(begin, end, can_move)) continue;
    if (is_of_equation)
      throw CaseError(where, key,
                      fmt::format("{}, in statics, all of whose nodes are of bodies that supports let move or turn",
                                  contact.describe(bonds, r)),
                      "one of the bodies held by supports against moving and turning",
                      "Add supports (of a periodic cell: of one corner in all directions, and of others against "
                      "turning), or take a scheme with inertia.");
    throw CaseError(where, key, "a tie, in statics, between bodies that no support holds",
                    "one of the two held by supports in all directions",
                    "Give one of them supports, make one mesh of both, or take a scheme with inertia.");
  }
}

}  // namespace carom
