#include "build/equations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "build/attached.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

constexpr const char* nodes_key = "equation.terms.nodes";

using Dof = std::pair<Index, int>;

/// Elimination of equations as they come: which of them say nothing that those before do not say.
class Elimination {
 public:
  using Row = std::map<Dof, double>;

  /// Takes the terms of dofs that are free, `first` being the one to be eliminated if it can. False when the equations
  /// before leave none of them.
  bool add(Row row, const Dof& first) {
    constexpr double rounding = 1e-10;
    double scale = 0.0;
    std::set<std::size_t> pending;  // equations whose pivots the row has; none brings back the pivot of one before it
    const auto look_at = [&](const Dof& dof) {
      const auto found = number_.find(dof);
      if (found != number_.end()) pending.insert(found->second);
    };
    for (const auto& [dof, coefficient] : row) {
      scale = std::max(scale, std::abs(coefficient));
      look_at(dof);
    }
    while (!pending.empty()) {
      const auto& [pivot, eliminated] = rows_[*pending.begin()];
      pending.erase(pending.begin());
      const double factor = row[pivot] / eliminated.at(pivot);
      for (const auto& [dof, coefficient] : eliminated) {
        row[dof] -= factor * coefficient;
        if (dof != pivot) look_at(dof);
      }
      row.erase(pivot);
    }
    std::erase_if(row, [&](const auto& term) { return std::abs(term.second) <= rounding * scale; });
    if (row.empty()) return false;
    Dof pivot = first;
    if (!row.contains(first))
      pivot = std::ranges::max_element(row, {}, [](const auto& term) { return std::abs(term.second); })->first;
    number_.emplace(pivot, rows_.size());
    rows_.emplace_back(pivot, std::move(row));
    return true;
  }

 private:
  std::vector<std::pair<Dof, Row>> rows_;  ///< each with its pivot
  std::map<Dof, std::size_t> number_;      ///< of the row by its pivot
};

class Equations {
 public:
  Equations(const Mesh& mesh, const Groups& groups, const Parts& parts, Model& model)
      : mesh_(mesh), groups_(groups), parts_(parts), model_(model) {
    for (const PrescribedMotion& motion : model.motions)
      for (const Index n : motion.nodes) imposed_.emplace(Dof{n, motion.component}, motion.name);
  }

  void add(const CaseEquation& given, std::size_t number) {
    const std::string name =
        fmt::format("equation {}", given.name.empty() ? fmt::format("{} (line {})", number + 1, given.where.line)
                                                      : '"' + given.name + '"');
    std::vector<std::vector<Index>> nodes;  // of each term
    for (const CaseEquation::Term& term : given.terms) {
      nodes.push_back(groups_.nodes(term.nodes, nodes_key));
      refuse_without_mass(term, nodes.back());
      if (nodes.size() > 1) match(given, nodes.front(), term, nodes.back());
    }
    for (std::size_t k = 0; k < nodes.front().size(); ++k) {
      LinearEquation equation;
      equation.where = given.where;
      equation.name =
          nodes.front().size() == 1 ? name : fmt::format("{} at node {}", name, this->number(nodes.front()[k]));
      std::set<Dof> seen;
      for (std::size_t t = 0; t < given.terms.size(); ++t) {
        const CaseEquation::Term& term = given.terms[t];
        const Index node = nodes[t].size() == 1 ? nodes[t][0] : nodes[t][k];
        const int component = (*term.dof)[0] - 'x';
        if (!seen.insert({node, component}).second)
          throw CaseError(term.nodes.where, nodes_key,
                          fmt::format("{} of node {} twice in one equation", *term.dof, this->number(node)),
                          "every displacement once", "Do the groups share nodes?");
        equation.terms.push_back({node, component, *term.coefficient});
      }
      refuse_dependent(given, equation);
      refuse_redundant(given, equation);
      model_.equations.push_back(std::move(equation));
    }
  }

 private:
  const Vec3& X(Index node) const { return mesh_.coordinates[static_cast<std::size_t>(node)]; }
  std::string number(Index node) const { return mesh_.node_label(node); }

