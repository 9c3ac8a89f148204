// *STEP, *STATIC and *DYNAMIC as stages.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword_table.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

bool says_yes(const std::string* value) {
  return value != nullptr && upper_case(*value) != "NO";
}

void read_times(DeckStep& step) {
  DeckCursor at(*step.procedure);
  step.period = 1.0;
  bool has_period = false;
  if (at.next_line()) {
    const double increment = at.real_or(0.0, "the increment of time");
    const bool says_period = !at.at_end();
    step.period = at.real_or(1.0, "the time of the step");
    has_period = says_period;
    if (increment > 0.0) step.increment = increment;
    if (increment < 0.0 || !(step.period > 0.0))
      at.fail(fmt::format("increment {}, time {}", increment, step.period), "positive times");
    if (step.increment && !says_period) step.period = std::max(1.0, increment);
    const double smallest = at.real_or(0.0, "the smallest increment");
    if (smallest > 0.0) step.smallest = smallest;
  }
  if (step.is_explicit_abaqus() && !has_period)
    step.procedure->fail("no time of the step", "it as the second number of the data line: `, 1.0e-3`",
                         "The first number is an increment, which the program finds itself.");
  if (!step.increment && step.kind == DeckStep::Kind::statics) step.increment = step.period;
  if (!step.increment && step.kind == DeckStep::Kind::implicit_dynamics)
    step.procedure->fail("no increment of time", "increment, time in its data line",
                         "An implicit step needs the size of its increments.");
}

constexpr double strongest_alpha = -1.0 / 3.0;

/// What Abaqus' implicit steps integrate by, called by their application or by the integrator itself, and the nearest
/// alpha of hht ("Implicit dynamic analysis using direct integration" of its Analysis User's Guide).
struct Integrator {
  std::string_view application, name;
  double alpha = -0.05;
  std::string_view remark{};
  bool is_backward_euler = false;
};

constexpr std::array<Integrator, 3> integrators{{
    {"TRANSIENTFIDELITY", "HHT-TF"},
    {"MODERATEDISSIPATION", "HHT-MD", strongest_alpha,
     "hht with alpha -1/3, which dissipates most; Abaqus has -0.41421 with beta 0.5, gamma 0.91421"},
    {"QUASI-STATIC", "BWE", strongest_alpha, {}, true},
}};

const Integrator* integrator_of(const DeckKeyword& keyword) {
  const Integrator* found = nullptr;
  for (const auto& [parameter, name] :
       {std::pair("APPLICATION", &Integrator::application), std::pair("TIME INTEGRATOR", &Integrator::name)}) {
    const std::string* given = keyword.parameter(parameter);
    if (given == nullptr) continue;
    found = std::ranges::find(integrators, without_blanks(*given), name);
    if (found != integrators.end()) continue;
    std::vector<std::string_view> known;
    for (const Integrator& integrator : integrators) known.push_back(integrator.*name);
    keyword.fail(fmt::format("{}={}", parameter, *given), fmt::format("{}", fmt::join(known, ", ")));
  }
  return found;
}

void read_integrator(Translation& t, DeckStep& step) {
  const DeckKeyword& keyword = *step.procedure;
  const Integrator* integrator = integrator_of(keyword);
  if (integrator == nullptr || step.kind != DeckStep::Kind::implicit_dynamics) return;
  step.alpha = integrator->alpha;
  if (!integrator->remark.empty() && !keyword.has("ALPHA"))
    t.findings.note(keyword.where, std::string(integrator->remark));
  if (!integrator->is_backward_euler) return;
  step.ramps = step.ramps || (keyword.has("APPLICATION") && !step.step->has("AMPLITUDE"));
  t.findings.refuse(keyword, keyword.where, "the backward Euler method, which takes most of the motion away",
                    "Bodies would swing as hht with alpha -1/3 lets them: write *STATIC where they rest at the end.");
}

void read_procedure(Translation& t, DeckStep& step, const DeckKeyword& keyword) {
  if (step.procedure != nullptr)
    keyword.fail(
        fmt::format("*{} beside the *{} of line {}", keyword.name, step.procedure->name, step.procedure->where.line),
        "one procedure in a step");
  step.procedure = &keyword;
  const bool is_static = keyword.name == "STATIC";
  step.kind = is_static                 ? DeckStep::Kind::statics
              : keyword.has("EXPLICIT") ? DeckStep::Kind::explicit_dynamics
                                        : DeckStep::Kind::implicit_dynamics;
  step.ramps = is_static;
  if (const std::string* amplitude = step.step->parameter("AMPLITUDE")) {
    const std::string kind = upper_case(*amplitude);
    if (kind != "RAMP" && kind != "STEP") step.step->fail("AMPLITUDE=" + kind, "RAMP or STEP");
    step.ramps = kind == "RAMP";
  }
  const std::string* nlgeom = step.step->parameter("NLGEOM");
  step.is_finite = nlgeom != nullptr ? says_yes(nlgeom) : step.is_explicit_abaqus();
  read_integrator(t, step);
  read_times(step);
}

