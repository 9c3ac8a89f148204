#include "casefile/case_schema.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

SectionSchema<CaseEquation::Term> term_section() {
  SectionSchema<CaseEquation::Term> s("A term: coefficient times a component of the displacement.");
  s.key("nodes", &CaseEquation::Term::nodes, "Group of nodes.", {.need = Need::required});
  s.key("dof", &CaseEquation::Term::dof, "Component of the displacement.", {.choices = kAxes, .need = Need::required});
  s.key("coefficient", &CaseEquation::Term::coefficient, "Coefficient, not zero.", {.need = Need::required});
  return s;
}

void check_equation(CaseEquation& equation, const Node&, const ReadContext& at) {
  if (equation.terms.empty())
    throw CaseError(equation.where, at.at("terms").path, "an equation without terms", "one term at least");
  for (const CaseEquation::Term& term : equation.terms) {
    if (*term.coefficient != 0.0) continue;
    throw CaseError(term.coefficient.where, at.at("terms").path, "the coefficient 0", "another number",
                    "Leave the term out.");
  }
}

}  // namespace

SectionSchema<CaseEquation> equation_section() {
  SectionSchema<CaseEquation> s(
      "A linear homogeneous equation between displacements, exact in every scheme: the sum over the terms of "
      "coefficient times displacement is zero. The displacement of the first term is the dependent one: it must not be "
      "imposed, nor be the dependent one of another equation, and no equation may follow from others. Groups of "
      "several nodes stand for as many equations: all "
      "terms have one node or as many as the first, matched by their places about the middle of each group.");
  s.key("name", &CaseEquation::name, "For messages.", {.default_phrase = "its number and line"});
  s.tables("terms", &CaseEquation::terms, term_section(), {.need = Need::required});
  s.finish = check_equation;
  return s;
}

}  // namespace carom