  void refuse_without_mass(const CaseEquation::Term& term, const std::vector<Index>& nodes) const {
    for (const Index node : nodes) {
      if (parts_.hold(node) || has_point_mass(model_, node)) continue;
      throw CaseError(term.nodes.where, nodes_key,
                      fmt::format("node {} of \"{}\", which belongs to no part", number(node), *term.nodes),
                      "nodes of parts, or nodes with a [[point_mass]]");
    }
  }

  Vec3 middle(const std::vector<Index>& nodes) const {
    Vec3 sum{};
    for (const Index n : nodes) sum = carom::add(sum, X(n));
    return scaled(sum, 1.0 / static_cast<double>(nodes.size()));
  }

  /// Orders the nodes of a term as those of the first.
  void match(const CaseEquation& given, const std::vector<Index>& first, const CaseEquation::Term& term,
             std::vector<Index>& nodes) const {
    if (nodes.size() == 1) return;
    const std::string& name = *given.terms.front().nodes;
    if (nodes.size() != first.size())
      throw CaseError(
          term.nodes.where, nodes_key,
          fmt::format("{} nodes in \"{}\" against {} in \"{}\"", nodes.size(), *term.nodes, first.size(), name),
          "one node, or as many as the first term has");
    const Vec3 shift = subtract(middle(nodes), middle(first));
    std::vector<Index> ordered;
    std::set<Index> taken;
    for (const Index node : first) {
      const Vec3 place = carom::add(X(node), shift);
      const Index other = *std::ranges::min_element(nodes, {}, [&](Index n) { return norm(subtract(X(n), place)); });
      if (!taken.insert(other).second)
        throw CaseError(
            term.nodes.where, nodes_key,
            fmt::format("node {} of \"{}\", which is the nearest to two nodes of \"{}\" shifted onto it, {} "
                        "being one",
                        number(other), *term.nodes, name, number(node)),
            "groups whose nodes lie alike", "Give each pair an [[equation]] of its own.");
      ordered.push_back(other);
    }
    nodes = std::move(ordered);
  }

  void refuse_dependent(const CaseEquation& given, const LinearEquation& equation) {
    const LinearEquation::Term& first = equation.terms.front();
    const Dof dof{first.node, first.component};
    const std::string what = fmt::format("{} of node {}", "xyz"[first.component], number(first.node));
    const Location& where = given.terms.front().nodes.where;
    const auto is_imposed = [&](const LinearEquation::Term& t) { return imposed_.contains({t.node, t.component}); };
    const char* remedy = std::ranges::all_of(equation.terms, is_imposed)
                             ? "All that it couples is imposed: remove the equation, or the supports."
                             : "Begin the equation with another term.";
    const auto imposed = imposed_.find(dof);
    if (imposed != imposed_.end())
      throw CaseError(where, nodes_key,
                      fmt::format("{}, which the first term makes dependent and {} imposes", what, imposed->second),
                      "a first term that is free", remedy);
    if (!dependent_.insert(dof).second)
      throw CaseError(where, nodes_key, fmt::format("{}, which is the dependent one of another equation as well", what),
                      "a displacement of its own to begin with",
                      "Begin the equation with another term, or leave the node out of one of the groups.");
  }

  /// What follows from others, or contradicts what supports impose by them.
  void refuse_redundant(const CaseEquation& given, const LinearEquation& equation) {
    Elimination::Row free;
    for (const LinearEquation::Term& term : equation.terms)
      if (!imposed_.contains({term.node, term.component})) free[{term.node, term.component}] = term.coefficient;
    const LinearEquation::Term& first = equation.terms.front();
    if (elimination_.add(std::move(free), {first.node, first.component})) return;
    throw CaseError(given.where, "equation",
                    fmt::format("{}, all of whose displacements the equations before it and the supports decide about",
                                equation.name),
                    "equations none of which follows from the others or contradicts them", "Remove one of them.");
  }

  const Mesh& mesh_;
  const Groups& groups_;
  const Parts& parts_;
  Model& model_;
  std::map<Dof, std::string> imposed_;
  std::set<Dof> dependent_;
  Elimination elimination_;
};

}  // namespace

void add_equations(const Case& given, const Mesh& mesh, const Groups& groups, const Parts& parts, Model& model) {
  Equations equations(mesh, groups, parts, model);
  for (std::size_t k = 0; k < given.equations.size(); ++k) equations.add(given.equations[k], k);
}

}  // namespace carom
