// Malformed decks: one change of a good one each, and the whole message.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "casefile/read_case.hpp"
#include "translate/translate_deck.hpp"
#include "translate_fixture.hpp"

namespace carom::translate_malformed_test {
namespace {

std::string no_file(const std::string& path, const Location& where) {
  throw CaseError(where, "*INCLUDE", "no file " + path, "a file that can be read");
}

struct Spoiled {
  std::string name, from, to, message;
};

std::ostream& operator<<(std::ostream& out, const Spoiled& spoiled) {
  return out << spoiled.name;
}

class TranslateMalformed : public testing::TestWithParam<Spoiled> {};

TEST_P(TranslateMalformed, HasItsMessage) {
  std::string message = "no error";
  try {
    const std::string text = test::replaced(test::good_deck, GetParam().from, GetParam().to);
    case_of(translate_deck(text, "x.inp", {}, no_file).tree, "x.inp");
  } catch (const CaseError& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "x.inp" + GetParam().message);
}

const std::vector<Spoiled> spoiled_decks{
    {"text_before", "*HEADING", "hello\n*HEADING",
     ":1: found 'hello'; expected a keyword such as *NODE. A deck begins with a keyword; comments begin with **."},
    {"star_alone", "*MATERIAL, NAME=STEEL", "*\n*MATERIAL, NAME=STEEL",
     ":32: found a * alone; expected a keyword such as *NODE"},
    {"open_quote", "NSET=NALL", "NSET=\"NALL",
     ":3: *NODE: found '\"NALL'; expected a closing quotation mark. Names with blanks stand in \"quotes\"."},
    {"latin_name", "NSET=NALL", "NSET=N\xc4",
     ":3: *NODE: found 'NSET=N\xc3\x84'; expected letters of ASCII, without umlauts and accents. Rename it, wherever "
     "the deck has it."},
    {"include_nothing", "*HEADING", "*INCLUDE\n*HEADING",
     ":1: *INCLUDE: found no file; expected INPUT=NAME. *INCLUDE, INPUT=mesh.inp reads that file in this place."},
    {"include_missing", "*HEADING", "*INCLUDE, INPUT=a.inc\n*HEADING",
     ":1: *INCLUDE: found no file a.inc; expected a file that can be read"},
    {"node_number", "4,0,1,0\n5", "x,0,1,0\n5", ":7: *NODE: found 'x'; expected the number of a node, an integer"},
    {"node_zero", "4,0,1,0\n5", "0,0,1,0\n5", ":7: *NODE: found 0; expected the number of a node from 1 to 2000000000"},
    {"node_twice", "4,0,1,0\n5", "3,0,1,0\n5",
     ":7: *NODE: found node 3 a second time; expected every node once. Renumber the nodes."},
    {"node_coordinate", "4,0,1,0\n5", "4,0,one,0\n5", ":7: *NODE: found 'one'; expected a coordinate, a finite number"},
    {"node_not_finite", "4,0,1,0\n5", "4,0,1e400,0\n5",
     ":7: *NODE: found '1e400'; expected a coordinate, a finite number"},
    {"element_no_type", "*ELEMENT, TYPE=C3D8, ELSET=LOWER", "*ELEMENT, ELSET=LOWER",
     ":20: *ELEMENT: found no TYPE; expected TYPE=NAME. Add it to the keyword."},
    {"element_type", "TYPE=C3D8, ELSET=LOWER", "TYPE=C3D9, ELSET=LOWER",
     ":20: *ELEMENT: found elements of type C3D9; expected a type that Carom reads (docs/decks.md). The nearest is "
     "C3D4."},
    {"element_twice", "\n2,11,12", "\n1,11,12",
     ":23: *ELEMENT: found element 1 a second time; expected every element once. Renumber the elements."},
    {"element_node", "1,1,2,3,4,5,6,7,8", "1,1,2,3,4,5,6,7,99",
     ":21: *ELEMENT: found node 99 in element 1; expected the number of a node in *NODE"},
    {"element_short", "1,1,2,3,4,5,6,7,8", "1,1,2,3,4,5,6,7",
     ":21: *ELEMENT: found 7 nodes of element 1; expected 8 of a C3D8"},
    {"element_long", "1,1,2,3,4,5,6,7,8", "1,1,2,3,4,5,6,7,8,11",
     ":21: *ELEMENT: found more than 8 nodes of element 1; expected 8 of a C3D8. Is the TYPE right?"},
    {"set_unknown", "NSET=BASE, GENERATE\n1, 4", "NSET=BASE\nNOWHERE",
     ":25: *NSET: found 'NOWHERE'; expected the number of a node or the name of a set before this one"},
    {"set_parameter", "GENERATE\n1, 4", "GENERATES\n1, 4",
     ": found something that Carom does not carry over; expected a deck that loses nothing of its physics. --accept "
     "\"NSET\" runs without:\n  x.inp:24: *NSET: the parameter GENERATES is not known. Did you mean GENERATE? What it changes would be lost."},
    {"set_range", "GENERATE\n1, 4", "GENERATE\n4, 1",
     ":25: *NSET: found 4, 1, 1; expected first, last and a positive increment"},
    {"set_no_name", "*NSET, NSET=BASE, GENERATE", "*NSET, GENERATE",
     ":24: *NSET: found no NSET; expected NSET=NAME. Add it to the keyword."},
    {"set_instance", "*NSET, NSET=BASE, GENERATE", "*NSET, NSET=BASE, INSTANCE=I, GENERATE",
     ":24: *NSET: found the unknown instance I; expected the NAME of an *INSTANCE"},
    {"surface_set", "LOWER, S2", "LOWR, S2",
     ":29: *SURFACE: found 'LOWR'; expected the number of an element or the name of an element set"},
    {"surface_face", "LOWER, S2", "LOWER, T2",
     ":29: *SURFACE: found 'T2'; expected S1 to S6, SPOS, SNEG or nothing. Faces are numbered as Abaqus does "
     "(docs/decks.md)."},
    {"surface_seven", "LOWER, S2", "LOWER, S7",
     ":29: *SURFACE: found 'S7'; expected S1 to S6, SPOS, SNEG or nothing. Faces are numbered as Abaqus does "
     "(docs/decks.md)."},
    {"nfill", "*NSET, NSET=BASE", "*NFILL\nA,B,4\n*NSET, NSET=BASE",
     ":24: *NFILL: found a keyword that Carom does not carry out; expected nodes and elements in full. Nodes made by "
     "the other program are missing. Write the deck with all its nodes and elements."},
    {"part_open", "*HEADING", "*PART, NAME=P\n*HEADING",
     ":1: *PART: found no end; expected *END PART after it. The file may have been cut off."},
    {"part_end", "*HEADING", "*END PART\n*HEADING",
     ":1: *END PART: found an end without a beginning; expected *PART before it"},
    {"instance_part", "*HEADING", "*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*HEADING",
     ":1: *INSTANCE: found the unknown part P; expected the NAME of a *PART before it"},
    {"elastic_lost", "*MATERIAL, NAME=STEEL\n", "",
     ":32: *ELASTIC: found *ELASTIC of no material; expected *MATERIAL before it\nx.inp:34: *DENSITY: found *DENSITY "
     "of no material; expected *MATERIAL before it\n2 errors"},
    {"elastic_twice", "*DENSITY", "*ELASTIC\n1., 0.\n*DENSITY",
     ":35: *ELASTIC: found *ELASTIC a second time; expected once in a material"},
    {"elastic_type", "*ELASTIC\n", "*ELASTIC, TYPE=ORTHOTROPIC\n",
     ":33: *ELASTIC: found TYPE=ORTHOTROPIC; expected TYPE=ISOTROPIC. Carom's laws are isotropic."},
    {"elastic_number", "210000., 0.3", "21e4Pa, 0.3",
     ":34: *ELASTIC: found '21e4Pa'; expected Young's modulus, Poisson's ratio, a finite number"},
    {"elastic_missing", "*ELASTIC\n210000., 0.3\n", "",
     ":32: *MATERIAL: found a material without *ELASTIC; expected *ELASTIC or *HYPERELASTIC, NEO HOOKE after "
     "*MATERIAL"},
    {"elastic_nu", "210000., 0.3", "210000., 0.5",
     ":33: materials.STEEL.nu: found 0.5; expected a number > -1 and < 0.5. Poisson's ratio of a material lies between 0 and 0.5. At 0.5 a body cannot change its volume at all, and its bulk modulus is infinite: take 0.499 with formulation = \"mean_dilatation\"."},
    {"density_missing", "*DENSITY\n7.8e-9\n", "",
     ":32: *MATERIAL: found a material without *DENSITY; expected *DENSITY after *MATERIAL. Bodies in motion have a "
     "mass."},
    {"plastic_first", "*DENSITY", "*PLASTIC\n300., 0.1\n400., 0.2\n*DENSITY",
     ":35: materials.STEEL.hardening_table: found a first plastic strain of 0.1; expected 0"},
    {"section_set", "ELSET=LOWER, MATERIAL", "ELSET=LOWEST, MATERIAL",
     ":37: *SOLID SECTION: found ELSET=LOWEST; expected the name of a set of cells"},
    {"section_material", "ELSET=LOWER, MATERIAL=STEEL", "ELSET=LOWER, MATERIAL=STEAL",
     ":37: *SOLID SECTION: found the unknown material STEAL; expected the NAME of a *MATERIAL (STEEL). Did you mean "
     "STEEL?"},
    {"boundary_set", "BASE, 1, 3", "BASIS, 1, 3",
     ":40: *BOUNDARY: found \"BASIS\"; expected the name of a node set or the number of a node. Names of an instance "
     "have the instance before them, as in PART-1-1.TOP."},
    {"boundary_dof", "BASE, 1, 3", "BASE, 7",
     ":40: *BOUNDARY: found degrees of freedom 7 to 7; expected 1 to 3, or 1 to 6 with those of turning"},
    {"boundary_range", "BASE, 1, 3", "BASE, 3, 1",
     ":40: *BOUNDARY: found degrees of freedom 3 to 1; expected 1 to 3, or 1 to 6 with those of turning"},
    {"boundary_name", "BASE, 1, 3", "BASE, FIXED",
     ":40: *BOUNDARY: found \"FIXED\"; expected a degree of freedom, ENCASTRE, PINNED, XSYMM, XASYMM or those of y and "
     "z. U1 to U3 are 1 to 3, UR1 to UR3 are 4 to 6."},
    {"boundary_potential", "BASE, 1, 3", "BASE, 9, 9, 300.",
     ":40: *BOUNDARY: found degrees of freedom 9 to 9; expected 1 to 3, or 1 to 6 with those of turning"},
    {"boundary_temperature", "BASE, 1, 3", "BASE, 11, 11, 300.",
     ": found something that Carom does not carry over; expected a deck that loses nothing of its physics. --accept "
     "\"BOUNDARY\" runs without:\n  x.inp:40: *BOUNDARY: an imposed temperature. It would be left out: nodes have no "
     "temperatures."},
    {"boundary_turn", "*CLOAD", "*BOUNDARY\nBASE, 4, 4, 0.1\n*CLOAD",
     ":56: *BOUNDARY: found a turn of degree of freedom 4; expected 1, 2 or 3. Nodes do not turn, but for "
     "those that a *RIGID BODY refers to."},
    {"boundary_value_before_steps", "BASE, 1, 3", "BASE, 1, 3, 0.1",
     ":40: *BOUNDARY: found a displacement of BASE that jumps at t = 0; expected one that grows, from 0 or from where the "
     "step before it ended. Nodes cannot jump: let it grow by an AMPLITUDE, or say TYPE=VELOCITY."},
    {"boundary_fifth_field", "BASE, 1, 3", "BASE, 1, 3, 0., 7",
     ":40: *BOUNDARY: found '7' behind the others; expected nodes, first and last degree of freedom, value"},
    {"contact_third_surface", "FOOT, FLOOR", "FOOT, FLOOR, TOP",
     ":49: *CONTACT PAIR: found 'TOP' behind the others; expected the slave and the master"},
    {"plastic_temperatures", "*DENSITY", "*PLASTIC\n90., 0., 300.\n60., 0., 20.\n*DENSITY",
     ":37: *PLASTIC: found the temperature 20 after 300; expected temperatures in increasing order"},
    {"initial_dof", "FALLING, 3, -1000.", "FALLING, 4, -1000.",
     ":42: *INITIAL CONDITIONS: found degree of freedom 4; expected 1, 2 or 3"},
    {"initial_type", "TYPE=VELOCITY", "TYPE=STRESS",
     ": found something that Carom does not carry over; expected a deck that loses nothing of its physics. --accept "
     "\"INITIAL CONDITIONS\" runs without:\n  x.inp:41: *INITIAL CONDITIONS: TYPE=STRESS. The run would begin "
     "without."},
    {"interaction", "*CONTACT PAIR, INTERACTION=I", "*CONTACT PAIR, INTERACTION=J",
     ":49: *CONTACT PAIR: found the unknown interaction J; expected the NAME of a *SURFACE INTERACTION"},
    {"contact_surface", "FOOT, FLOOR", "FEET, FLOOR",
     ":49: *CONTACT PAIR: found \"FEET\"; expected the NAME of a *SURFACE"},
    {"contact_nodes", "*SURFACE, NAME=FOOT\nUPPER, S1", "*SURFACE, NAME=FOOT, TYPE=NODE\n11",
     ":49: *CONTACT PAIR: found FOOT, a surface of nodes that make no face; expected nodes with all those of a face, "
     "or TYPE=ELEMENT. Carom's contact needs the faces of both sides."},
    {"surface_area", "*SURFACE, NAME=FOOT\nUPPER, S1", "*SURFACE, NAME=FOOT, TYPE=NODE\nFALLING, 2.",
     ":31: *SURFACE: found an area of 2; expected 1, or none. Areas of nodes are not taken."},
    {"contact_type", "*CONTACT PAIR, INTERACTION=I", "*CONTACT PAIR, INTERACTION=I, TYPE=MORTA",
     ":48: *CONTACT PAIR: found TYPE=MORTA; expected NODE TO SURFACE or SURFACE TO SURFACE"},
    {"tie_tolerance", "*STEP\n", "*TIE, NAME=T, POSITION TOLERANCE=-1.\nFOOT, FLOOR\n*STEP\n",
     ":52: *TIE: found POSITION TOLERANCE=-1.; expected a distance of 0 or more"},
    {"tie_surface", "*STEP\n", "*TIE, NAME=T\nFOOT, GROUND\n*STEP\n",
     ":53: *TIE: found \"GROUND\"; expected the NAME of a *SURFACE"},
    {"tie_third_surface", "*STEP\n", "*TIE, NAME=T\nFOOT, FLOOR, TOP\n*STEP\n",
     ":53: *TIE: found 'TOP' behind the others; expected the slave and the master"},
    {"contact_adjust", "*CONTACT PAIR, INTERACTION=I", "*CONTACT PAIR, INTERACTION=I, ADJUST=0.2",
     ": found something that Carom does not carry over; expected a deck that loses nothing of its physics. --accept "
     "\"CONTACT PAIR\" runs without:\n  x.inp:48: *CONTACT PAIR: ADJUST=0.2. Gaps at the start would stay open."},
    {"rigid_set", "*STEP\n", "*RIGID BODY, ELSET=ROCK, REF NODE=1\n*STEP\n",
     ":52: *RIGID BODY: found ELSET=ROCK; expected the name of a set of cells"},
    {"rigid_plane", "*ELEMENT, TYPE=C3D8, ELSET=UPPER",
     "*ELEMENT, TYPE=CPE4, ELSET=FLAT\n9,1,2,3,4\n*RIGID BODY, ELSET=FLAT, REF NODE=1\n*ELEMENT, TYPE=C3D8, "
     "ELSET=UPPER",
     ":24: *RIGID BODY: found FLAT, elements of type CPE4; expected solids, R3D3, R3D4, or other faces. Plane and "
     "axisymmetric cells deform: R2D2 and RAX2 are their rigid bodies."},
    {"rigid_mixed", "*ELEMENT, TYPE=C3D8, ELSET=UPPER",
     "*ELEMENT, TYPE=R3D4, ELSET=UPPER\n9,1,2,3,4\n*RIGID BODY, ELSET=UPPER, REF NODE=1\n*ELEMENT, TYPE=C3D8, "
     "ELSET=UPPER",
     ":24: *RIGID BODY: found UPPER, elements of type R3D4; expected solids alone. Make a *RIGID BODY of each, or of "
     "the "
     "solids alone.\nx.inp:41: *SOLID SECTION: found elements of type R3D4 in UPPER; expected solids, plane cells or "
     "bars\n2 errors"},
    {"rigid_part_of_section", "*STEP\n",
     "*ELSET, ELSET=BOTH\n1, 2\n*SOLID SECTION, ELSET=BOTH, MATERIAL=STEEL\n*RIGID BODY, ELSET=LOWER, REF "
     "NODE=1\n*STEP\n",
     ":55: *RIGID BODY: found 1 of the 2 elements of the section of BOTH in LOWER; expected all elements of a section, "
     "or none. Elements 2 of it are not in LOWER: give the rigid elements a section of their own."},
    {"rigid_no_section", "*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL\n", "*RIGID BODY, ELSET=LOWER, REF NODE=1\n",
     ":37: *RIGID BODY: found elements 1 of LOWER without a section; expected a *SOLID SECTION of all elements of the "
     "body. Their material gives the body its mass."},
    {"rigid_nodes_of_faces", "*ELEMENT, TYPE=C3D8, ELSET=UPPER",
     "*ELEMENT, TYPE=R3D4, ELSET=LID\n9,1,2,3,4\n*RIGID BODY, ELSET=LID, REF NODE=1, TIE NSET=FALLING\n*ELEMENT, "
     "TYPE=C3D8, ELSET=UPPER",
     ":24: *RIGID BODY: found TIE NSET beside faces; expected faces or an analytical surface alone. Bodies of solids "
     "hold nodes of others: give the faces cells behind them."},
    {"rigid_two_sets_of_nodes", "*STEP\n",
     "*RIGID BODY, ELSET=UPPER, REF NODE=11, TIE NSET=BASE, PIN NSET=BASE\n*STEP\n",
     ":52: *RIGID BODY: found PIN NSET beside another set of nodes; expected one of them. Join both sets in one *NSET."},
    {"rigid_two_bodies", "*STEP\n",
     "*RIGID BODY, ELSET=UPPER, REF NODE=11\n*RIGID BODY, ELSET=LOWER, REF NODE=11\n*STEP\n",
     ":53: *RIGID BODY: found the reference node of UPPER for LOWER; expected a reference node for each body. Bodies "
     "of "
     "solids may hold the nodes of one *COUPLING."},
    {"coupling_surface", "*STEP\n", "*COUPLING, REF NODE=1, SURFACE=GROUND\n*KINEMATIC\n*STEP\n",
     ":52: *COUPLING: found SURFACE=GROUND; expected the NAME of a *SURFACE"},
    {"coupling_alone", "*STEP\n", "*COUPLING, REF NODE=1, SURFACE=FLOOR\n*STEP\n",
     ":52: *COUPLING: found *COUPLING alone; expected *KINEMATIC or *DISTRIBUTING behind it"},
    {"coupling_some", "*STEP\n", "*COUPLING, REF NODE=1, SURFACE=FLOOR\n*KINEMATIC\n1, 2\n*STEP\n",
     ":53: *KINEMATIC: found some degrees of freedom alone; expected 1 to 3, or all. Nodes that slide along the "
     "reference node's body are not joined: write *EQUATION."},
    {"coupling_distributing", "*STEP\n", "*COUPLING, REF NODE=1, SURFACE=FLOOR\n*DISTRIBUTING\n*STEP\n",
     ": found something that Carom does not carry over; expected a deck that loses nothing of its physics. --accept "
     "\"DISTRIBUTING\" runs without:\n  x.inp:53: *DISTRIBUTING: not carried out. The reference node of the *COUPLING "
     "would pull at nothing."},
    {"behavior_slope", "LINEAR\n1e6", "LINEAR\n0.", ":45: *SURFACE BEHAVIOR: found slope 0; expected a positive one"},
    {"behavior_kind", "OVERCLOSURE=LINEAR", "OVERCLOSURE=EXPONENTIAL",
     ": found something that Carom does not carry over; expected a deck that loses nothing of its physics. --accept "
     "\"SURFACE BEHAVIOR\" runs without:\n  x.inp:44: *SURFACE BEHAVIOR: PRESSURE-OVERCLOSURE=EXPONENTIAL. Contact "
     "would have the stiffness that Carom chooses from the material and the cells."},
    {"amplitude_unknown", "AMPLITUDE=A", "AMPLITUDE=B",
     ":55: *CLOAD: found the unknown amplitude B; expected the NAME of an *AMPLITUDE"},
    {"amplitude_order", "0., 0., 1e-3, 1.", "0., 0., 1e-3, 1., 5e-4, 1.",
     ":51: *AMPLITUDE: found time 0.0005 after 0.001; expected times in increasing order"},
    {"amplitude_pair", "0., 0., 1e-3, 1.", "0., 0., 1e-3",
     ":51: *AMPLITUDE: found a time without a value; expected pairs of time and value"},
    {"step_open", "*END STEP\n", "",
     ":52: *STEP: found *STEP without *END STEP; expected *END STEP at its end. Is the file complete?"},
    {"step_none", "*STEP\n*DYNAMIC, DIRECT\n1e-6, 1e-3\n*CLOAD, AMPLITUDE=A\n15, 1, 5.\n*END STEP\n", "",
     ": found no step with *STATIC or *DYNAMIC; expected at least one. `carom mesh` describes a deck without steps; "
     "other procedures are not computed."},
    {"step_two", "*DYNAMIC, DIRECT\n1e-6, 1e-3", "*DYNAMIC, DIRECT\n1e-6, 1e-3\n*STATIC",
     ":55: *STATIC: found *STATIC beside the *DYNAMIC of line 53; expected one procedure in a step"},
    {"step_increment", "1e-6, 1e-3", "",
     ":53: *DYNAMIC: found no increment of time; expected increment, time in its data line. An implicit step needs the "
     "size of its increments."},
    {"step_negative", "1e-6, 1e-3", "1e-6, -1.",
     ":54: *DYNAMIC: found increment 1e-06, time -1; expected positive times"},
    {"alpha", "*DYNAMIC, DIRECT", "*DYNAMIC, DIRECT, ALPHA=x",
     ":53: *DYNAMIC: found ALPHA=x; expected a number from -1/3 to 0"},
    {"alpha_range", "*DYNAMIC, DIRECT", "*DYNAMIC, DIRECT, ALPHA=-0.5",
     ":53: scheme.alpha: found -0.5 with scheme hht; expected a number >= -1/3 and <= 0. Below, HHT dissipates less "
     "again: choose -1/3, or scheme wbz."},
    {"frequency", "*DYNAMIC, DIRECT\n1e-6, 1e-3", "*FREQUENCY\n10",
     ": found something that Carom does not carry over, and 1 that is wrong; expected a deck that loses nothing of its "
     "physics. --accept \"FREQUENCY\" runs without:\n  x.inp:53: *FREQUENCY: not carried out. The step is left "
     "out.\nTo be changed whatever is accepted:\n  x.inp: found no step with *STATIC or *DYNAMIC; expected at least "
     "one. `carom mesh` describes a deck without steps; other procedures are not computed."},
    {"cload_dof", "15, 1, 5.", "15, 5, 5.",
     ":56: *CLOAD: found degree of freedom 5; expected 1, 2 or 3. Nodes of solids take no moments."},
    {"cload_node", "15, 1, 5.", "99, 1, 5.",
     ":56: *CLOAD: found \"99\"; expected the name of a node set or the number of a node. Names of an instance have "
     "the instance before them, as in PART-1-1.TOP."},
    {"unknown_keyword", "*BOUNDARY\nBASE", "*ELASTICS\n*BOUNDARY\nBASE",
     ": found something that Carom does not carry over; expected a deck that loses nothing of its physics. --accept "
     "\"ELASTICS\" runs without:\n  x.inp:39: *ELASTICS: an unknown keyword. Did you mean *ELASTIC? What it means would be lost."},
};

INSTANTIATE_TEST_SUITE_P(Decks, TranslateMalformed, testing::ValuesIn(spoiled_decks),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace carom::translate_malformed_test
