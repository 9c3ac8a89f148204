#include "casefile/case_schema.hpp"

#include "casefile/section_rules.hpp"
#include "output/quantities.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

SectionSchema<CasePart> part_section() {
  SectionSchema<CasePart> s("A deformable body: a group of cells made of one material.");
  s.key("name", &CasePart::name, "Name in results and messages.", {.need = Need::required});
  s.key("cells", &CasePart::cells, "Group of cells, or \"all\": all cells of the mesh that the section takes.",
        {.need = Need::required});
  s.key("material", &CasePart::material, "NAME of a [materials.NAME].", {.need = Need::required});
  s.description.selector = "section";
  s.description.default_kind = "solid";
  s.key("section", &CasePart::section,
        "What the cells are a section of: hexahedra, tetrahedra, wedges and pyramids are solid; QUAD4, QUAD8, TRIA3 "
        "and TRIA6 in a plane z = const are plane_strain, plane_stress or axisymmetric (about the y axis, x being the "
        "radius); LINE2 are bars.",
        {.choices = {"solid", "plane_strain", "plane_stress", "axisymmetric", "bar"},
         .remedy = "Shells and beams are not computed: mesh thin parts by solids, and read in docs/locking.md how many "
                   "cells they need through the thickness."});
  s.key("type", &CasePart::type,
        "Which of the cells of the group are meant, where it has several types. Absent: all that the section takes.",
        {.choices = {"HEXA8", "HEXA20", "HEXA27", "TETRA4", "TETRA10", "PENTA6", "PENTA15", "PYRA5", "PYRA13", "QUAD4",
                     "QUAD8", "TRIA3", "TRIA6", "LINE2"}});
  s.key("thickness", &CasePart::thickness, "Thickness of plane cells.",
        {.unit = Dimension::length, .range = greater_than(0.0), .kinds = {"plane_strain", "plane_stress"}});
  s.key("area", &CasePart::area, "Area of the section of the bars.",
        {.unit = Dimension::area, .range = greater_than(0.0), .kinds = {"bar"}, .need = Need::required});
  s.key(
      "formulation", &CasePart::formulation,
      "How the cells take the deformation: \"full\": at all their points; \"mean_dilatation\": with a volume change "
      "that is the cell's mean, or linear in QUAD8, HEXA20, HEXA27, PENTA15 and PYRA13 (B-bar, F-bar), for nearly "
      "incompressible and "
      "yielding bodies; \"one_point\": at one point, with a stiffness against hourglass modes; \"stabilised\": at one "
      "point, with that of enhanced strains, which neither bending nor constant volume locks; \"reduced\": at two "
      "points a direction, of QUAD8 and HEXA20; \"nodal\": at the nodes, of TETRA4 and TRIA3. Which cells have which: "
      "docs/cells.md. Absent: stabilised of HEXA8 and QUAD4, mean_dilatation of TETRA10; where the law yields or nu > "
      "0.4 mean_dilatation of QUAD8, HEXA20, HEXA27, PENTA15 and PYRA13, nodal of TETRA4 and TRIA3; full of the "
      "others. Where the part "
      "has cells of several types, those that have not the one that is given keep their own, and the log says so.",
      {.choices = {"full", "mean_dilatation", "one_point", "stabilised", "reduced", "nodal"}});
  s.key("hourglass", &CasePart::hourglass,
        "Coefficient of the stiffness against hourglass modes of one_point, stabilised and nodal cells: 1 is about the "
        "elastic stiffness of full integration, or that of enhanced strains. Absent: 0.05 of one_point cells, 1 of "
        "stabilised and 0.25 of nodal ones.",
        {.range = greater_than(0.0)});
  s.key(
      "hourglass_viscosity", &CasePart::hourglass_viscosity,
      "Coefficient of a viscous resistance to the rates of hourglass modes of one_point cells, beside the stiffness: 1 "
      "is about the damping of full integration with the whole elastic stiffness times the time of a wave through the "
      "cell. Absent: 0.",
      {.range = at_least(0.0)});
  s.key(
      "distortion_control", &CasePart::distortion_control,
      "Keeps cells of any formulation from folding: where the volume between the edges of a corner is below this share "
      "of that at rest, the corner resists, with a pressure that is the wave modulus of the law at half of it and "
      "grows "
      "to 19 times that where the corner is flat (customary: 0.1). Energy: `distortion`. For laws of finite strain. "
      "Absent: nothing resists.",
      {.range = between_open(0.0, 1.0)});
  s.key("linear_bulk_viscosity", &CasePart::linear_bulk_viscosity,
        "Coefficient of a viscous pressure against all changes of volume, the share of critical damping of the fastest "
        "wave of a cell: it quietens what rings from cell to cell (customary: 0.06).",
        {.range = at_least(0.0)});
  s.key("quadratic_bulk_viscosity", &CasePart::quadratic_bulk_viscosity,
        "Coefficient of a viscous pressure that grows with the square of the rate of compression: it spreads strong "
        "shocks over a few cells (customary: 1.2).",
        {.range = at_least(0.0)});
  s.finish = [](CasePart& part, const Node&, const ReadContext& at) { check_name(part.name, at.at("name").path); };
  return s;
}