/// FACTOR, 1 where there is none.
double factor_of(const DeckKeyword& keyword) {
  const std::string* given = keyword.parameter("FACTOR");
  const auto factor = given == nullptr ? std::optional(1.0) : as_real(*given);
  if (!factor || !(*factor > 0.0)) keyword.fail("FACTOR=" + *given, "a number above 0");
  return *factor;
}

/// Is ELSET not given, or are all cells of parts in it?
bool acts_on_all(const Translation& t, const Statement& s) {
  if (!s.keyword->has("ELSET") || !t.mesh.is_whole) return true;
  const std::string set = s.keyword->required("ELSET"), key = key_of(t.mesh.names.element_sets, t.scope(s), set);
  if (key.empty()) s.keyword->fail("ELSET=" + set, "the name of a set of cells");
  std::set<CellRef> scaled;
  for (const DeckNames::Cells& each : t.mesh.names.element_sets.at(key)) {
    const std::vector<CellRef>& cells = t.mesh.mesh.cell_groups.at(each.group);
    scaled.insert(cells.begin(), cells.end());
  }
  return std::ranges::includes(scaled, t.body_cells());
}

/// The stable step that *FIXED and *VARIABLE MASS SCALING keep.
void read_mass_scaling(Translation& t, DeckStep& step, const Statement& s) {
  const DeckKeyword& keyword = *s.keyword;
  if (step.kind != DeckStep::Kind::explicit_dynamics)
    return t.findings.note(keyword.where, "*" + keyword.name + " changes nothing in a step that is not explicit");
  step.says_masses = true;
  const double factor = factor_of(keyword);
  if (factor != 1.0)
    t.findings.refuse(keyword, keyword.where, fmt::format("FACTOR={:g} of masses", factor),
                      "Masses would stay as they are, but for DT: multiply the *DENSITY.");
  const std::string* type = keyword.parameter("TYPE");
  const std::string kind = type == nullptr ? "" : without_blanks(*type);
  const std::string* dt = keyword.parameter("DT");
  if (kind != "" && kind != "BELOWMIN")
    return t.findings.refuse(keyword, keyword.where, "TYPE=" + *type,
                             "No mass would be added: write TYPE=BELOW MIN, or multiply the *DENSITY.");
  if (dt == nullptr) return;
  const auto value = as_real(*dt);
  if (!value || !(*value > 0.0)) keyword.fail("DT=" + *dt, "a time");
  if (!acts_on_all(t, s))
    t.findings.refuse(keyword, keyword.where, "masses of " + keyword.required("ELSET") + " alone",
                      "Cells of all parts whose own step is below DT would become heavier.");
  if (keyword.name == "VARIABLE MASS SCALING")
    t.findings.refuse(keyword, keyword.where, "masses that change during the step",
                      "Mass would be added at its start alone; the step falls where cells shrink.");
  step.mass_step = std::max(*value, step.mass_step.value_or(0.0));
}

/// CalculiX' explicit steps have a smallest increment, below which it scales masses.
void scale_to_smallest(Translation& t, DeckStep& step) {
  const bool is_explicit = step.kind == DeckStep::Kind::explicit_dynamics;
  if (!step.smallest || !is_explicit || step.is_explicit_abaqus()) return;
  t.findings.refuse(*step.procedure, step.procedure->where, "a smallest increment in an explicit step",
                    "Cells whose own step is below it would become heavier, in all their motions: CalculiX scales "
                    "selectively, which leaves the motion as a whole its mass.");
  step.mass_step = step.smallest;
}

/// Abaqus carries scaled masses on to the next step, unless that says other ones.
void end_step(Translation& t, DeckStep& step) {
  scale_to_smallest(t, step);
  const bool follows = !t.steps.empty() && t.steps.back().is_explicit_abaqus() && step.is_explicit_abaqus();
  if (follows && !step.says_masses) step.mass_step = t.steps.back().mass_step;
  t.steps.push_back(step);
}

const char* scheme_of(DeckStep::Kind kind) {
  switch (kind) {
    case DeckStep::Kind::statics:
      return "statics";
    case DeckStep::Kind::implicit_dynamics:
      return "hht";
    case DeckStep::Kind::explicit_dynamics:
      break;
  }
  return "central_differences";
}

void add_scheme(const DeckStep& step, TableMaker& table) {
  table.text("kind", scheme_of(step.kind));
  constexpr double no_limit = 1e9;  // times the mass of all parts
  if (step.mass_step) table.number("mass_scaling_step", *step.mass_step).number("mass_scaling_limit", no_limit);
  if (step.kind != DeckStep::Kind::implicit_dynamics) return;
  const std::string* alpha = step.procedure->parameter("ALPHA");
  double value = step.alpha;
  if (alpha != nullptr) {
    const auto number = as_real(*alpha);
    if (!number) step.procedure->fail("ALPHA=" + *alpha, "a number from -1/3 to 0");
    value = *number;
  }
  table.number("alpha", value);
}

void add_time(const DeckStep& step, TableMaker& table) {
  table.number("end", step.finish());
  if (step.kind == DeckStep::Kind::explicit_dynamics) return;
  table.number("step", *step.increment);
  if (step.procedure->has("DIRECT")) table.truth("fixed", true);
}

