#include "casefile/case_schema.hpp"

#include "casefile/section_rules.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

const std::vector<std::string> axes{"x", "y", "z"};

Section<CaseMaterial> material_section() {
  Section<CaseMaterial> s("A material; NAME is what [[part]] refers to.");
  s.key("law", &CaseMaterial::law, "Material law.", {.choices = {"linear_elastic"}, .need = Need::required});
  s.key("E", &CaseMaterial::E, "Young's modulus.",
        {.unit = Dimension::stress,
         .range = greater_than(0.0),
         .need = Need::required,
         .aliases = {"young", "youngs_modulus", "modulus"}});
  s.key("nu", &CaseMaterial::nu, "Poisson's ratio.",
        {.range = between_open(-1.0, 0.5), .need = Need::required, .aliases = {"poisson", "poissons_ratio"}});
  s.key("rho", &CaseMaterial::rho, "Density.",
        {.unit = Dimension::density, .range = greater_than(0.0), .need = Need::required, .aliases = {"density"}});
  return s;
}

Section<CasePart> part_section() {
  Section<CasePart> s("A deformable body: a group of cells made of one material.");
  s.key("name", &CasePart::name, "Name in results and messages.", {.need = Need::required});
  s.key("cells", &CasePart::cells, "Group of cells.", {.need = Need::required});
  s.key("material", &CasePart::material, "NAME of a [materials.NAME].", {.need = Need::required});
  s.finish = [](CasePart& part, const Node&, const ReadContext& at) { check_name(part.name, at.at("name").path); };
  return s;
}

Section<CaseInitial> initial_section() {
  Section<CaseInitial> s("Initial displacement and velocity; later sections overwrite earlier ones.");
  s.key("nodes", &CaseInitial::nodes, "Group of nodes or cells, or \"all\".");
  s.key("part", &CaseInitial::part, "Name of a [[part]].");
  s.key("displacement", &CaseInitial::displacement, "Initial displacement, stress-free where it is uniform.",
        {.unit = Dimension::length});
  s.key("velocity", &CaseInitial::velocity, "Initial velocity.", {.unit = Dimension::velocity});
  s.description.alternatives = {{Alternatives::Count::exactly_one, {"nodes", "part"}},
                                {Alternatives::Count::at_least_one, {"displacement", "velocity"}}};
  return s;
}

Section<CaseScheme> scheme_section() {
  const std::vector<std::string> newmark{"newmark"};
  Section<CaseScheme> s("Time integration.");
  s.description.selector = "kind";
  s.key("kind", &CaseScheme::kind, "Newmark (implicit) or central differences (explicit).",
        {.choices = {"newmark", "central_differences"}, .need = Need::required});
  s.key("beta", &CaseScheme::beta, "Newmark's beta.",
        {.range = {Bound{0.0, Bound::Side::open}, Bound{0.5, Bound::Side::closed}}, .kinds = newmark});
  s.key("gamma", &CaseScheme::gamma, "Newmark's gamma; above 0.5 the scheme dissipates.",
        {.range = {Bound{0.5, Bound::Side::closed}, Bound{1.0, Bound::Side::closed}}, .kinds = newmark});
  s.key("mass", &CaseScheme::mass, "Mass matrix.",
        {.choices = {"consistent", "lumped"},
         .default_phrase = "consistent for newmark, lumped for central_differences"});
  s.finish = [](CaseScheme& scheme, const Node& node, const ReadContext&) {
    if (find(node, "mass") != nullptr) return;
    const bool lumped = scheme.kind == CaseScheme::Kind::central_differences;
    scheme.mass = lumped ? CaseScheme::Mass::lumped : CaseScheme::Mass::consistent;
  };
  return s;
}

/// A key that is written only where it acts: beside no step.
void add_safety(Section<CaseTime>& s) {
  const KeyDescription key{
      "safety",
      Shape::number,
      "Fraction of the stable step; not beside `step`.",
      {.range = {Bound{0.0, Bound::Side::open}, Bound{1.0, Bound::Side::closed}}, .kinds = {"central_differences"}},
      Node{CaseTime{}.safety, {}},
      {}};
  Section<CaseTime>::Handlers handlers;
  handlers.read = [key](CaseTime& time, const Node& node, const ReadContext& at) {
    decode(node, key, at, time.safety);
  };
  handlers.write = [](const CaseTime& time, const Node&) -> std::optional<Node> {
    if (time.step) return std::nullopt;
    return Node{time.safety, {}};
  };
  s.add(key, handlers);
}

