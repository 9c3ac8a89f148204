#include "deck/keyword_table.hpp"

#include <algorithm>
#include <array>

namespace carom {

namespace {

using enum KeywordUse;

constexpr std::array<KeywordEntry, 167> kKeywords{{
    {.name = "AMPLITUDE",
     .use = model,
     .parameters = "NAME,TIME,DEFINITION,VALUE,FIXED INTERVAL,BEGIN",
     .meaning = "A function of time: TABULAR, EQUALLY SPACED, or SMOOTH STEP, which becomes a table of 33 points."},
    {.name = "ASSEMBLY", .use = mesh, .parameters = "NAME", .meaning = "Begins the list of instances."},
    {.name = "BASE MOTION", .use = refused, .meaning = "The supports would stand still."},
    {.name = "BEAM GENERAL SECTION", .use = refused, .meaning = "Carom has no beams."},
    {.name = "BEAM SECTION", .use = refused, .meaning = "Carom has no beams."},
    {.name = "BOUNDARY",
     .use = step,
     .parameters = "OP,AMPLITUDE,TYPE",
     .meaning = "Supports and imposed motions; turns of rigid bodies."},
    {.name = "BUCKLE", .use = refused, .meaning = "The step is left out."},
    {.name = "BULK VISCOSITY", .use = step, .meaning = "Linear and quadratic bulk viscosity of all parts."},
    {.name = "CFLUX", .use = refused, .meaning = "Carom computes no flow of heat."},
    {.name = "CHANGE FRICTION",
     .use = refused,
     .parameters = "INTERACTION",
     .meaning = "Friction would stay as it was."},
    {.name = "CHANGE SURFACE BEHAVIOR",
     .use = refused,
     .parameters = "INTERACTION",
     .meaning = "Contact would stay as it was."},
    {.name = "CLEARANCE", .use = refused, .meaning = "Gaps would be those of the mesh."},
    {.name = "CLOAD", .use = step, .parameters = "OP,AMPLITUDE", .meaning = "Forces on nodes."},
    {.name = "COMPLEX FREQUENCY", .use = refused, .meaning = "The step is left out."},
    {.name = "CONDUCTIVITY",
     .use = model,
     .noted = "*",
     .meaning =
         "Changes nothing where no step computes temperatures; where one does, the step is adiabatic if it is accepted."},
    {.name = "CONNECTOR SECTION", .use = refused, .meaning = "The connector would be left out."},
    {.name = "CONTACT",
     .use = step,
     .noted = "OP",
     .meaning = "General contact: every outer face may touch every other."},
    {.name = "CONTACT CONTROLS",
     .use = solver,
     .noted = "*",
     .meaning = "Steers the contact of the other program; contact is enforced as Carom does."},
    {.name = "CONTACT CONTROLS ASSIGNMENT",
     .use = solver,
     .noted = "*",
     .meaning = "Steers the contact of the other program; contact is enforced as Carom does."},
    {.name = "CONTACT DAMPING", .use = refused, .meaning = "Contact would not damp."},
    {.name = "CONTACT EXCLUSIONS",
     .use = model,
     .meaning =
         "Beside ALL EXTERIOR: a line with the second name alone takes that surface, or a rigid body, out of general "
         "contact. What keeps two surfaces apart is refused unless accepted."},
    {.name = "CONTACT FILE",
     .use = output,
     .noted = "*",
     .meaning = "Results of contact are in contact.csv and the fields."},
    {.name = "CONTACT FORMULATION",
     .use = solver,
     .noted = "*",
     .meaning = "Steers the contact of the other program; contact is enforced as Carom does."},
    {.name = "CONTACT INCLUSIONS",
     .use = step,
     .parameters = "ALL EXTERIOR",
     .meaning =
         "ALL EXTERIOR: every outer face may touch every other; else pairs of the surfaces that the lines name."},
    {.name = "CONTACT OUTPUT",
     .use = output,
     .noted = "*",
     .meaning = "Results of contact are in contact.csv and the fields."},
    {.name = "CONTACT PAIR",
     .use = model,
     .parameters = "INTERACTION,TYPE,ADJUST,OP",
     .noted = "SMALL SLIDING,MECHANICAL CONSTRAINT,CPSET,EXTENSION ZONE,TRACKING",
     .meaning =
         "Contact of two surfaces, slave and master; sliding is always followed. ADJUST=0: overlaps at the start count as "
         "touching; other values, which close gaps, are refused unless accepted."},
    {.name = "CONTACT PRINT",
     .use = output,
     .noted = "*",
     .meaning = "Results of contact are in contact.csv and the fields."},
    {.name = "CONTACT PROPERTY ASSIGNMENT",
     .use = step,
     .meaning = "The interaction of general contact: one for all surfaces, of chosen surfaces also for two of them."},
    {.name = "CONTACT RESPONSE", .use = output, .noted = "*", .meaning = "Sensitivities of results."},
    {.name = "CONTROLS",
     .use = solver,
     .noted = "*",
     .meaning = "Steers the solver of the other program; Carom's own settings hold."},
    {.name = "COUPLED TEMPERATURE-DISPLACEMENT", .use = refused, .meaning = "The step is left out."},
    {.name = "COUPLING",
     .use = model,
     .parameters = "REF NODE,SURFACE",
     .noted = "CONSTRAINT NAME",
     .meaning = "Nodes that move as one rigid body with the reference node, with *KINEMATIC behind it."},
    {.name = "CREEP", .use = refused, .meaning = "The material would not creep."},
    {.name = "CYCLIC SYMMETRY MODEL", .use = refused, .meaning = "Nothing would hold the edges of the sector."},
    {.name = "DAMAGE EVOLUTION",
     .use = model,
     .parameters = "TYPE",
     .noted = "SOFTENING,MIXED MODE BEHAVIOR,MODE MIX RATIO,DEGRADATION",
     .meaning =
         "0 after *DAMAGE INITIATION: cells go where their damage reaches 1. Others, under which the stress softens first, "
         "are refused unless accepted: cells would go at once."},
    {.name = "DAMAGE INITIATION",
     .use = model,
     .parameters = "CRITERION",
     .meaning =
         "CRITERION=JOHNSON COOK: damage of the material, D3 with the other sign; without *DAMAGE EVOLUTION no cell goes. "
         "Other criteria are refused unless accepted: nothing would break."},
    {.name = "DAMAGE STABILIZATION", .use = solver, .noted = "*", .meaning = "Steers how the other program softens."},
    {.name = "DAMPING", .use = refused, .meaning = "The bodies would not be damped."},
    {.name = "DASHPOT", .use = refused, .meaning = "The damper would be left out."},
    {.name = "DENSITY", .use = model, .meaning = "Density, at the temperature of the start."},
    {.name = "DEPVAR", .use = refused, .meaning = "Belongs to a material of the user's own."},
    {.name = "DIAGNOSTICS", .use = output, .noted = "*", .meaning = "Messages of the other program."},
    {.name = "DISPLAY BODY", .use = output, .noted = "*", .meaning = "Shows an instance that takes no part."},
    {.name = "DISTRIBUTING", .use = refused, .meaning = "The reference node of the *COUPLING would pull at nothing."},
    {.name = "DISTRIBUTING COUPLING", .use = refused, .meaning = "The reference node would pull at nothing."},
    {.name = "DISTRIBUTION", .use = output, .noted = "*", .meaning = "A table of values, which nothing here uses."},
    {.name = "DISTRIBUTION TABLE",
     .use = output,
     .noted = "*",
     .meaning = "A table of values, which nothing here uses."},
    {.name = "DLOAD",
     .use = step,
     .parameters = "OP,AMPLITUDE",
     .meaning = "P and P1 to P6: pressure on faces; GRAV: gravity, on all parts."},
    {.name = "DSLOAD", .use = step, .parameters = "OP,AMPLITUDE", .meaning = "P: pressure on a surface."},
    {.name = "DYNAMIC",
     .use = step,
     .parameters = "EXPLICIT,DIRECT,ALPHA,ADIABATIC,APPLICATION,TIME INTEGRATOR",
     .noted = "DIRECT USER CONTROL,NOHAF,HAFTOL,INITIAL,SOLVER,ELEMENT BY ELEMENT,FIXED TIME "
              "INCREMENTATION,IMPROVED DT METHOD,SCALE FACTOR",
     .meaning =
         "hht (alpha -0.05 where none is given) or, with EXPLICIT, central_differences. APPLICATION=MODERATE DISSIPATION: "
         "alpha -1/3; QUASI-STATIC, which is refused unless accepted, too, and loads grow with the time of the step."},
    {.name = "DYNAMIC TEMPERATURE-DISPLACEMENT",
     .use = step,
     .parameters = "EXPLICIT",
     .noted = "DIRECT USER CONTROL,ELEMENT BY ELEMENT,FIXED TIME INCREMENTATION,IMPROVED DT METHOD,SCALE FACTOR",
     .meaning = "central_differences, adiabatic, if it is accepted: heat would not flow."},
    {.name = "EL FILE", .use = output, .noted = "*", .meaning = "Stresses and strains are in the fields."},
    {.name = "EL PRINT", .use = output, .noted = "*", .meaning = "Stresses and strains are in the fields."},
    {.name = "ELASTIC",
     .use = model,
     .parameters = "TYPE",
     .meaning = "TYPE=ISOTROPIC: Young's modulus and Poisson's ratio, at the temperature of the start."},
    {.name = "ELCOPY", .use = refused_mesh, .meaning = "Elements made by the other program are missing."},
    {.name = "ELEMENT",
     .use = mesh,
     .parameters = "TYPE,ELSET",
     .meaning = "Cells, point masses and springs (docs/decks.md)."},
    {.name = "ELEMENT MATRIX OUTPUT", .use = output, .noted = "*", .meaning = "Matrices of the other program."},
    {.name = "ELEMENT OUTPUT", .use = output, .noted = "*", .meaning = "Stresses and strains are in the fields."},
    {.name = "ELEMENT RESPONSE", .use = output, .noted = "*", .meaning = "Sensitivities of results."},
    {.name = "ELGEN",
     .use = mesh,
     .parameters = "ELSET",
     .meaning = "Copies of an element in rows and layers, by increments of the numbers."},
    {.name = "ELSET",
     .use = mesh,
     .parameters = "ELSET,GENERATE,INSTANCE,INTERNAL,UNSORTED",
     .meaning = "A group of cells."},
    {.name = "END ASSEMBLY", .use = mesh, .meaning = "Ends the list of instances."},
    {.name = "END INSTANCE", .use = mesh, .meaning = "Ends an instance."},
    {.name = "END PART", .use = mesh, .meaning = "Ends a part."},
    {.name = "END STEP", .use = step, .meaning = "Ends a step."},
    {.name = "ENERGY FILE", .use = output, .noted = "*", .meaning = "Energies are in energy.csv."},
    {.name = "ENERGY OUTPUT", .use = output, .noted = "*", .meaning = "Energies are in energy.csv."},
    {.name = "ENERGY PRINT", .use = output, .noted = "*", .meaning = "Energies are in energy.csv."},
    {.name = "EQUATION",
     .use = model,
     .meaning =
         "A linear homogeneous equation between displacements; the first term is the dependent one. Sets are matched by "
         "the places of their nodes."},
    {.name = "EXPANSION",
     .use = model,
     .noted = "*",
     .meaning = "Changes nothing where no temperature changes; else there would be no thermal strains."},
    {.name = "EXTREME ELEMENT VALUE", .use = output, .noted = "*", .meaning = "Watches results of the other program."},
    {.name = "EXTREME NODE VALUE", .use = output, .noted = "*", .meaning = "Watches results of the other program."},
    {.name = "EXTREME VALUE", .use = output, .noted = "*", .meaning = "Watches results of the other program."},
    {.name = "FACE PRINT", .use = output, .noted = "*", .meaning = "Results on surfaces."},
    {.name = "FILE FORMAT", .use = output, .noted = "*", .meaning = "Results files of the other program."},
    {.name = "FILE OUTPUT", .use = output, .noted = "*", .meaning = "Results files of the other program."},
    {.name = "FILM", .use = refused, .meaning = "Carom computes no flow of heat."},
    {.name = "FILTER", .use = output, .noted = "*", .meaning = "Filters results."},
    {.name = "FIXED MASS SCALING",
     .use = step,
     .parameters = "DT,TYPE,ELSET,FACTOR",
     .meaning =
         "DT with TYPE=BELOW MIN, of all parts: mass_scaling_step, without a limit, also in later steps that say nothing "
         "of it. A FACTOR, and sets that are not all parts, are refused unless accepted."},
    {.name = "FREQUENCY", .use = refused, .meaning = "The step is left out."},
    {.name = "FRICTION",
     .use = model,
     .noted = "SLIP TOLERANCE,ELASTIC SLIP",
     .meaning = "Coulomb's coefficient, and in CalculiX the stiffness of sticking."},
    {.name = "GAP", .use = refused, .meaning = "The gap element would be left out."},
    {.name = "GAP CONDUCTANCE", .use = refused, .meaning = "Carom computes no flow of heat."},
    {.name = "HEADING", .use = model, .meaning = "Title."},
    {.name = "HEAT TRANSFER", .use = refused, .meaning = "The step is left out."},
    {.name = "HOURGLASS STIFFNESS",
     .use = solver,
     .noted = "*",
     .meaning = "Hourglass control is Carom's own (part.hourglass)."},
    {.name = "HYPERELASTIC",
     .use = model,
     .parameters = "NEO HOOKE",
     .noted = "MODULI",
     .meaning =
         "NEO HOOKE with C10, D1: the compressible neo-Hookean law with mu = 2 C10 and the bulk modulus 2 / D1; equal at "
         "small strains, see docs/decks.md."},
    {.name = "INCLUDE", .use = mesh, .parameters = "INPUT", .meaning = "Another file in this place."},
    {.name = "INCREMENTATION OUTPUT", .use = output, .noted = "*", .meaning = "Messages of the other program."},
    {.name = "INELASTIC HEAT FRACTION", .use = model, .meaning = "taylor_quinney of Johnson and Cook's law."},
    {.name = "INITIAL CONDITIONS",
     .use = model,
     .parameters = "TYPE",
     .meaning =
         "TYPE=VELOCITY (of nodes) and ROTATING VELOCITY (of nodes or cells); TEMPERATURE, one for all nodes of a material "
         "and 0 where none is given: initial_temperature of Johnson and Cook's law, and at which tables are taken."},
    {.name = "INSTANCE",
     .use = mesh,
     .parameters = "NAME,PART",
     .meaning = "A part at its place: shifted, then turned."},
    {.name = "INTEGRATED OUTPUT", .use = output, .noted = "*", .meaning = "Results over sections."},
    {.name = "INTEGRATED OUTPUT SECTION",
     .use = output,
     .noted = "*",
     .meaning = "Results over sections; [[probe]] section_force has them."},
    {.name = "KINEMATIC",
     .use = model,
     .meaning = "All nodes of the *COUPLING before it are joined to its reference node."},
    {.name = "KINEMATIC COUPLING", .use = refused, .meaning = "The reference node would hold nothing."},
    {.name = "MASS", .use = model, .parameters = "ELSET", .meaning = "Point masses."},
    {.name = "MATERIAL", .use = model, .parameters = "NAME", .meaning = "A material."},
    {.name = "MATRIX OUTPUT", .use = output, .noted = "*", .meaning = "Matrices of the other program."},
    {.name = "MEMBRANE SECTION", .use = refused, .meaning = "Carom has no membranes."},
    {.name = "MODAL DAMPING", .use = refused, .meaning = "The bodies would not be damped."},
    {.name = "MODAL DYNAMIC", .use = refused, .meaning = "The step is left out."},
    {.name = "MODAL FILE", .use = output, .noted = "*", .meaning = "Results of modal steps."},
    {.name = "MODAL OUTPUT", .use = output, .noted = "*", .meaning = "Results of modal steps."},
    {.name = "MODAL PRINT", .use = output, .noted = "*", .meaning = "Results of modal steps."},
    {.name = "MODEL CHANGE", .use = refused, .meaning = "Cells and contacts would stay."},
    {.name = "MONITOR", .use = output, .noted = "*", .meaning = "Messages of the other program."},
    {.name = "MPC", .use = refused, .meaning = "The nodes would not be coupled."},
    {.name = "NCOPY", .use = refused_mesh, .meaning = "Nodes made by the other program are missing."},
    {.name = "NFILL", .use = refused_mesh, .meaning = "Nodes made by the other program are missing."},
    {.name = "NGEN",
     .use = mesh,
     .parameters = "NSET,LINE",
     .meaning = "Nodes evenly on the straight line between two others; LINE, which bends it, is refused."},
    {.name = "NMAP", .use = refused_mesh, .meaning = "Nodes moved by the other program stand elsewhere."},
    {.name = "NODE", .use = mesh, .parameters = "NSET", .meaning = "Nodes."},
    {.name = "NODE FILE", .use = output, .noted = "*", .meaning = "Displacements and velocities are in the fields."},
    {.name = "NODE OUTPUT",
     .use = output,
     .parameters = "NSET",
     .noted = "*",
     .meaning =
         "Probes of displacement, velocity and acceleration (U, V, A, and their components) where it names a set."},
    {.name = "NODE PRINT",
     .use = output,
     .parameters = "NSET",
     .noted = "*",
     .meaning = "Probes of displacement and velocity of the set."},
    {.name = "NODE RESPONSE", .use = output, .noted = "*", .meaning = "Sensitivities of results."},
    {.name = "NORMAL", .use = refused, .meaning = "Belongs to shells and beams."},
    {.name = "NSET",
     .use = mesh,
     .parameters = "NSET,GENERATE,ELSET,INSTANCE,INTERNAL,UNSORTED",
     .meaning = "A group of nodes."},
    {.name = "ORIENTATION",
     .use = output,
     .noted = "*",
     .meaning = "Isotropic laws know no directions; results are along the axes."},
    {.name = "OUTPUT", .use = output, .noted = "*", .meaning = "How often the other program writes."},
    {.name = "PART", .use = mesh, .parameters = "NAME", .meaning = "A part, used by instances."},
    {.name = "PHYSICAL CONSTANTS", .use = output, .noted = "*", .meaning = "Constants that nothing here uses."},
    {.name = "PLASTIC",
     .use = model,
     .parameters = "HARDENING,RATE",
     .meaning =
         "HARDENING=ISOTROPIC: table of yield stress (Cauchy) and plastic strain at the temperature of the start, one for each "
         "RATE; "
         "JOHNSON COOK."},
    {.name = "POST OUTPUT", .use = output, .noted = "*", .meaning = "Results files of the other program."},
    {.name = "PREPRINT", .use = output, .noted = "*", .meaning = "Messages of the other program."},
    {.name = "PRE-TENSION SECTION", .use = refused, .meaning = "Nothing would be tightened."},
    {.name = "PRINT", .use = output, .noted = "*", .meaning = "Messages of the other program."},
    {.name = "RADIATION FILE", .use = output, .noted = "*", .meaning = "Results of radiation."},
    {.name = "RADIATION OUTPUT", .use = output, .noted = "*", .meaning = "Results of radiation."},
    {.name = "RADIATION PRINT", .use = output, .noted = "*", .meaning = "Results of radiation."},
    {.name = "RATE DEPENDENT",
     .use = model,
     .parameters = "TYPE",
     .meaning =
         "TYPE=JOHNSON COOK: C and the reference rate; POWER LAW, YIELD RATIO: the table times the ratio at several "
         "rates."},
    {.name = "RESTART",
     .use = step,
     .noted = "WRITE,FREQUENCY,OVERLAY,NUMBER INTERVAL,TIME MARKS",
     .meaning =
         "Carom writes checkpoints by itself (output.checkpoint_every). READ, which goes on with another run, is refused."},
    {.name = "RIGID BODY",
     .use = model,
     .parameters = "ELSET,NSET,REF NODE,ROT NODE,ANALYTICAL SURFACE,TIE NSET,PIN NSET,POSITION",
     .noted = "ISOTHERMAL",
     .meaning =
         "A surface of faces that moves and turns with its reference node, or, where that has a *MASS, is free in what "
         "*BOUNDARY does not hold. It is met by *CONTACT PAIR, as the second surface, or by general contact. Of solids: a [[rigid_body]] of parts; TIE NSET and "
         "PIN NSET: nodes that are joined to it; NSET: nodes alone. ROT NODE: its motions are the turns."},
    {.name = "ROTARY INERTIA",
     .use = model,
     .parameters = "ELSET",
     .meaning = "Of the reference node of a free rigid body of faces or of nodes, which turns by it."},
    {.name = "SECTION CONTROLS",
     .use = model,
     .parameters = "NAME,DISTORTION CONTROL,LENGTH RATIO,ELEMENT DELETION",
     .noted = "*",
     .meaning =
         "DISTORTION CONTROL=YES: distortion_control of the parts that name it, LENGTH RATIO or 0.1. Factors of the bulk "
         "viscosities, the fourth and the fifth number, hold; hourglass control is Carom's own (part.hourglass)."},
    {.name = "SECTION FILE", .use = output, .noted = "*", .meaning = "Results over sections."},
    {.name = "SECTION PRINT", .use = output, .noted = "*", .meaning = "Results over sections."},
    {.name = "SELECT CYCLIC SYMMETRY MODES", .use = refused, .meaning = "The step is left out."},
    {.name = "SHELL SECTION", .use = refused, .meaning = "Carom has no shells."},
    {.name = "SOLID SECTION",
     .use = model,
     .parameters = "ELSET,MATERIAL,CONTROLS",
     .noted = "ORIENTATION",
     .meaning = "A part; the thickness of plane cells, the area of bars."},
    {.name = "SOLUTION TECHNIQUE",
     .use = solver,
     .noted = "*",
     .meaning = "Steers the solver of the other program; Carom's own settings hold."},
    {.name = "SOLVER CONTROLS",
     .use = solver,
     .noted = "*",
     .meaning = "Steers the solver of the other program; Carom's own settings hold."},
    {.name = "SPECIFIC HEAT",
     .use = model,
     .noted = "DEPENDENCIES",
     .meaning = "specific_heat of Johnson and Cook's law."},
    {.name = "SPRING",
     .use = model,
     .parameters = "ELSET",
     .meaning = "SPRINGA: between two nodes; SPRING1: to the ground along x, y or z. Linear ones."},
    {.name = "STATIC",
     .use = step,
     .parameters = "DIRECT",
     .noted = "SOLVER",
     .meaning = "statics; loads and motions without an amplitude grow with the time of the step."},
    {.name = "STEADY STATE DYNAMICS", .use = refused, .meaning = "The step is left out."},
    {.name = "STEP",
     .use = step,
     .parameters = "NLGEOM,NAME,AMPLITUDE",
     .noted = "INC,UNSYMM,EXTRAPOLATION,CONVERT SDI,SOLVER",
     .meaning = "A stage of the run."},
    {.name = "SUBMODEL", .use = refused, .meaning = "Nothing would be imposed there."},
    {.name = "SUBSTRUCTURE MATRIX OUTPUT", .use = output, .noted = "*", .meaning = "Matrices of the other program."},
    {.name = "SUBSTRUCTURE OUTPUT", .use = output, .noted = "*", .meaning = "Matrices of the other program."},
    {.name = "SURFACE",
     .use = mesh,
     .parameters = "NAME,TYPE,COMBINE,INTERNAL",
     .meaning =
         "TYPE=ELEMENT: a group of faces; TYPE=NODE: a group of nodes; COMBINE=UNION of others; SEGMENTS, CYLINDER, REVOLUTION: an analytical rigid "
         "surface, as faces."},
    {.name = "SURFACE BEHAVIOR",
     .use = model,
     .parameters = "PRESSURE-OVERCLOSURE",
     .noted = "PENALTY,DIRECT,AUGMENTED LAGRANGE",
     .meaning = "HARD: the stiffness that Carom chooses; LINEAR: its slope as the stiffness; TABULAR: pressure over "
                "overclosure, from 0, 0 on, of rigid surfaces."},
    {.name = "SURFACE INTERACTION",
     .use = model,
     .parameters = "NAME",
     .meaning = "What contacts have: stiffness and friction."},
    {.name = "SURFACE OUTPUT", .use = output, .noted = "*", .meaning = "Results on surfaces."},
    {.name = "SURFACE SECTION",
     .use = model,
     .parameters = "ELSET",
     .meaning = "Nothing: elements without a density that surfaces are made of."},
    {.name = "SYSTEM", .use = refused_mesh, .meaning = "Nodes would stand elsewhere."},
    {.name = "TEMPERATURE",
     .use = refused,
     .meaning = "There would be no thermal strains, and tables be taken at the temperature of the start."},
    {.name = "TIE",
     .use = model,
     .parameters = "TYPE,POSITION TOLERANCE",
     .noted = "NAME,ADJUST,NO ROTATION",
     .meaning =
         "Two surfaces that stay together, slave and master. Nodes keep their places, at whatever distance within the "
         "tolerance, also with ADJUST=YES; POSITION TOLERANCE: nodes that are farther away are left free, else refused."},
    {.name = "TIME POINTS", .use = output, .noted = "*", .meaning = "When the other program writes."},
    {.name = "TRACER PARTICLE", .use = output, .noted = "*", .meaning = "Results along paths of the material."},
    {.name = "TRANSFORM", .use = refused, .meaning = "Supports and forces would act along the global axes."},
    {.name = "USER MATERIAL", .use = refused, .meaning = "Carom has laws of its own only."},
    {.name = "USER OUTPUT VARIABLES", .use = output, .noted = "*", .meaning = "Results of the user's own."},
    {.name = "VARIABLE MASS SCALING",
     .use = step,
     .parameters = "DT,TYPE,ELSET,FACTOR",
     .noted = "FREQUENCY,NUMBER INTERVAL",
     .meaning = "As *FIXED MASS SCALING, at the start alone, if it is accepted."},
    {.name = "VIEWFACTOR OUTPUT", .use = output, .noted = "*", .meaning = "Results of radiation."},
    {.name = "VISCO", .use = refused, .meaning = "The step is left out."},
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