SectionSchema<CaseGuards> guards_section() {
  SectionSchema<CaseGuards> s("What warns and what stops a run on the way, and when.");
  s.key("energy_growth", &CaseGuards::energy_growth,
        "The run stops when its mechanical energy has grown by more than this share of the initial and supplied "
        "energy. Raise it for models that are meant to lend energy for a while, such as stops that chatter.",
        {.range = greater_than(0.0)});
  s.key("rotation_warning", &CaseGuards::rotation_warning,
        "Degrees by which a cell of a small-strain part may turn before the run warns, with the error of its stress.",
        {.range = greater_than(0.0)});
  s.key("rotation_stop", &CaseGuards::rotation_stop,
        "Degrees by which a cell of a small-strain part may turn before the run stops.", {.range = greater_than(0.0)});
  s.finish = [](CaseGuards& guards, const Node& node, const ReadContext& at) {
    if (guards.rotation_stop >= guards.rotation_warning) return;
    const Node* stop = find(node, "rotation_stop");
    throw CaseError(stop == nullptr ? node.where : stop->where, at.at("rotation_stop").path,
                    toml_number(guards.rotation_stop),
                    "at least rotation_warning = " + toml_number(guards.rotation_warning));
  };
  return s;
}

constexpr const char* remembered = "a variable that points remember (docs/material_laws.md, or of a library's law)";

std::vector<std::string> names_where(bool (*is_wanted)(const Quantity&)) {
  std::vector<std::string> names;
  for (const Quantity& q : quantities())
    if (is_wanted(q)) names.emplace_back(q.name);
  return names;
}

SectionSchema<CaseOutput> output_section() {
  SectionSchema<CaseOutput> s("What is written to the results folder, and how often.");
  s.key("fields", &CaseOutput::fields,
        "Fields in the frames (docs/quantities.md), beside the numbers of nodes and cells and of the part, which are "
        "always there; those of contact only where there is one, contact_damage only where a tie tears, what laws "
        "remember only where one does.",
        {.choices = names_where(is_field), .others = remembered});
  s.key(
      "fields_every", &CaseOutput::fields_every,
      "Steps between frames of fields; 0: about 50 frames at equal times over the run, fewer where 50 might take more "
      "than 2 GB.",
      {.range = at_least(0.0)});
  s.key(
      "format", &CaseOutput::format,
      "Of the frames. xdmf: HDF5 files, deflated, with the mesh in a file of its own, and fields.xdmf for ParaView and "
      "meshio; vtu: files of VTK, each with the mesh, not compressed, and fields.pvd.",
      {.choices = {"xdmf", "vtu"}});
  s.key("precision", &CaseOutput::precision, "Of the values of fields: about 7 digits, or 16.",
        {.choices = {"single", "double"}});
  s.key("curves_every", &CaseOutput::curves_every, "Steps between rows of the .csv files.", {.range = at_least(1.0)});
  s.key("checkpoint_every", &CaseOutput::checkpoint_every,
        "Steps between checkpoints, from which `carom resume` goes on; 0: by time alone.", {.range = at_least(0.0)});
  s.key("checkpoint_minutes", &CaseOutput::checkpoint_minutes,
        "Minutes of the clock between checkpoints; 0: by steps alone. Runs that end, or are stopped by Ctrl-C or "
        "SIGTERM, write "
        "one in any case.",
        {.range = at_least(0.0)});
  return s;
}