Section<CaseTime> time_section() {
  Section<CaseTime> s("Duration and time step.");
  s.description.selector = "scheme.kind";
  s.key("end", &CaseTime::end, "The run goes from 0 to here.",
        {.unit = Dimension::time, .range = greater_than(0.0), .need = Need::required, .aliases = {"duration"}});
  s.key("step", &CaseTime::step, "Time step.",
        {.unit = Dimension::time,
         .range = greater_than(0.0),
         .required_for = {"newmark"},
         .aliases = {"dt"},
         .default_phrase = "newmark: required; central_differences: from the stable step"});
  s.key("fixed", &CaseTime::fixed, "Never halve the step: a step that fails ends the run.", {.kinds = {"newmark"}});
  add_safety(s);
  s.finish = [](CaseTime& time, const Node& node, const ReadContext& at) {
    const Node* safety = find(node, "safety");
    if (time.step && safety != nullptr) {
      throw CaseError(safety->where, at.at("safety").path, "a fraction of the stable step beside a step",
                      "step or safety", "Leave out step to have it chosen.");
    }
    if (time.step && **time.step > *time.end) {
      throw CaseError(time.step->where, at.at("step").path, toml_number(**time.step),
                      "a step of at most time.end = " + toml_number(*time.end));
    }
  };
  return s;
}

Section<CaseSolver> solver_section() {
  Section<CaseSolver> s("Solvers of implicit steps.");
  s.description.selector = "scheme.kind";
  s.key("kind", &CaseSolver::kind,
        "Linear solver: conjugate gradients, CHOLMOD, or chosen from the estimated conditioning.",
        {.choices = {"auto", "cg", "cholmod"}, .kinds = {"newmark"}});
  s.key("max_contact_iterations", &CaseSolver::max_contact_iterations,
        "A step whose contact state needs more iterations has failed.", {.range = at_least(1.0), .kinds = {"newmark"}});
  return s;
}

Section<CaseOutput> output_section() {
  Section<CaseOutput> s("What is written to the results folder, and how often.");
  s.key("fields", &CaseOutput::fields, "Fields in the .vtu files.",
        {.choices = {"displacement", "velocity", "acceleration", "stress"}});
  s.key("fields_every", &CaseOutput::fields_every, "Steps between .vtu files; 0: about 50 files over the run.",
        {.range = at_least(0.0)});
  s.key("curves_every", &CaseOutput::curves_every, "Steps between rows of the .csv files.", {.range = at_least(1.0)});
  return s;
}

Section<CaseProbe> probe_section() {
  Section<CaseProbe> s("Curves at a node, at the node nearest to a point, or over a group, in probes.csv.");
  s.key("name", &CaseProbe::name, "Name in results and in [[check]].", {.need = Need::required});
  s.key("node", &CaseProbe::node, "Number of the node in the mesh file.", {.range = at_least(0.0)});
  s.key("point", &CaseProbe::point, "The node of a part nearest to this point.", {.unit = Dimension::length});
  s.key("group", &CaseProbe::group, "Group: mean over its nodes; stress: over the cells that touch them.");
  s.key("quantities", &CaseProbe::quantities, "What to record.",
        {.choices = {"displacement", "velocity", "acceleration", "stress", "section_force"}, .need = Need::required});
  s.key("side", &CaseProbe::side,
        "For section_force: direction from the section to the cells whose forces are summed.");
  s.key("cfc", &CaseProbe::cfc, "Low-pass filter of the curves: SAE J211 channel frequency class.",
        {.range = greater_than(0.0)});
  s.description.alternatives = {{Alternatives::Count::exactly_one, {"node", "point", "group"}}};
  s.finish = check_probe;
  return s;
}

