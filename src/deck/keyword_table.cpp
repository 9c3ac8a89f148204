#include "deck/keyword_table.hpp"

#include <algorithm>
#include <array>

namespace carom {

namespace {

using enum KeywordUse;

constexpr std::array<KeywordEntry, 162> kKeywords{{
    {"AMPLITUDE", model, "NAME,TIME,DEFINITION,VALUE", "",
     "A function of time; SMOOTH STEP becomes a table of 33 points."},
    {"ASSEMBLY", mesh, "NAME", "", "Begins the list of instances."},
    {"BASE MOTION", refused, "", "", "The supports would stand still."},
    {"BEAM GENERAL SECTION", refused, "", "", "Carom has no beams."},
    {"BEAM SECTION", refused, "", "", "Carom has no beams."},
    {"BOUNDARY", step, "OP,AMPLITUDE,TYPE", "", "Supports and imposed motions; turns of rigid bodies."},
    {"BUCKLE", refused, "", "", "The step is left out."},
    {"BULK VISCOSITY", step, "", "", "Linear and quadratic bulk viscosity of all parts."},
    {"CFLUX", refused, "", "", "Carom computes no flow of heat."},
    {"CHANGE FRICTION", refused, "INTERACTION", "", "Friction would stay as it was."},
    {"CHANGE SURFACE BEHAVIOR", refused, "INTERACTION", "", "Contact would stay as it was."},
    {"CLEARANCE", refused, "", "", "Gaps would be those of the mesh."},
    {"CLOAD", step, "OP,AMPLITUDE", "", "Forces on nodes."},
    {"COMPLEX FREQUENCY", refused, "", "", "The step is left out."},
    {"CONDUCTIVITY", model, "", "*",
     "Changes nothing where no step computes temperatures; where one does, the step is adiabatic if it is accepted."},
    {"CONTACT", step, "", "OP", "General contact: every outer face may touch every other."},
    {"CONTACT CONTROLS", solver, "", "*",
     "Steers the contact of the other program; contact is enforced as Carom does."},
    {"CONTACT CONTROLS ASSIGNMENT", solver, "", "*",
     "Steers the contact of the other program; contact is enforced as Carom does."},
    {"CONTACT DAMPING", refused, "", "", "Contact would not damp."},
    {"CONTACT EXCLUSIONS", refused, "", "", "All surfaces would touch."},
    {"CONTACT FILE", output, "", "*", "Results of contact are in contact.csv and the fields."},
    {"CONTACT FORMULATION", solver, "", "*",
     "Steers the contact of the other program; contact is enforced as Carom does."},
    {"CONTACT INCLUSIONS", step, "ALL EXTERIOR", "", "ALL EXTERIOR: every outer face may touch every other."},
    {"CONTACT OUTPUT", output, "", "*", "Results of contact are in contact.csv and the fields."},
    {"CONTACT PAIR", model, "INTERACTION,TYPE,ADJUST",
     "SMALL SLIDING,MECHANICAL CONSTRAINT,CPSET,EXTENSION ZONE,OP,TRACKING",
     "Contact of two surfaces, slave and master; sliding is always followed. ADJUST=0: overlaps at the start count as "
     "touching; other values, which close gaps, are refused unless accepted."},
    {"CONTACT PRINT", output, "", "*", "Results of contact are in contact.csv and the fields."},
    {"CONTACT PROPERTY ASSIGNMENT", step, "", "", "The interaction of general contact; one for all surfaces."},
    {"CONTACT RESPONSE", output, "", "*", "Sensitivities of results."},
    {"CONTROLS", solver, "", "*", "Steers the solver of the other program; Carom's own settings hold."},
    {"COUPLED TEMPERATURE-DISPLACEMENT", refused, "", "", "The step is left out."},
    {"COUPLING", model, "REF NODE,SURFACE", "CONSTRAINT NAME",
     "Nodes that move as one rigid body with the reference node, with *KINEMATIC behind it."},
    {"CREEP", refused, "", "", "The material would not creep."},
    {"CYCLIC SYMMETRY MODEL", refused, "", "", "Nothing would hold the edges of the sector."},
    {"DAMAGE EVOLUTION", model, "TYPE", "SOFTENING,MIXED MODE BEHAVIOR,MODE MIX RATIO,DEGRADATION",
     "0 after *DAMAGE INITIATION: cells go where their damage reaches 1. Others, under which the stress softens first, "
     "are refused unless accepted: cells would go at once."},
    {"DAMAGE INITIATION", model, "CRITERION", "",
     "CRITERION=JOHNSON COOK: damage of the material, D3 with the other sign; without *DAMAGE EVOLUTION no cell goes. "
     "Other criteria are refused unless accepted: nothing would break."},
    {"DAMAGE STABILIZATION", solver, "", "*", "Steers how the other program softens."},
    {"DAMPING", refused, "", "", "The bodies would not be damped."},
    {"DASHPOT", refused, "", "", "The damper would be left out."},
    {"DENSITY", model, "", "", "Density."},
    {"DEPVAR", refused, "", "", "Belongs to a material of the user's own."},
    {"DIAGNOSTICS", output, "", "*", "Messages of the other program."},
    {"DISTRIBUTING", refused, "", "", "The reference node of the *COUPLING would pull at nothing."},
    {"DISTRIBUTING COUPLING", refused, "", "", "The reference node would pull at nothing."},
    {"DLOAD", step, "OP,AMPLITUDE", "", "P and P1 to P6: pressure on faces; GRAV: gravity, on all parts."},
    {"DSLOAD", step, "OP,AMPLITUDE", "", "P: pressure on a surface."},
    {"DYNAMIC", step, "EXPLICIT,DIRECT,ALPHA,ADIABATIC",
     "DIRECT USER CONTROL,APPLICATION,NOHAF,HAFTOL,INITIAL,SOLVER,ELEMENT BY ELEMENT,FIXED TIME "
     "INCREMENTATION,IMPROVED DT METHOD,SCALE FACTOR",
     "hht (alpha -0.05 where none is given) or, with EXPLICIT, central_differences."},
    {"DYNAMIC TEMPERATURE-DISPLACEMENT", step, "EXPLICIT",
     "DIRECT USER CONTROL,ELEMENT BY ELEMENT,FIXED TIME INCREMENTATION,IMPROVED DT METHOD,SCALE FACTOR",
     "central_differences, adiabatic, if it is accepted: heat would not flow."},
    {"EL FILE", output, "", "*", "Stresses and strains are in the fields."},
    {"EL PRINT", output, "", "*", "Stresses and strains are in the fields."},
    {"ELASTIC", model, "TYPE", "", "TYPE=ISOTROPIC: Young's modulus and Poisson's ratio, at one temperature."},
    {"ELCOPY", refused_mesh, "", "", "Elements made by the other program are missing."},
    {"ELEMENT", mesh, "TYPE,ELSET", "", "Cells, point masses and springs (docs/decks.md)."},
    {"ELEMENT MATRIX OUTPUT", output, "", "*", "Matrices of the other program."},
    {"ELEMENT OUTPUT", output, "", "*", "Stresses and strains are in the fields."},
    {"ELEMENT RESPONSE", output, "", "*", "Sensitivities of results."},
    {"ELGEN", refused_mesh, "", "", "Elements made by the other program are missing."},
    {"ELSET", mesh, "ELSET,GENERATE,INSTANCE,INTERNAL,UNSORTED", "", "A group of cells."},
    {"END ASSEMBLY", mesh, "", "", "Ends the list of instances."},
    {"END INSTANCE", mesh, "", "", "Ends an instance."},
    {"END PART", mesh, "", "", "Ends a part."},
    {"END STEP", step, "", "", "Ends a step."},
    {"ENERGY FILE", output, "", "*", "Energies are in energy.csv."},
    {"ENERGY OUTPUT", output, "", "*", "Energies are in energy.csv."},
    {"ENERGY PRINT", output, "", "*", "Energies are in energy.csv."},
    {"EQUATION", model, "INPUT", "",
     "A linear homogeneous equation between displacements; the first term is the dependent one. Sets are matched by "
     "the places of their nodes."},
    {"EXPANSION", model, "", "*",
     "Changes nothing where no temperature changes; else there would be no thermal strains."},
    {"EXTREME ELEMENT VALUE", output, "", "*", "Watches results of the other program."},
    {"EXTREME NODE VALUE", output, "", "*", "Watches results of the other program."},
    {"EXTREME VALUE", output, "", "*", "Watches results of the other program."},
    {"FACE PRINT", output, "", "*", "Results on surfaces."},
    {"FILE FORMAT", output, "", "*", "Results files of the other program."},
    {"FILE OUTPUT", output, "", "*", "Results files of the other program."},
    {"FILM", refused, "", "", "Carom computes no flow of heat."},
    {"FILTER", output, "", "*", "Filters results."},
    {"FIXED MASS SCALING", step, "DT,TYPE", "",
     "DT with TYPE=BELOW MIN, of all parts: mass_scaling_step, without a limit."},
    {"FREQUENCY", refused, "", "", "The step is left out."},
    {"FRICTION", model, "", "SLIP TOLERANCE,ELASTIC SLIP",
     "Coulomb's coefficient, and in CalculiX the stiffness of sticking."},
    {"GAP", refused, "", "", "The gap element would be left out."},
    {"GAP CONDUCTANCE", refused, "", "", "Carom computes no flow of heat."},
    {"HEADING", model, "", "", "Title."},
    {"HEAT TRANSFER", refused, "", "", "The step is left out."},
    {"HOURGLASS STIFFNESS", solver, "", "*", "Hourglass control is Carom's own (part.hourglass)."},
    {"HYPERELASTIC", model, "NEO HOOKE", "MODULI",
     "NEO HOOKE with C10, D1: the compressible neo-Hookean law with mu = 2 C10 and the bulk modulus 2 / D1; equal at "
     "small strains, see docs/decks.md."},
    {"INCLUDE", mesh, "INPUT", "", "Another file in this place."},
    {"INCREMENTATION OUTPUT", output, "", "*", "Messages of the other program."},
    {"INELASTIC HEAT FRACTION", model, "", "", "taylor_quinney of Johnson and Cook's law."},
    {"INITIAL CONDITIONS", model, "TYPE", "",
     "TYPE=VELOCITY (of nodes) and ROTATING VELOCITY (of nodes or cells); TEMPERATURE: initial_temperature of Johnson "
     "and Cook's law, one for all nodes of a material."},
    {"INSTANCE", mesh, "NAME,PART", "", "A part at its place: shifted, then turned."},
    {"INTEGRATED OUTPUT", output, "", "*", "Results over sections."},
    {"INTEGRATED OUTPUT SECTION", output, "", "*", "Results over sections; [[probe]] section_force has them."},
    {"KINEMATIC", model, "", "", "All nodes of the *COUPLING before it are joined to its reference node."},
    {"KINEMATIC COUPLING", refused, "", "", "The reference node would hold nothing."},
    {"MASS", model, "ELSET", "", "Point masses."},
    {"MATERIAL", model, "NAME", "", "A material."},
    {"MATRIX OUTPUT", output, "", "*", "Matrices of the other program."},
    {"MEMBRANE SECTION", refused, "", "", "Carom has no membranes."},
    {"MODAL DAMPING", refused, "", "", "The bodies would not be damped."},
    {"MODAL DYNAMIC", refused, "", "", "The step is left out."},
    {"MODAL FILE", output, "", "*", "Results of modal steps."},
    {"MODAL OUTPUT", output, "", "*", "Results of modal steps."},
    {"MODAL PRINT", output, "", "*", "Results of modal steps."},
    {"MODEL CHANGE", refused, "", "", "Cells and contacts would stay."},
    {"MONITOR", output, "", "*", "Messages of the other program."},
    {"MPC", refused, "", "", "The nodes would not be coupled."},
    {"NCOPY", refused_mesh, "", "", "Nodes made by the other program are missing."},
    {"NFILL", refused_mesh, "", "", "Nodes made by the other program are missing."},
    {"NGEN", refused_mesh, "", "", "Nodes made by the other program are missing."},
    {"NMAP", refused_mesh, "", "", "Nodes moved by the other program stand elsewhere."},
    {"NODE", mesh, "NSET", "", "Nodes."},
    {"NODE FILE", output, "", "*", "Displacements and velocities are in the fields."},
    {"NODE OUTPUT", output, "NSET", "*",
     "Probes of displacement, velocity and acceleration (U, V, A, and their components) where it names a set."},
    {"NODE PRINT", output, "NSET", "*", "Probes of displacement and velocity of the set."},
    {"NODE RESPONSE", output, "", "*", "Sensitivities of results."},
    {"NORMAL", refused, "", "", "Belongs to shells and beams."},
    {"NSET", mesh, "NSET,GENERATE,ELSET,INSTANCE,INTERNAL,UNSORTED", "", "A group of nodes."},
    {"ORIENTATION", output, "", "*", "Isotropic laws know no directions; results are along the axes."},
    {"OUTPUT", output, "", "*", "How often the other program writes."},
    {"PART", mesh, "NAME", "", "A part, used by instances."},
    {"PHYSICAL CONSTANTS", output, "", "*", "Constants that nothing here uses."},
    {"PLASTIC", model, "HARDENING,RATE", "",
     "HARDENING=ISOTROPIC: table of yield stress (Cauchy) and plastic strain at one temperature, one for each RATE; "
     "JOHNSON COOK."},
    {"POST OUTPUT", output, "", "*", "Results files of the other program."},
    {"PREPRINT", output, "", "*", "Messages of the other program."},
    {"PRE-TENSION SECTION", refused, "", "", "Nothing would be tightened."},
    {"PRINT", output, "", "*", "Messages of the other program."},
    {"RADIATION FILE", output, "", "*", "Results of radiation."},
    {"RADIATION OUTPUT", output, "", "*", "Results of radiation."},
    {"RADIATION PRINT", output, "", "*", "Results of radiation."},
    {"RATE DEPENDENT", model, "TYPE", "",
     "TYPE=JOHNSON COOK: C and the reference rate; POWER LAW, YIELD RATIO: the table times the ratio at several "
     "rates."},
    {"RESTART", output, "", "*", "Carom writes checkpoints by itself (output.checkpoint_every)."},
    {"RIGID BODY", model, "ELSET,REF NODE,ANALYTICAL SURFACE,TIE NSET,PIN NSET", "",
     "A surface of faces that moves and turns with its reference node, or is free where that has a *MASS. It is met by "
     "*CONTACT PAIR, as the second surface, or by general contact. Of solids: a [[rigid_body]] of parts; TIE NSET and "
     "PIN NSET: nodes that are joined to it."},
    {"ROTARY INERTIA", model, "ELSET", "",
     "Of the reference node of a free rigid body of faces or of nodes, which turns by it."},
    {"SECTION CONTROLS", model, "NAME,DISTORTION CONTROL,LENGTH RATIO", "*",
     "DISTORTION CONTROL=YES: distortion_control of the parts that name it, LENGTH RATIO or 0.1. Hourglass control is "
     "Carom's own (part.hourglass)."},
    {"SECTION FILE", output, "", "*", "Results over sections."},
    {"SECTION PRINT", output, "", "*", "Results over sections."},
    {"SELECT CYCLIC SYMMETRY MODES", refused, "", "", "The step is left out."},
    {"SHELL SECTION", refused, "", "", "Carom has no shells."},
    {"SOLID SECTION", model, "ELSET,MATERIAL,CONTROLS", "ORIENTATION",
     "A part; the thickness of plane cells, the area of bars."},
    {"SOLUTION TECHNIQUE", solver, "", "*", "Steers the solver of the other program; Carom's own settings hold."},
    {"SOLVER CONTROLS", solver, "", "*", "Steers the solver of the other program; Carom's own settings hold."},
    {"SPECIFIC HEAT", model, "", "DEPENDENCIES", "specific_heat of Johnson and Cook's law."},
    {"SPRING", model, "ELSET", "", "SPRINGA: between two nodes; SPRING1: to the ground along x, y or z. Linear ones."},
    {"STATIC", step, "DIRECT", "SOLVER",
     "statics; loads and motions without an amplitude grow with the time of the step."},
    {"STEADY STATE DYNAMICS", refused, "", "", "The step is left out."},
    {"STEP", step, "NLGEOM,NAME,AMPLITUDE", "INC,UNSYMM,EXTRAPOLATION,CONVERT SDI,SOLVER", "A stage of the run."},
    {"SUBMODEL", refused, "", "", "Nothing would be imposed there."},
    {"SUBSTRUCTURE MATRIX OUTPUT", output, "", "*", "Matrices of the other program."},
    {"SUBSTRUCTURE OUTPUT", output, "", "*", "Matrices of the other program."},
    {"SURFACE", mesh, "NAME,TYPE,INTERNAL", "",
     "TYPE=ELEMENT: a group of faces; TYPE=NODE: a group of nodes; SEGMENTS, CYLINDER, REVOLUTION: an analytical rigid "
     "surface, as faces."},
    {"SURFACE BEHAVIOR", model, "PRESSURE-OVERCLOSURE", "PENALTY,DIRECT",
     "HARD: the stiffness that Carom chooses; LINEAR: its slope as the stiffness."},
    {"SURFACE INTERACTION", model, "NAME", "", "What contacts have: stiffness and friction."},
    {"SURFACE OUTPUT", output, "", "*", "Results on surfaces."},
    {"SYSTEM", refused_mesh, "", "", "Nodes would stand elsewhere."},
    {"TEMPERATURE", refused, "", "", "There would be no thermal strains."},
    {"TIE", model, "TYPE,POSITION TOLERANCE", "NAME,ADJUST,NO ROTATION",
     "Two surfaces that stay together, slave and master. Nodes keep their places, at whatever distance within the "
     "tolerance, also with ADJUST=YES; POSITION TOLERANCE: nodes that are farther away are left free, else refused."},
    {"TIME POINTS", output, "", "*", "When the other program writes."},
    {"TRACER PARTICLE", output, "", "*", "Results along paths of the material."},
    {"TRANSFORM", refused, "", "", "Supports and forces would act along the global axes."},
    {"USER MATERIAL", refused, "", "", "Carom has laws of its own only."},
    {"USER OUTPUT VARIABLES", output, "", "*", "Results of the user's own."},
    {"VARIABLE MASS SCALING", step, "DT,TYPE", "FREQUENCY,NUMBER INTERVAL",
     "As *FIXED MASS SCALING, at the start alone, if it is accepted."},
    {"VIEWFACTOR OUTPUT", output, "", "*", "Results of radiation."},
    {"VISCO", refused, "", "", "The step is left out."},
}};

template <class Visit>
void for_each_name(std::string_view list, const Visit& visit) {
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    visit(list.substr(0, comma));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
}

}  // namespace

std::span<const KeywordEntry> keyword_table() {
  return kKeywords;
}

std::string without_blanks(std::string_view text) {
  std::string kept;
  for (const char c : text) {
    if (c == ' ' || c == '\t') continue;
    kept += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return kept;
}

const KeywordEntry* find_keyword(std::string_view name) {
  constexpr std::size_t shortest = 4;
  const std::string wanted = without_blanks(name);
  const KeywordEntry* beginning = nullptr;
  int fitting = 0;
  for (const KeywordEntry& entry : kKeywords) {
    const std::string own = without_blanks(entry.name);
    if (own == wanted) return &entry;
    if (wanted.size() < shortest || !own.starts_with(wanted)) continue;
    beginning = &entry;
    ++fitting;
  }
  return fitting == 1 ? beginning : nullptr;
}

std::string parameter_name(const KeywordEntry& entry, std::string_view given) {
  constexpr std::size_t shortest = 3;
  const std::string wanted = without_blanks(given);
  std::string exact, beginning;
  int fitting = 0;
  const auto compare = [&](std::string_view name) {
    const std::string own = without_blanks(name);
    if (own == wanted) exact = name;
    if (wanted.size() < shortest || !own.starts_with(wanted)) return;
    beginning = name;
    ++fitting;
  };
  for_each_name(entry.parameters, compare);
  for_each_name(entry.noted, compare);
  if (!exact.empty()) return exact;
  return fitting == 1 ? beginning : wanted;
}

bool is_listed(std::string_view list, std::string_view name) {
  bool is_there = false;
  for_each_name(list, [&](std::string_view entry) { is_there = is_there || entry == name || entry == "*"; });
  return is_there;
}

}  // namespace carom
