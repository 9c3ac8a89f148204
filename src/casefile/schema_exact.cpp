#include <algorithm>

#include "casefile/case_schema.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

/// The solutions that pass.
template <class Takes>
std::vector<std::string> solutions_that(const Takes& takes) {
  std::vector<std::string> names;
  for (const ExactSolution& solution : exact_solutions())
    if (takes(solution)) names.push_back(solution.name);
  return names;
}

std::string summaries_of_exact() {
  std::string text;
  for (const ExactSolution& solution : exact_solutions())
    text += (text.empty() ? "`" : "; `") + solution.name + "`: " + solution.summary;
  return text;
}

/// A parameter as a key of the solutions that take it in this form. `section`: "", or that of another body.
void add_parameter(SectionSchema<CaseExact>& s, const ExactParameter& parameter, const std::string& section,
                   const std::vector<std::string>& kinds) {
  KeyDescription key{parameter.key, Shape::number, parameter.meaning, {}, {}, {}};
  key.options = {.unit = parameter.unit,
                 .range = range_of(parameter.range),
                 .kinds = kinds,
                 .need = parameter.initial ? Need::optional : Need::required};
  if (parameter.initial) key.default_value = Node{*parameter.initial, {}};
  const std::string name = section.empty() ? parameter.key : section + "." + parameter.key;
  SectionSchema<CaseExact>::Handlers handlers;
  handlers.read = [key, name](CaseExact& exact, const Node& node, const ReadContext& at) {
    decode(node, key, at, exact.values[name]);
  };
  handlers.write = [options = key.options, name](const CaseExact& exact, const Node&) {
    return encode(exact.values.at(name), options);
  };
  handlers.absent = [initial = parameter.initial, name](CaseExact& exact, const ReadContext&, const Location&) {
    exact.values[name] = initial.value_or(0.0);
  };
  s.add(std::move(key), std::move(handlers));
}

void add_parameters(SectionSchema<CaseExact>& s) {
  std::vector<ExactParameter> added;
  for (const ExactSolution& solution : exact_solutions()) {
    for (const ExactParameter& parameter : solution.parameters) {
      if (std::ranges::find(added, parameter) != added.end()) continue;
      added.push_back(parameter);
      add_parameter(s, parameter, "", solutions_that([&](const ExactSolution& other) {
                      return std::ranges::find(other.parameters, parameter) != other.parameters.end();
                    }));
    }
  }
}

/// [exact.BODY] of a solution, whose values stand beside those of [exact].
void add_body(SectionSchema<CaseExact>& s, const ExactSolution& solution, const ExactBody& body) {
  SectionSchema<CaseExact> keys("With " + solution.name + ": " + body.meaning);
  for (const ExactParameter& parameter : body.parameters) add_parameter(keys, parameter, body.key, {});
  KeyDescription key{body.key, Shape::section, keys.description.doc, {}, {}, {}};
  key.options = {.kinds = {solution.name}, .need = Need::required};
  key.section = std::make_shared<const SectionDescription>(keys.description);
  SectionSchema<CaseExact>::Handlers handlers;
  handlers.read = [keys](CaseExact& exact, const Node& node, const ReadContext& at) { keys.read(exact, node, at); };
  handlers.write = [keys](const CaseExact& exact, const Node& root) { return keys.write(exact, &root); };
  s.add(std::move(key), std::move(handlers));
}

}  // namespace

SectionSchema<CaseExact> exact_section() {
  SectionSchema<CaseExact> s("Exact solution of the case, for checks and curves; the motion is along one axis. " +
                             summaries_of_exact() + ".");
  s.description.selector = "solution";
  s.key("solution", &CaseExact::solution, "Which solution.",
        {.choices = solutions_that([](const ExactSolution&) { return true; }), .need = Need::required});
  add_parameters(s);
  for (const ExactSolution& solution : exact_solutions())
    for (const ExactBody& body : solution.bodies) add_body(s, solution, body);
  s.key("axis", &CaseExact::axis,
        "Axis of the motion. A bar or sphere flies in the negative direction; of two bars the first part lies on the "
        "negative side.",
        {.choices = {"x", "y", "z"}});
  return s;
}

}  // namespace carom