Section<CaseCheck> checked_value_section() {
  Section<CaseCheck> s("A value that the run must meet; the case is its own test.");
  s.key("quantity", &CaseCheck::quantity,
        "What is compared, e.g. \"displacement_z\", \"energy.ENER_CIN\", \"contact.force_z\".",
        {.need = Need::required});
  s.key("place", &CaseCheck::place, "Name of a [[probe]] or [[contact]]; none for quantities of the whole case.");
  s.key("time", &CaseCheck::time, "When.",
        {.unit = Dimension::time, .range = at_least(0.0), .default_phrase = "time.end"});
  s.key("value", &CaseCheck::value, "Reference value.");
  Section<CaseCheck>::Handlers reference;
  const KeyDescription reference_key{
      "reference", Shape::text, "Compare with the solution of [exact].", {.choices = {"exact"}}, {}, {}};
  reference.read = [reference_key](CaseCheck& check, const Node& node, const ReadContext& at) {
    decode_choice(node, reference_key, at);
    check.exact = true;
  };
  reference.write = [](const CaseCheck& check, const Node&) -> std::optional<Node> {
    if (!check.exact) return std::nullopt;
    return Node{std::string("exact"), {}};
  };
  s.add(reference_key, reference);
  s.key("tolerance", &CaseCheck::tolerance, "Largest difference, relative to the reference unless absolute = true.",
        {.range = greater_than(0.0), .need = Need::required});
  s.key("absolute", &CaseCheck::absolute, "The tolerance has the unit of the quantity.");
  s.key("source", &CaseCheck::source, "Where the reference value comes from.");
  s.description.alternatives = {{Alternatives::Count::exactly_one, {"value", "reference"}}};
  s.finish = check_check;
  return s;
}

Section<CaseExact> exact_section() {
  const auto positive = [](Dimension unit) {
    return KeyOptions{.unit = unit, .range = greater_than(0.0), .need = Need::required};
  };
  Section<CaseExact> s(
      "Exact solution of the case, for checks and curves: an elastic bar that flies against a wall end on.");
  s.description.selector = "solution";
  s.key("solution", &CaseExact::solution, "Which solution.",
        {.choices = {"bar_on_rigid_wall", "bar_on_penalty_wall"}, .need = Need::required});
  s.key("length", &CaseExact::length, "Length of the bar.", positive(Dimension::length));
  s.key("area", &CaseExact::area, "Section of the bar.", positive(Dimension::area));
  s.key("modulus", &CaseExact::modulus,
        "Stress per axial strain: E for nu = 0 or free sides, E (1 - nu) / ((1 + nu) (1 - 2 nu)) for blocked sides.",
        positive(Dimension::stress));
  s.key("density", &CaseExact::density, "Density.", positive(Dimension::density));
  s.key("speed", &CaseExact::speed, "Speed towards the wall.", positive(Dimension::velocity));
  s.key("gap", &CaseExact::gap, "Distance to the wall at the start.",
        {.unit = Dimension::length, .range = at_least(0.0)});
  s.key("stiffness", &CaseExact::stiffness, "Stress per penetration of the wall.",
        {.unit = Dimension::stress_per_length,
         .range = greater_than(0.0),
         .kinds = {"bar_on_penalty_wall"},
         .need = Need::required});
  s.key("initial_displacement", &CaseExact::initial_displacement, "Added to displacements.",
        {.unit = Dimension::length});
  s.key("axis", &CaseExact::axis, "Axis of the bar; it flies in the negative direction.", {.choices = axes});
  return s;
}

Section<Case> root_section() {
  Section<Case> s("A case is one TOML file.");
  s.key("title", &Case::title, "One line for reports.");
  s.key("units", &Case::units,
        "Unit system of all numbers, mesh included; for labels and plausibility, nothing is ever converted.",
        {.choices = {std::string(name(UnitSystem::si)), std::string(name(UnitSystem::mm_t_s)),
                     std::string(name(UnitSystem::mm_kg_ms))}});
  const KeyOptions needed{.need = Need::required};
  s.table("mesh", &Case::mesh, mesh_section(), needed);
  s.named_tables("materials", &Case::materials, material_section(), needed);
  s.tables("part", &Case::parts, part_section(), needed);
  s.tables("support", &Case::supports, support_section());
  s.tables("load", &Case::loads, load_section());
  s.tables("initial", &Case::initial, initial_section());
  s.tables("contact", &Case::contacts, contact_section());
  s.named_tables("functions", &Case::functions, function_section());
  s.table("scheme", &Case::scheme, scheme_section(), needed);
  s.table("time", &Case::time, time_section(), needed);
  s.table("solver", &Case::solver, solver_section());
  s.table("output", &Case::output, output_section());
  s.tables("probe", &Case::probes, probe_section());
  s.tables("check", &Case::checks, checked_value_section());
  s.table("exact", &Case::exact, exact_section());
  return s;
}

}  // namespace

const Section<Case>& case_schema() {
  static const Section<Case> schema = root_section();
  return schema;
}

}  // namespace carom