SectionSchema<CaseProbe> probe_section() {
  SectionSchema<CaseProbe> s("Curves at a node, at the node nearest to a point, or over a group, in probes.csv.");
  s.key("name", &CaseProbe::name, "Name in results and in [[check]].", {.need = Need::required});
  s.key("node", &CaseProbe::node, "Number of the node in the mesh file.", {.range = at_least(0.0)});
  s.key("point", &CaseProbe::point, "The node of a part nearest to this point.", {.unit = Dimension::length});
  s.key("within", &CaseProbe::within, "Largest distance from the point to its node.",
        {.unit = Dimension::length, .range = at_least(0.0), .default_phrase = "the size of a cell at the node"});
  s.key("group", &CaseProbe::group, "Group: mean over its nodes; of cells: over those that touch them.");
  s.key("part", &CaseProbe::part, "Part: sums over it.");
  s.key("quantities", &CaseProbe::quantities,
        "What to record (docs/quantities.md). Where part is given: quantities of parts.",
        {.choices = names_where(is_probed), .others = remembered, .need = Need::required});
  s.key("side", &CaseProbe::side,
        "For section_force: direction from the section to the cells whose forces are summed.");
  s.key("cfc", &CaseProbe::cfc, "Low-pass filter of the curves: SAE J211 channel frequency class.",
        {.range = greater_than(0.0)});
  s.key("shock", &CaseProbe::shock,
        "Of its acceleration and local_acceleration, filtered where there is a cfc: HIC15 and HIC36, pulse width, "
        "velocity change, shock response spectrum (docs/howto/shock.md).");
  s.key("quality_factor", &CaseProbe::quality_factor,
        "Of the oscillators of the shock response spectrum, 1 / (2 ratio of damping).",
        {.range = greater_than(0.5), .default_phrase = "10, with shock"});
  s.description.alternatives = {{Alternatives::Count::exactly_one, {"node", "point", "group", "part"}}};
  s.finish = check_probe;
  return s;
}

SectionSchema<CaseCheck> checked_value_section() {
  SectionSchema<CaseCheck> s("A value that the run must meet; the case is its own test.");
  s.key("quantity", &CaseCheck::quantity,
        "What is compared, e.g. \"displacement_z\", \"energy.ENER_CIN\", \"contact.force_z\".",
        {.need = Need::required});
  s.key("place", &CaseCheck::place, "Name of a [[probe]] or [[contact]]; none for quantities of the whole case.");
  s.key("time", &CaseCheck::time, "When.",
        {.unit = Dimension::time, .range = at_least(0.0), .default_phrase = "time.end"});
  s.key("value", &CaseCheck::value, "Reference value.");
  SectionSchema<CaseCheck>::Handlers reference;
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

SectionSchema<Case> root_section() {
  SectionSchema<Case> s("A case is one TOML file.");
  s.key("title", &Case::title, "One line for reports.");
  s.key("units", &Case::units,
        "Unit system of all numbers, mesh included; for labels and plausibility, nothing is ever converted.",
        {.choices = {std::string(name(UnitSystem::si)), std::string(name(UnitSystem::mm_t_s)),
                     std::string(name(UnitSystem::mm_kg_ms))}});
  const KeyOptions needed{.need = Need::required};
  s.table("mesh", &Case::mesh, mesh_section(), needed);
  s.named_tables("materials", &Case::materials, material_section(), needed);
  s.tables("part", &Case::parts, part_section(), needed);
  s.tables("point_mass", &Case::point_masses, point_mass_section());
  s.tables("spring", &Case::springs, spring_section());
  s.tables("rigid_body", &Case::rigid_parts, rigid_body_section());
  s.tables("equation", &Case::equations, equation_section());
  s.tables("erosion", &Case::erosion, erosion_section());
  s.tables("support", &Case::supports, support_section());
  s.tables("load", &Case::loads, load_section());
  s.table("initial_state", &Case::initial_state, initial_state_section());
  s.tables("initial", &Case::initial, initial_section());
  s.tables("contact", &Case::contacts, contact_section());
  s.named_tables("functions", &Case::functions, function_section());
  s.table("scheme", &Case::scheme, scheme_section(), needed);
  s.table("time", &Case::time, time_section(), needed);
  s.tables("stage", &Case::stages, stage_section());
  s.table("solver", &Case::solver, solver_section());
  s.table("guards", &Case::guards, guards_section());
  s.table("output", &Case::output, output_section());
  s.tables("probe", &Case::probes, probe_section());
  s.tables("check", &Case::checks, checked_value_section());
  s.table("exact", &Case::exact, exact_section());
  return s;
}

}  // namespace

std::vector<Located<std::string>> default_fields() {
  std::vector<Located<std::string>> fields;
  for (const Quantity& q : quantities())
    if (is_field(q) && q.written == Quantity::Written::by_default) fields.push_back({std::string(q.name), {}});
  return fields;
}

const SectionSchema<Case>& case_schema() {
  static const SectionSchema<Case> schema = root_section();
  return schema;
}

}  // namespace carom
