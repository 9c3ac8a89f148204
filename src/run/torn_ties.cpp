#include "run/torn_ties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.hpp"
#include "contact/admissible.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

const Location& place_of(const Case& given, const ConstraintRows& bonds, std::size_t r) {
  return bonds.source[r] < 0 ? given.equations.front().where
                             : given.contacts[static_cast<std::size_t>(bonds.source[r])].where;
}

void refuse(const Case& given, const ContactGeometry& contact, const ConstraintRows& bonds, std::span<const double> x,
            const std::string& what, const std::string& remedy) {
  constexpr double rounding = 1e-9;
  double largest = 0.0;
  for (const double entry : x) largest = std::max(largest, std::abs(entry));
  for (std::size_t r = 0; r < bonds.size(); ++r) {
    const double parting = norm(bonds.relative(r, x));
    if (parting <= rounding * largest) continue;
    if (is_equation(bonds.law[r]))
      throw CaseError(place_of(given, bonds, r), "equation",
                      fmt::format("initial {} that break {}, by {:.4g}", what, contact.describe(bonds, r), parting),
                      "initial values that satisfy the equations, with what is imposed at the start");
    throw CaseError(
        place_of(given, bonds, r), "contact",
        fmt::format("initial {} that part what is tied, by {:.4g}: {}", what, parting, contact.describe(bonds, r)),
        "initial values that both sides of a tie share", remedy);
  }
}

}  // namespace

void refuse_torn_ties(const Case& given, const ContactGeometry& contact, std::span<const double> displacement,
                      std::span<const double> velocity) {
  refuse(given, contact, contact.bonds(), displacement, "displacements",
         "Give the nodes of both parts the same motion.");
  refuse(given, contact, contact.bonds(), velocity, "velocities",
         "Give both parts the same velocity. Bodies that come together first and stay so are contact, not a tie.");
}

void refuse_broken_equations(const Case& given, const ContactGeometry& contact, std::span<const double> velocity) {
  refuse(given, contact, contact.equations(), velocity, "velocities, those that supports impose among them,", "");
}

void refuse_floating_ties(const Case& given, const ContactGeometry& contact, EnforcementKind enforcement,
                          const std::vector<std::vector<Index>>& free_bodies, std::size_t nodes) {
  std::vector<bool> floats(nodes, false);
  for (const std::vector<Index>& body : free_bodies)
    for (const Index n : body) floats[static_cast<std::size_t>(n)] = true;
  const ConstraintRows& bonds = contact.bonds();
  for (std::size_t r = 0; r < bonds.size(); ++r) {
    const auto begin = bonds.node.begin() + bonds.begin[r], end = bonds.node.begin() + bonds.begin[r + 1];
    const auto can_move = [&](Index n) { return floats[static_cast<std::size_t>(n)]; };
    const Location& where = place_of(given, bonds, r);
    const bool is_of_equation = is_equation(bonds.law[r]);
    const char *key = is_of_equation ? "equation" : "contact", *what = is_of_equation ? "an equation" : "a tie";
    if (enforcement == EnforcementKind::lagrange && std::any_of(begin, end, can_move))
      throw CaseError(where, key,
                      fmt::format("{}, in statics with enforcement = \"lagrange\", that alone holds a body", what),
                      "bodies that supports hold, or another enforcement",
                      "Take enforcement = \"penalty\" or \"augmented_lagrangian\".");
    if (!std::all_of(begin, end, can_move)) continue;
    throw CaseError(where, key, fmt::format("{}, in statics, between bodies that no support holds", what),
                    "one of the two held by supports in all directions",
                    "Give one of them supports, make one mesh of both, or take a scheme with inertia.");
  }
}

}  // namespace carom
