#include "translate/decks_page.hpp"

#include <fmt/format.h>

#include "deck/keyword_table.hpp"
#include "mesh/deck_elements.hpp"

namespace carom {

namespace {

constexpr const char* introduction = R"(# Decks of Abaqus and CalculiX

<!-- Written from the tables in src/deck and src/mesh; do not edit. -->

Carom reads decks (`.inp`) as meshes (`carom mesh x.inp`, or `file = "x.inp"` in `[mesh]`) and as cases:

```sh
carom check deck.inp                     # what would be run, with a note for all that is not as in the deck
carom run deck.inp --out out/deck
carom convert deck.inp -o case.toml      # the same as a case file, and its mesh beside it as case.msh
```

A deck is told by its first line that is no comment, which begins with `*` and a letter, whatever the file is called. Files
of LS-DYNA, Nastran, Radioss and Ansys are told apart from it, and said to be what they seem to be.
It is translated into the tree of a case, so that errors of the case name the line of the deck.

**Nothing is dropped silently.** Every keyword and parameter that is not understood is listed with its line. What asks for
results only, or steers the solver of the other program, is a note. What changes the physics refuses the run. Keywords that
make nodes or elements, such as `*NFILL`, are refused in any case: the mesh would be another one.

**All findings come in one message**, each with its file and line, in this order:
- what `--accept "KEYWORD,KEYWORD"` would run without, with the words to copy and what is then lost of each; in the run that
  accepts it the loss is a note;
- what has to be changed whatever is accepted: wrong values, unknown names, element types that Carom does not have;
- where all could be accepted, what would still be refused then.

Materials, interactions and amplitudes that nothing refers to are left out with a note, whatever they are. An element type that is not known hides nothing: its sets keep their names, and only what is made of its cells (sections, loads
and surfaces of them) is not looked at. `--accept` takes names of keywords alone; of others it says which one is near.

## Syntax

Upper and lower case are the same, blanks in keywords do not count, keywords and parameters may be shortened where the
beginning (four letters, three of a parameter) fits one name only. Keyword lines that end with a comma go on; `**` begins a
comment; exponents may be written with `D`; names with blanks stand in quotes; `*INCLUDE` counts from the folder of the
file that it stands in, as `INPUT` of other keywords does, a file of their data lines. Parts may be used by several instances, shifted and turned; numbers restart in every part, and in
Carom the numbers of an instance count on from the largest before it. Names and numbers of an instance are written
`INSTANCE.NAME`; messages say "cell 405 of instance PLATE-1". Sets given several times are united. Of a `GENERATE` the numbers that are
no nodes or elements are left out with a note; where none is one, the range is refused. Names come out in upper case, and are of
ASCII letters; titles may have any.

## Groups

An NSET is a group of nodes, an ELSET a group of cells, a SURFACE a group of faces or nodes, of the same name. Where a
node set or a surface has the name of other cells, its group is `NAME (nodes)` or `NAME (surface)`. A set of several
element types also has a group for each, `NAME C3D8R`. Nodes that `*BOUNDARY`, `*CLOAD` and `*INITIAL CONDITIONS` name by
number are groups of that number, and the faces that `*DLOAD` names are groups such as `EALL P3`. Faces are counted as in
both programs: hexahedra 1-2-3-4, 5-8-7-6, 1-5-6-2, 2-6-7-3, 3-7-8-4, 4-8-5-1; tetrahedra 1-2-3, 1-4-2, 2-4-3, 3-4-1; wedges
1-2-3, 4-6-5, 1-4-5-2, 2-5-6-3, 3-6-4-1; plane cells their edges. A `*SURFACE` line without a face takes those on the
outside of the mesh.

## Steps

Each step is a stage that goes on where the one before ended. Loads and imposed motions without an amplitude grow with the
time of a static step and act at once in a dynamic one (`AMPLITUDE` of `*STEP` says otherwise); they hold until a later step
says something else, and `OP=NEW` ends loads that it does not name again. Amplitudes in total time go on in
later steps. Supports and contact hold for the whole run: those that begin with a later step, or are let go, are refused
unless accepted. A motion that
begins from another value than it has moves the nodes at once. Implicit steps have the first increment of the
deck, and are shortened where they fail; explicit ones follow from the stable step.

Rotations and strains are small unless a step says `NLGEOM`, as in Abaqus' standard program and in CalculiX; with
`*DYNAMIC, EXPLICIT`, without a value, they are finite unless it says `NLGEOM=NO`, as in Abaqus' explicit program, which also
has bulk viscosity 0.06 and 1.2 where none is given. With finite rotations `*ELASTIC` is St. Venant and Kirchhoff's law, as in
CalculiX; Abaqus integrates a rate, which differs at large elastic strains.

## Contact

The first surface of a pair is the slave. Both sides are searched unless `TYPE` says `NODE TO SURFACE` or `SURFACE TO
SURFACE`. `HARD` contact has the stiffness that Carom chooses. Overlaps at the start push, as in CalculiX; they
count as touching with `ADJUST=0`, and in decks of Abaqus' explicit program, which takes them away. Of a surface of nodes the faces between them touch, a group `NAME (faces)`, or the sides of bars where they alone
are between them; one that makes neither is refused.

A `*RIGID BODY` of faces (R3D3, R3D4, in the plane R2D2, around an axis RAX2) is an obstacle; of solids it is below.
- Its reference node is held or moved along all axes by `*BOUNDARY`, with `TYPE=DISPLACEMENT` or `VELOCITY`. Degrees of
  freedom 4 to 6, in the plane 6, turn it about the node, through finite angles, by one amplitude for all: the axis keeps its
  direction and travels with the node. About what is not imposed it does not turn. Behind its last imposed displacement
  or turn it stays.
- Or the node has a `*MASS`, at which the centre of mass is, and is free along the axes that `*BOUNDARY` does not hold: all, or
  some, as of the guided plate of a drop tower. With a `*ROTARY INERTIA` it turns freely (in the plane by I33), or, where
  `*BOUNDARY` holds its turns about two axes, about the third alone, as on a hinge; without one, or where all of its turns are
  held, it does not turn. `*INITIAL CONDITIONS` may give its velocity and angular velocity (degrees of freedom 4 to 6, or
  `ROTATING VELOCITY`).

What is neither is refused: a node that is moved along some axes and free along others, one without a `*MASS` that is held along
some axes only, and one that is held about one axis alone, which has no axis to turn about.

In a pair it is met from the side of its normal: by the right-hand rule, of R2D2 and RAX2 a quarter turn counter-clockwise
from the first node to the second; `SNEG` names the other side. What would pass from behind is refused. Of R3D3 and
R3D4 without `SPOS` or `SNEG` Abaqus' explicit program meets both sides: here that on which the deformable bodies are, as in
general contact; a note says so. In decks of that program the rigid surface may be named first.

General contact of chosen surfaces (`*CONTACT INCLUSIONS` with lines) is a pair for each line, of a surface alone with itself.
With `ALL EXTERIOR` it is `kind = "all"` between the bodies, and an obstacle for each rigid
body, which names no side. It is met from the side on which, seen from its face that is nearest to the middle of all nodes of
deformable bodies, that middle is; a note says so, and what then lies behind it is refused as in a pair. Faces that a `*TIE`
holds take no part ([ties.md](ties.md)). Analytical surfaces are met from the side of their normal here, too.

`*RIGID BODY, ANALYTICAL SURFACE` of a `*SURFACE` with `TYPE=SEGMENTS`, `CYLINDER` or `REVOLUTION` is made into faces: arcs
(`CIRCL`) into pieces of at most 3 degrees, revolutions into 72 pieces, the nodes of which are on the arc, so that the middles of
faces are inside of it by up to 0.03 % of its radius and 0.1 % of that of a revolution. Cylinders reach beyond the mesh by its
size on both sides. `PARAB` is refused. The outward normal is a quarter turn counter-clockwise from the way from `START` on, as in
Abaqus.

## Rigid bodies of cells and of nodes

A `*RIGID BODY` of solids is a [`[[rigid_body]]`](case_format.md#rigid_body) of their parts, with the mass and the inertia of
its cells; a section of cells is in it as a whole or not at all. Nodes that deformable cells share with it are joined to it,
and so are those of `TIE NSET` or `PIN NSET`, which are the same to nodes that do not turn. It touches in pairs, on either
side of them, and in general contact as any part does. A `*MASS` or `*ROTARY INERTIA` at its reference node, which Abaqus adds
to the cells', is refused unless accepted.

`*COUPLING` with `*KINEMATIC` of degrees of freedom 1 to 3 or all, and a `*RIGID BODY` of `TIE NSET` or `PIN NSET` alone, is a
`[[rigid_body]]` of these nodes with the `*MASS` and the `*ROTARY INERTIA` of the reference node, where its centre of mass is.
Without a `*ROTARY INERTIA` its turns have to be held, without a mass its motion has to be imposed as a whole: then its nodes
have supports alone. A `*COUPLING` to the reference node of a body of solids joins its nodes to that.

`*BOUNDARY` on a reference node becomes supports of all nodes of the body where these say the same: along one axis they also hold
the turns about the two others, along two axes all turns. So they are 1 with 5 and 6, 2 with 4 and 6, or 3 with 4 and 5, as `XSYMM`
and its like, and two or three of 1 to 3 with 4 to 6; their displacements, velocities and accelerations may be other than 0.
What is held otherwise is a guide of the body at the reference node, `blocked` and `blocked_turns`: hinges (1 to 3 with two of 4
to 6), balls (`PINNED`), bodies that slide without turning (4 to 6). Turns that are held about one axis alone are refused, and
turns that are imposed. `*CLOAD` acts where the reference node stands, and probes follow it. `*INITIAL CONDITIONS` at the
reference node give its velocity and the angular velocity about it.

## Temperatures

Nodes have no temperatures. Tables of `*ELASTIC`, `*PLASTIC`, `*DENSITY`, `*SPECIFIC HEAT` and `*HYPERELASTIC` are taken at that of
the start (`*INITIAL CONDITIONS, TYPE=TEMPERATURE`, 0 where none is given): linear between two that are given, and constant outside,
as in both programs; where a step heats or computes temperatures, tables of several are refused unless accepted. Only Johnson
and Cook's law heats, in steps that are `ADIABATIC` or compute temperatures. Imposed temperatures (degree of freedom 11) and thermal
strains are refused unless accepted.

## Damage

`*DAMAGE INITIATION, CRITERION=JOHNSON COOK` is `damage` of the material, D3 with the other sign
([material_laws.md](material_laws.md#damage)). Its temperatures have to be those of `*PLASTIC, HARDENING=JOHNSON COOK` where d5 is not
0. With a `*DAMAGE EVOLUTION` of 0 the parts of the material get an `[[erosion]]` at a damage of 1, by the first point of a cell that reaches
it. Without one Abaqus computes the damage alone, and so does Carom. CalculiX' form, which has a second line, is refused.

## neo-Hookean bodies

`*HYPERELASTIC, NEO HOOKE` has the energy C10 (I1 J^(-2/3) - 3) + (J - 1)^2 / D1, Carom's `neo_hookean` G/2 (I1 - 3) - G ln J +
lambda/2 (ln J)^2. With G = 2 C10 and lambda = 2 / D1 - 2 G / 3 both have the same moduli at rest and differ from the second
order of the strain on; so `--accept HYPERELASTIC` is asked for.

)";

const char* use_in_words(KeywordUse use) {
  switch (use) {
    case KeywordUse::mesh:
      return "mesh";
    case KeywordUse::model:
      return "case";
    case KeywordUse::step:
      return "step";
    case KeywordUse::output:
    case KeywordUse::solver:
      return "note";
    case KeywordUse::refused:
      return "refused unless accepted";
    case KeywordUse::refused_mesh:
      break;
  }
  return "refused";
}

std::string spaced(std::string_view list) {
  std::string text;
  for (const char c : list) {
    text += c;
    if (c == ',') text += ' ';
  }
  return text;
}

std::string keywords() {
  std::string text =
      "## Keywords\n\nParameters that are not listed are refused; those that change nothing here give a note. A "
      "keyword that is not\nlisted is refused unless accepted.\n\n"
      "| keyword | what becomes of it | parameters | change nothing | |\n|---|---|---|---|---|\n";
  for (const KeywordEntry& entry : keyword_table())
    text += fmt::format("| `*{}` | {} | {} | {} | {} |\n", entry.name, use_in_words(entry.use),
                        spaced(entry.parameters), entry.noted == "*" ? "all" : spaced(entry.noted), entry.meaning);
  return text;
}

std::string elements() {
  std::string text =
      "\n## Elements\n\nTypes without a section are faces and lines: surfaces may be made of them, bodies not. Which "
      "cells a part may have stands in\n[cells.md](cells.md).\n\n| type | cell | section | formulation | "
      "|\n|---|---|---|---|---|\n";
  for (const DeckElementType& type : deck_element_types()) {
    const bool is_cell = type.kind == DeckElementType::Kind::cell;
    const char* discrete = type.kind == DeckElementType::Kind::mass      ? "point mass"
                           : type.kind == DeckElementType::Kind::inertia ? "rotary inertia"
                           : type.kind == DeckElementType::Kind::unknown ? ""
                                                                         : "spring";
    text +=
        fmt::format("| `{}` | {} | {} | {} | {} |\n", type.name, is_cell ? name(type.type) : std::string_view(discrete),
                    type.section, type.formulation, type.remark);
  }
  return text;
}

}  // namespace

std::string decks_markdown() {
  return introduction + keywords() + elements();
}

}  // namespace carom
