// *EQUATION.
#include <fmt/format.h>

#include <algorithm>

#include "deck/deck_cursor.hpp"
#include "math/vec3.hpp"
#include "translate/rigid.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

/// The nodes of a group by their numbers, which is how Abaqus pairs the nodes of sets.
std::vector<Index> by_number(const Translation& t, const std::string& group) {
  std::vector<Index> nodes = t.mesh.mesh.nodes_of(group);
  std::ranges::sort(nodes, {}, [&](Index n) { return t.mesh.mesh.node_numbers[carom::at(n)]; });
  return nodes;
}

/// Carom pairs them by their places: where that gives others, the set cannot stand.
void refuse_other_order(const Translation& t, const DeckCursor& at, const std::string& first,
                        const std::string& group) {
  const std::vector<Index> a = by_number(t, first), b = by_number(t, group);
  if (a.size() < 2 || a.size() != b.size()) return;
  const std::vector<Vec3>& X = t.mesh.mesh.coordinates;
  Vec3 shift{};
  for (std::size_t k = 0; k < a.size(); ++k) shift = add(shift, subtract(X[carom::at(b[k])], X[carom::at(a[k])]));
  shift = scaled(shift, 1.0 / static_cast<double>(a.size()));
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec3 place = add(X[carom::at(a[k])], shift);
    const Index nearest =
        *std::ranges::min_element(b, {}, [&](Index n) { return norm(subtract(X[carom::at(n)], place)); });
    if (nearest != b[k])
      at.fail(
          fmt::format("the sets {} and {}, whose nodes do not lie alike in the order of their numbers", first, group),
          "sets that are shifted copies of each other", "Write an equation for each pair of nodes.");
  }
}

/// The number of terms on a line of its own; then node or set, degree of freedom and coefficient of each term, four on
/// a line (Abaqus, Keywords Guide; CalculiX, *EQUATION).
void translate_equation(Translation& t, const Statement& s) {
  DeckCursor at(*s.keyword);
  while (at.next_line()) {
    const Location where = at.where();
    const std::int64_t count = at.integer("the number of terms");
    if (count < 1) at.fail(fmt::format("{} terms", count), "one at least");
    at.end_line("the number of terms alone");
    List terms;
    std::string first;
    for (std::int64_t k = 0; k < count; ++k) {
      if (k == 0 || at.at_end())
        if (!at.next_line()) s.keyword->fail(fmt::format("{} terms of {}", k, count), "as many as the first line says");
      std::string_view target = at.field();
      if (target.empty()) {  // a line that ends with a comma
        if (!at.next_line()) s.keyword->fail(fmt::format("{} terms of {}", k, count), "as many as the first line says");
        target = at.field();
      }
      const std::string nodes = t.node_group(at, s, target);
      if (!referred_to(t, nodes).bodies.empty())
        at.fail(fmt::format("\"{}\", the reference node of a rigid body", target), "nodes of deformable bodies");
      if (terms.empty()) first = nodes;
      refuse_other_order(t, at, first, nodes);
      const std::int64_t dof = at.integer("the degree of freedom");
      if (dof < 1 || dof > 3)
        at.fail(fmt::format("degree of freedom {}", dof), "1, 2 or 3", "Nodes of solids do not turn.");
      TableMaker term(at.where());
      term.text("nodes", nodes).text("dof", std::string(1, static_cast<char>('w' + dof)));
      terms.push_back(term.number("coefficient", at.real("the coefficient")).node());
    }
    TableMaker equation(where);
    t.append("equation", equation.add("terms", {std::move(terms), where}).node());
  }
}

}  // namespace

void translate_equations(Translation& t) {
  for (std::size_t i = 0; i < t.statements.list.size(); ++i) {
    const Statement& s = t.statements.list[i];
    if (s.keyword->name != "EQUATION") continue;
    if (!t.steps.empty() && i > t.steps[0].begin)
      t.findings.refuse(*s.keyword, s.keyword->where, "an equation within a step", "It would be there from the start.");
    t.errors.attempt([&] { translate_equation(t, s); });
  }
}

}  // namespace carom
