#include "casefile/case_schema.hpp"
#include "casefile/section_rules.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

const std::vector<std::string> table_key{"table"};
const std::vector<std::string> step{"step"};

/// The kind decides how the function is written; what is kept is the table it makes.
void add_kind(SectionSchema<CaseFunction>& s) {
  const KeyDescription key{
      "kind",
      Shape::text,
      "A table, linear between its entries; a step from one value to another; or called: what a "
      "program computes that uses Carom as a library (docs/python.md), and which it alone can run.",
      {.choices = {"table", "step", "called"}},
      Node{std::string("table"), {}},
      {}};
  SectionSchema<CaseFunction>::Handlers handlers;
  handlers.read = [](CaseFunction& f, const Node& node, const ReadContext&) {  // already judged as the selector
    f.is_called = std::get<std::string>(node.value) == "called";
  };
  handlers.write = [](const CaseFunction& f, const Node&) {
    return Node{std::string(f.is_called ? "called" : "table"), {}};
  };
  s.add(key, handlers);
}

/// Before and after the jump, whose time may be missing.
std::vector<double>& values_of_step(TimeFunction& f) {
  f.value.resize(2);
  return f.value;
}

/// A number of a step; written as a table, so there is nothing to write here.
template <class Store>
void add_step_number(SectionSchema<CaseFunction>& s, const KeyDescription& key, Store store) {
  SectionSchema<CaseFunction>::Handlers handlers;
  handlers.read = [key, store](CaseFunction& f, const Node& node, const ReadContext& at) {
    double number = 0.0;
    decode(node, key, at, number);
    store(f.function, number);
  };
  handlers.write = [](const CaseFunction&, const Node&) { return std::nullopt; };
  s.add(key, handlers);
}

}  // namespace

SectionSchema<CaseFunction> function_section() {
  const KeyOptions number{.kinds = step, .need = Need::required};
  const KeyOptions time{.unit = Dimension::time, .kinds = step, .need = Need::required};
  SectionSchema<CaseFunction> s("A function of time for loads and imposed motions.");
  s.description.selector = "kind";
  s.description.default_kind = "table";
  add_kind(s);
  s.key_by(
      "time", [](auto& f) -> auto& { return f.function.time; },
      "Times in increasing order; the same time twice makes a jump; of a load, a static stage that ends there has the value before it. The first and last values hold before and after.",
      {.unit = Dimension::time, .kinds = table_key, .need = Need::required});
  s.key_by("value", [](auto& f) -> auto& { return f.function.value; }, "One value for each time.",
           {.kinds = table_key, .need = Need::required});
  add_step_number(s, {"time", Shape::number, "Time of the jump.", time, {}, {}}, [](TimeFunction& f, double t) {
    f.time = {t, t};
    values_of_step(f);
  });
  add_step_number(s, {"before", Shape::number, "Value before it.", number, {}, {}},
                  [](TimeFunction& f, double value) { values_of_step(f)[0] = value; });
  add_step_number(s, {"after", Shape::number, "Value from it on.", number, {}, {}},
                  [](TimeFunction& f, double value) { values_of_step(f)[1] = value; });
  s.finish = check_function;
  return s;
}

}  // namespace carom