void note_step(const DeckStep& step, bool touches, Findings& findings) {
  const Location& where = step.procedure->where;
  if (step.kind == DeckStep::Kind::explicit_dynamics)
    findings.note(where, "explicit steps are 0.9 of the stable step, as Carom finds it");
  else if (!step.procedure->has("DIRECT"))
    findings.note(where, fmt::format("steps of the first increment, {:g}: Carom shortens them where one fails, and "
                                     "does not lengthen them",
                                     *step.increment));
  if (step.mass_step)
    findings.note(where,
                  fmt::format("cells whose own stable step is below {:g} become heavier, without a limit; the log "
                              "says by how much",
                              *step.mass_step));
  const DeckKeyword& procedure = *step.procedure;
  const bool says_integrator =
      procedure.has("APPLICATION") || procedure.has("TIME INTEGRATOR") || procedure.has("ALPHA");
  if (touches && step.kind == DeckStep::Kind::implicit_dynamics && !says_integrator)
    findings.note(where,
                  "hht with alpha -0.05, as CalculiX has it; beside contact Abaqus takes APPLICATION=MODERATE "
                  "DISSIPATION where none is given");
  findings.note(step.step->where, step.is_finite ? "finite rotations and strains" : "small strains and rotations");
}

}  // namespace

bool DeckStep::is_explicit_abaqus() const {
  const std::string* value = procedure->parameter("EXPLICIT");
  return value != nullptr && value->empty();
}

bool DeckStep::is_coupled() const {
  return procedure->name == "DYNAMIC TEMPERATURE-DISPLACEMENT";
}

bool DeckStep::heats() const {
  return is_coupled() || procedure->has("ADIABATIC");
}

bool Translation::heats() const {
  return std::any_of(steps.begin(), steps.end(), [](const DeckStep& step) { return step.heats(); });
}

bool Translation::is_explicit_abaqus() const {
  return std::any_of(steps.begin(), steps.end(), [](const DeckStep& step) { return step.is_explicit_abaqus(); });
}

void find_steps(Translation& t) {
  static const std::set<std::string> procedures{"STATIC", "DYNAMIC", "DYNAMIC TEMPERATURE-DISPLACEMENT"};
  DeckStep step;
  double start = 0.0;
  const auto take = [&](std::size_t i) {
    const DeckKeyword& keyword = *t.statements.list[i].keyword;
    if (keyword.name == "STEP") {
      if (step.step != nullptr)
        keyword.fail(fmt::format("*STEP within the *STEP of line {}", step.step->where.line), "*END STEP before it");
      step = {};
      step.step = &keyword;
      step.begin = i;
      step.start = start;
    } else if (procedures.count(keyword.name) != 0) {
      if (step.step == nullptr) keyword.fail("*" + keyword.name + " outside of a step", "*STEP before it");
      read_procedure(t, step, keyword);
      if (step.is_coupled())
        t.findings.refuse(keyword, keyword.where, "a step that computes temperatures",
                          "It would be adiabatic: plastic work would heat where it is done, and heat would not flow.");
    } else if (keyword.name == "FIXED MASS SCALING" || keyword.name == "VARIABLE MASS SCALING") {
      if (step.procedure == nullptr)
        t.findings.refuse(keyword, keyword.where, "mass scaling before the procedure of a step",
                          "No mass would be added.");
      else
        read_mass_scaling(t, step, t.statements.list[i]);
    } else if (keyword.name == "END STEP") {
      if (step.step == nullptr) keyword.fail("*END STEP without *STEP", "*STEP before it");
      step.end = i;
      if (step.procedure != nullptr) end_step(t, step);
      if (step.procedure != nullptr) start = step.finish();
      step = {};
    }
  };
  const std::size_t before = t.errors.size();
  for (std::size_t i = 0; i < t.statements.list.size(); ++i) t.errors.attempt([&] { take(i); });
  t.errors.attempt([&] {
    if (step.step != nullptr)
      step.step->fail("*STEP without *END STEP", "*END STEP at its end", "Is the file complete?");
  });
  if (!t.steps.empty() || t.errors.size() != before) return;
  t.errors.add(CaseError({t.mesh.mesh.report.source, 0, 0}, "", "no step with *STATIC or *DYNAMIC", "at least one",
                         "`carom mesh` describes a deck without steps; other procedures are not computed."));
}

void translate_steps(Translation& t) {
  for (std::size_t i = 0; i < t.steps.size(); ++i) {
    const DeckStep& step = t.steps[i];
    note_step(step, t.root.find("contact") != nullptr, t.findings);
    TableMaker scheme(step.procedure->where);
    add_scheme(step, scheme);
    if (i == 0) {
      TableMaker time(step.procedure->where);
      add_time(step, time);
      t.root.members.push_back({"scheme", step.procedure->where, scheme.node()});
      t.root.members.push_back({"time", step.procedure->where, time.node()});
    } else {
      add_time(step, scheme);
      t.append("stage", scheme.node());
    }
  }
}

}  // namespace carom
