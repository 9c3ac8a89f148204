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

A deck is told by its first line that is no comment, which begins with `*` and a letter, whatever the file is called.
It is translated into the tree of a case, so that errors of the case name the line of the deck.

**Nothing is dropped silently.** Every keyword and parameter that is not understood is listed with its line. What asks for
results only, or steers the solver of the other program, is a note. What changes the physics refuses the run, all of it in
one message; `--accept "KEYWORD,KEYWORD"` runs without what is named, and the loss becomes a note. Keywords that make
nodes or elements, such as `*NGEN`, are refused in any case: the mesh would be another one.

## Syntax

Upper and lower case are the same, blanks in keywords do not count, keywords and parameters may be shortened where the
beginning (four letters, three of a parameter) fits one name only. Keyword lines that end with a comma go on; `**` begins a
comment; exponents may be written with `D`; names with blanks stand in quotes; `*INCLUDE` counts from the folder of the
file that it stands in. Parts may be used by several instances, shifted and turned; numbers restart in every part, and in
Carom the numbers of an instance count on from the largest before it. Names and numbers of an instance are written
`INSTANCE.NAME`. Sets given several times are united. Names come out in upper case.

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

A `*RIGID BODY` of faces (R3D3, R3D4, in the plane R2D2, around an axis RAX2) is an obstacle.
- Its reference node is held or moved along all axes by `*BOUNDARY`, with `TYPE=DISPLACEMENT` or `VELOCITY`. Degrees of
  freedom 4 to 6, in the plane 6, turn it about the node, through finite angles, by one amplitude for all: the axis keeps its
  direction and travels with the node. About what is not imposed it does not turn. Behind its last imposed displacement
  or turn it stays.
- Or the node is free along all axes and has a `*MASS`, at which the centre of mass is. With a `*ROTARY INERTIA` it turns
  freely, in the plane by I33; without, or where `*BOUNDARY` holds all of its turns, it does not.
  `*INITIAL CONDITIONS` may give its velocity and angular velocity (degrees of freedom 4 to 6, or `ROTATING VELOCITY`).

What is neither is refused: a node that is free along or about some of the axes only, or held in its place and, with a
`*ROTARY INERTIA`, free to turn.

It is met from the side of its normal: by the right-hand rule, of R2D2 and RAX2 a quarter turn counter-clockwise from
the first node to the second; `SNEG` names the other side. What would pass from behind is refused.

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
      "keyword "
      "that is not\nlisted is refused unless accepted.\n\n"
      "| keyword | what becomes of it | parameters | change nothing | |\n|---|---|---|---|---|\n";
  for (const KeywordEntry& entry : keyword_table())
    text += fmt::format("| `*{}` | {} | {} | {} | {} |\n", entry.name, use_in_words(entry.use),
                        spaced(entry.parameters), entry.noted == "*" ? "all" : spaced(entry.noted), entry.meaning);
  return text;
}

std::string elements() {
  std::string text =
      "\n## Elements\n\nTypes without a section are faces and lines: surfaces may be made of them, bodies not. Which "
      "cells "
      "a part may have stands in\n[cells.md](cells.md).\n\n| type | cell | section | formulation | "
      "|\n|---|---|---|---|---|\n";
  for (const DeckElementType& type : deck_element_types()) {
    const bool is_cell = type.kind == DeckElementType::Kind::cell;
    const char* discrete = type.kind == DeckElementType::Kind::mass      ? "point mass"
                           : type.kind == DeckElementType::Kind::inertia ? "rotary inertia"
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
