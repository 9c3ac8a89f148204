#!/usr/bin/env python3
"""The decks of tests/data/decks, run as they are and converted to a case: closed forms, and the same curves both ways.

    python3 decks_test.py build/release/carom
"""

import csv
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

DECKS = pathlib.Path(__file__).resolve().parents[1] / "data/decks"

ROLLERS = """units = "SI"
[mesh]
file = "DECK"
[materials.rubber]
law = "st_venant_kirchhoff"
E = 10.0e6
nu = 0.4
rho = 1100.0
[[part]]
name = "strip"
cells = "STRIP-1.ALL"
material = "rubber"
section = "plane_strain"
thickness = 0.1
linear_bulk_viscosity = 0.06
quadratic_bulk_viscosity = 1.2
[functions.press]
time = [0.0, 2.0e-3, 2.0e-3]
value = [1.0, 1.0, 0.0]
[functions.one]
time = [0.0, 1.0]
value = [1.0, 1.0]
[[contact]]
name = "above"
kind = "surface"
group = "STRIP-1.UPPER"
surface = "ABOVE.SKIN"
velocity = [0.0, -0.05, 0.0]
function = "press"
angular_velocity = [0.0, 0.0, 10.0]
angular_function = "one"
centre_of_rotation = [0.0, 0.06, 0.0]
friction = 0.5
[[contact]]
name = "below"
kind = "surface"
group = "STRIP-1.LOWER"
surface = "BELOW.SKIN"
velocity = [0.0, 0.05, 0.0]
function = "press"
angular_velocity = [0.0, 0.0, -10.0]
angular_function = "one"
centre_of_rotation = [0.0, -0.06, 0.0]
friction = 0.5
[scheme]
kind = "central_differences"
[time]
end = 0.04
[output]
fields = []
"""

# Two cubes, the upper one falling on the lower one. Classes of decks, below, change it.
CUBES = """*NODE, NSET=NALL
1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1
11, 0, 0, 1.1\n12, 1, 0, 1.1\n13, 1, 1, 1.1\n14, 0, 1, 1.1\n15, 0, 0, 2.1\n16, 1, 0, 2.1\n17, 1, 1, 2.1\n18, 0, 1, 2.1
*ELEMENT, TYPE=C3D8R, ELSET=LOWER
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8R, ELSET=UPPER
2, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=BASE, GENERATE
1, 4
*NSET, NSET=FALLING, GENERATE
11, 18
*SURFACE, NAME=FLOOR
LOWER, S2
*SURFACE, NAME=FOOT
UPPER, S1
*MATERIAL, NAME=STEEL
*DENSITY
7.8e-9
*ELASTIC
210000., 0.3
*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL
*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL
*BOUNDARY
BASE, ENCASTRE
*INITIAL CONDITIONS, TYPE=VELOCITY
FALLING, 3, -1000.
*SURFACE INTERACTION, NAME=I
*FRICTION
0.2
*STEP, NLGEOM=YES
*DYNAMIC, EXPLICIT
, 2e-5
*CONTACT PAIR, INTERACTION=I
FOOT, FLOOR
*END STEP
"""
PAIR = "*CONTACT PAIR, INTERACTION=I\nFOOT, FLOOR\n"
GENERAL = "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT PROPERTY ASSIGNMENT\n, , I\n"
JOHNSON_COOK = """*ELASTIC
210000., 0.3
*PLASTIC, HARDENING=JOHNSON COOK
90., 80., 0.3, 1., 1500., 300.
*RATE DEPENDENT, TYPE=JOHNSON COOK
0.01, 1.
*SPECIFIC HEAT
4.5e8
"""
ELASTIC = "*ELASTIC\n210000., 0.3\n"
HOT = ("*STEP", "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 350.\n*STEP")
OUTPUT = """*INCREMENTATION OUTPUT
DT
*OUTPUT, FIELD
*ELEMENT OUTPUT
S, PEEQ
*ENERGY OUTPUT
ALLKE
*MONITOR, NODE=15, DOF=3
"""
PLATE = """*NODE
100, -1, -1, -0.1\n101, 3, -1, -0.1\n102, 3, 3, -0.1\n103, -1, 3, -0.1\n104, 0, 0, -0.2
*ELEMENT, TYPE=R3D4, ELSET=PLATE
100, 100, 101, 102, 103
*RIGID BODY, ELSET=PLATE, REF NODE=104
*BOUNDARY
104, ENCASTRE
*STEP"""
ROLL = """*NODE
104, 0, 0, -0.2
*SURFACE, NAME=UNDER
LOWER, S1
*SURFACE, NAME=ROLL, TYPE=CYLINDER
0., 0., -0.1, 1., 0., -0.1
0., 1., -0.1
START, -3., 0.
LINE, 3., 0.
*RIGID BODY, ANALYTICAL SURFACE=ROLL, REF NODE=104
*BOUNDARY
104, ENCASTRE
*STEP"""
RIGID = """*NODE\n99, 0.5, 0.5, 4.\n*RIGID BODY, ELSET=UPPER, REF NODE=99\n*STEP"""
BELOW = """*NODE\n99, 0.5, 0.5, 4.\n*RIGID BODY, ELSET=LOWER, REF NODE=99\n*STEP"""
HOLDS = """*NODE
99, 0.5, 0.5, 4.
*NSET, NSET=TIED
11, 12, 13, 14
*RIGID BODY, ELSET=LOWER, REF NODE=99, TIE NSET=TIED
*STEP"""
COUPLED = """*NODE
99, 0.5, 0.5, 4.
*SURFACE, NAME=TOP
UPPER, S2
*COUPLING, CONSTRAINT NAME=C, REF NODE=99, SURFACE=TOP
*KINEMATIC
*ELEMENT, TYPE=MASS, ELSET=M
50, 99
*MASS, ELSET=M
1e-8
*ELEMENT, TYPE=ROTARYI, ELSET=J
51, 99
*ROTARY INERTIA, ELSET=J
1e-8, 1e-8, 1e-8
*INITIAL CONDITIONS, TYPE=VELOCITY
99, 3, -1000.
*STEP"""
FALLS = ("*BOUNDARY\nBASE, ENCASTRE\n*INITIAL CONDITIONS, TYPE=VELOCITY\nFALLING",
         "*INITIAL CONDITIONS, TYPE=VELOCITY\nNALL")


class DeckClass:
    """One kind of public decks: the changes of CUBES; what is refused, one after the other, by beginnings of
    findings; those that stay when all that can be is accepted. Without findings it runs."""

    def __init__(self, name, *edits, refused=(), stays=()):
        self.name, self.edits, self.refused, self.stays = name, edits, refused, stays

    def text(self):
        text = CUBES
        for old, new in self.edits:
            assert old in text, (self.name, old)
            text = text.replace(old, new, 1)
        return text


CLASSES = (
    DeckClass("requests of output and messages", ("*END STEP", OUTPUT + "*END STEP")),
    DeckClass("adiabatic, Johnson and Cook", ("EXPLICIT", "EXPLICIT, ADIABATIC"), (ELASTIC, JOHNSON_COOK), HOT),
    DeckClass("adiabatic by coupled elements", ("*DYNAMIC, EXP", "*DYNAMIC TEMPERATURE-DISPLACEMENT, EXP"),
              ("C3D8R, ELSET=L", "C3D8RT, ELSET=L"), ("C3D8R, ELSET=U", "C3D8RT, ELSET=U"), HOT,
              (ELASTIC, JOHNSON_COOK + "*CONDUCTIVITY\n45.\n*EXPANSION\n1.2e-5\n"),
              refused=("*DYNAMIC TEMPERATURE-DISPLACEMENT: a step that computes temperatures. It would be adiabatic",
                       "*CONDUCTIVITY: not carried out. Heat would not flow.",
                       "*EXPANSION: not carried out. There would be no thermal strains.")),
    DeckClass("fixed mass scaling", (PAIR, "*FIXED MASS SCALING, DT=1e-7, TYPE=BELOW MIN\n" + PAIR)),
    DeckClass("mass scaling of a set", (PAIR, "*FIXED MASS SCALING, DT=1e-7, ELSET=UPPER\n" + PAIR),
              refused=("*FIXED MASS SCALING: masses of UPPER alone.",)),
    DeckClass("mass scaling by a factor", (PAIR, "*FIXED MASS SCALING, FACTOR=4.\n" + PAIR),
              refused=("*FIXED MASS SCALING: FACTOR=4 of masses. Masses would stay as they are",)),
    DeckClass("implicit, moderate dissipation",
              ("*DYNAMIC, EXPLICIT\n,", "*DYNAMIC, APPLICATION=MODERATE DISSIPATION\n1e-6,")),
    DeckClass("implicit, quasi-static", ("*DYNAMIC, EXPLICIT\n,", "*DYNAMIC, APPLICATION=QUASI-STATIC\n1e-6,"),
              refused=("*DYNAMIC: the backward Euler method, which takes most of the motion away.",)),
    DeckClass("variable mass scaling", (PAIR, "*VARIABLE MASS SCALING, DT=1e-7, TYPE=BELOW MIN, FREQUENCY=10\n" + PAIR),
              refused=("*VARIABLE MASS SCALING: masses that change during the step. Mass would be added at its start",)),
    DeckClass("massless contact", ("ION=I\nFOOT", "ION=I, TYPE=MASSLESS\nFOOT"),
              refused=("*CONTACT PAIR: TYPE=MASSLESS. Nodes in contact would keep their mass",)),
    DeckClass("hardening by rates", (ELASTIC, ELASTIC + "*PLASTIC\n90., 0.\n120., 0.1\n*PLASTIC, RATE=1e3\n130., 0.\n")),
    DeckClass("Cowper and Symonds", (ELASTIC, ELASTIC + "*PLASTIC\n90., 0.\n120., 0.1\n*RATE DEPENDENT\n40., 5.\n")),
    DeckClass("hardening by temperatures",
              (ELASTIC, ELASTIC + "*PLASTIC\n90., 0., 20.\n99., 0.1, 20.\n60., 0., 600.\n80., 0.1, 600.\n")),
    DeckClass("hardening by temperatures that change", ("EXPLICIT", "EXPLICIT, ADIABATIC"),
              (ELASTIC, ELASTIC + "*PLASTIC\n90., 0., 20.\n99., 0.1, 20.\n60., 0., 600.\n80., 0.1, 600.\n"),
              refused=("*PLASTIC: values that depend on the temperature, which changes.",)),
    DeckClass("kinematic hardening", (ELASTIC, ELASTIC + "*PLASTIC, HARDENING=KINEMATIC\n90., 0.\n120., 0.1\n"),
              refused=("*PLASTIC: HARDENING=KINEMATIC. Hardening would be isotropic.",)),
    DeckClass("damage", (ELASTIC, ELASTIC + "*PLASTIC\n90., 0.\n*DAMAGE INITIATION, CRITERION=DUCTILE\n0.3, 0.33, 0.\n"
                         "*DAMAGE EVOLUTION, TYPE=DISPLACEMENT\n0.1\n"),
              refused=("*DAMAGE INITIATION: CRITERION=DUCTILE. Nothing would break.",)),
    DeckClass("viscoelasticity", (ELASTIC, ELASTIC + "*VISCOELASTIC, TIME=PRONY\n0.2, 0., 0.1\n"),
              refused=("*VISCOELASTIC: an unknown keyword.",)),
    DeckClass("rubber, neo-Hooke", (ELASTIC, "*HYPERELASTIC, NEO HOOKE\n1., 0.01\n"), ("-1000.", "-100."),
              refused=("*HYPERELASTIC: another potential than that of Carom's neo_hookean",)),
    DeckClass("rubber, Mooney and Rivlin", (ELASTIC, "*HYPERELASTIC, MOONEY-RIVLIN\n1., 0.2, 0.01\n"),
              refused=("*HYPERELASTIC: the parameter MOONEY-RIVLIN is not known.", "*HYPERELASTIC: another potential"),
              stays=("*HYPERELASTIC: found another potential; expected NEO HOOKE",)),
    DeckClass("foam", (ELASTIC, "*HYPERFOAM, N=1\n1., 2., 0.\n"), refused=("*HYPERFOAM: an unknown keyword.",),
              stays=("*MATERIAL: found a material without *ELASTIC",)),
    DeckClass("equation of state", (ELASTIC, "*EOS, TYPE=USUP\n4.5e6, 1.5, 2.\n"),
              refused=("*EOS: an unknown keyword.",), stays=("*MATERIAL: found a material without *ELASTIC",)),
    DeckClass("orthotropy", (ELASTIC, "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1., 1., 1., .3, .3, .3, 1., 1.\n1.\n"),
              stays=("*ELASTIC: found TYPE=ENGINEERING CONSTANTS; expected TYPE=ISOTROPIC.",)),
    DeckClass("general contact", (PAIR, GENERAL)),
    DeckClass("general contact, rigid plate", (PAIR, GENERAL), ("*STEP", PLATE), FALLS),
    DeckClass("general contact beside ties", FALLS, (PAIR, GENERAL),
              ("*STEP", "*TIE, NAME=T, ADJUST=YES\nFOOT, FLOOR\n*STEP"),
              *((f"{x}, 1.1\n", f"{x}, 1.0\n") for x in ("0, 0", "1, 0", "1, 1", "0, 1"))),
    DeckClass("general contact, exclusions", (PAIR, GENERAL + "*CONTACT EXCLUSIONS\nFOOT, FLOOR\n"),
              refused=("*CONTACT EXCLUSIONS: FOOT with FLOOR. They would touch.",)),
    DeckClass("general contact of chosen surfaces", (PAIR, "*CONTACT\n*CONTACT INCLUSIONS\nFOOT, FLOOR\n")),
    DeckClass("general contact of a surface with all", (PAIR, "*CONTACT\n*CONTACT INCLUSIONS\n, FLOOR\n"),
              stays=("*CONTACT INCLUSIONS: found contact of all with chosen surfaces;",)),
    DeckClass("rigid solids", ("*STEP", RIGID), ("FALLING, 3", "99, 3")),
    DeckClass("rigid solids below", ("*STEP", BELOW), ("BASE, ENCASTRE", "99, ENCASTRE")),
    DeckClass("general contact, rigid solids", ("*STEP", RIGID), (PAIR, GENERAL), ("FALLING, 3", "99, 3")),
    DeckClass("a mass that is coupled", ("*STEP", COUPLED)),
    DeckClass("a coupling that distributes", ("*STEP", COUPLED.replace("KINEMATIC", "DISTRIBUTING")),
              refused=("*DISTRIBUTING: not carried out.", "*ROTARY INERTIA: an inertia of nodes that no")),
    DeckClass("analytical rigid surface", ("*STEP", ROLL), (PAIR, PAIR + "UNDER, ROLL\n"), FALLS),
    DeckClass("shells", ("*STEP", "*ELEMENT, TYPE=S4R, ELSET=SHEET\n3, 15, 16, 17, 18\n"
                         "*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL\n0.01\n*STEP"),
              refused=("*SHELL SECTION: not carried out. Carom has no shells.",)),
    DeckClass("beams", ("*STEP", "*ELEMENT, TYPE=B31, ELSET=ROD\n3, 15, 16\n"
                        "*BEAM SECTION, ELSET=ROD, MATERIAL=STEEL, SECTION=CIRC\n0.01\n1., 0., 0.\n*STEP"),
              refused=("*BEAM SECTION: not carried out. Carom has no beams.",)),
    DeckClass("cohesive elements", ("*STEP", "*ELEMENT, TYPE=COH3D8, ELSET=GLUE\n3, 5, 6, 7, 8, 11, 12, 13, 14\n"
                                    "*COHESIVE SECTION, ELSET=GLUE, MATERIAL=STEEL\n*STEP"),
              refused=("*COHESIVE SECTION: an unknown keyword.",), stays=("*ELEMENT: found elements of type COH3D8;",)),
    DeckClass("Eulerian elements", ("C3D8R, ELSET=U", "EC3D8R, ELSET=U"),
              stays=("*ELEMENT: found elements of type EC3D8R;",)),
    DeckClass("connectors", ("*STEP", "*ELEMENT, TYPE=CONN3D2, ELSET=JOINT\n3, 5, 11\n"
                             "*CONNECTOR SECTION, ELSET=JOINT\nHINGE\n*STEP"),
              refused=("*CONNECTOR SECTION: not carried out. The connector would be left out.",)),
    DeckClass("dampers", ("*STEP", "*ELEMENT, TYPE=DASHPOTA, ELSET=D\n3, 5, 11\n*DASHPOT, ELSET=D\n\n1e-6\n*STEP"),
              refused=("*DASHPOT: not carried out. The damper would be left out.",)),
    DeckClass("hybrid elements", ("C3D8R, ELSET=U", "C3D8RH, ELSET=U")),
    DeckClass("coupling with a load", ("*STEP", "*NODE\n99, 0.5, 0.5, 3.\n*COUPLING, CONSTRAINT NAME=C, REF NODE=99, "
                                       "SURFACE=FOOT\n*KINEMATIC\n*STEP"), (PAIR, PAIR + "*CLOAD\n99, 3, -5.\n"),
              refused=("*COUPLING: the reference node of FOOT moves freely and has no *MASS and *ROTARY INERTIA.",),
              stays=("load.group: found node 99",)),
    DeckClass("forces on reference nodes", ("*STEP", RIGID), ("FALLING, 3", "99, 3"), (PAIR, PAIR + "*CLOAD\n99, 3, -5.\n")),
    DeckClass("forces on a mass that is coupled", ("*STEP", COUPLED), (PAIR, PAIR + "*CLOAD\n99, 3, -5.\n")),
    DeckClass("rigid solids that hold nodes", ("*STEP", HOLDS), ("BASE, ENCASTRE", "99, 1, 6"), (PAIR, "")),
    DeckClass("damping", (ELASTIC, ELASTIC + "*DAMPING, ALPHA=1.\n"),
              refused=("*DAMPING: not carried out. The bodies would not be damped.",)),
    DeckClass("frequencies", ("*DYNAMIC, EXPLICIT\n, 2e-5", "*FREQUENCY\n10"),
              refused=("*FREQUENCY: not carried out. The step is left out.",), stays=("found no step with *STATIC or",)),
    DeckClass("nodes that are generated", ("*NSET, NSET=BASE", "*NFILL\nA, B, 2\n*NSET, NSET=BASE"),
              stays=("*NFILL: found a keyword that Carom does not carry out;",)),
    DeckClass("labels of supports that Abaqus does not have", ("BASE, ENCASTRE", "BASE, U1"),
              stays=('*BOUNDARY: found "U1"; expected a degree of freedom, ENCASTRE, PINNED,',)),
)


def curves(folder, name="probes"):
    """{column: [values]} of a table of results; "time" among them."""
    with open(folder / f"{name}.csv", encoding="utf-8", newline="") as file:
        rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


class Decks(unittest.TestCase):
    carom = ""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.out = pathlib.Path(cls.folder.name)
        cls.known = {}

    def call(self, *words):
        done = subprocess.run([self.carom, *map(str, words)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        return done.stdout + done.stderr

    def run_deck(self, name):
        """Curves of the deck as it is; the case that `convert` makes of it must give the same."""
        if name in self.known:
            return self.known[name]
        self.call("run", DECKS / f"{name}.inp", "--out", self.out / name, "--quiet")
        self.call("convert", DECKS / f"{name}.inp", "-o", self.out / f"{name}.toml")
        self.call("run", self.out / f"{name}.toml", "--out", self.out / f"{name}_case", "--quiet")
        own, case = curves(self.out / name), curves(self.out / f"{name}_case")
        self.assertEqual(own.keys(), case.keys())
        def vector(column):
            return column[:-2] if column[-2:] in ("_x", "_y", "_z") else column
        sizes = {}
        for column, values in own.items():
            sizes[vector(column)] = max(sizes.get(vector(column), 0.0), *map(abs, values))
        for column, values in own.items():
            size = sizes[vector(column)]
            # The order of the cells, and so of sums, may differ: round-off.
            for a, b in zip(values, case[column], strict=True):
                self.assertLessEqual(abs(a - b), 1e-9 * size + 1e-15, column)
        self.known[name] = own
        return own

    def column(self, name, *parts):
        """The one column whose name has these parts."""
        found = [values for column, values in self.run_deck(name).items() if all(p in column for p in parts)]
        self.assertEqual(len(found), 1, (parts, list(self.run_deck(name))))
        return found[0]

    def test_equal_bars_exchange_their_velocities(self):
        # One-dimensional waves (nu = 0): contact ends after 2 L / c; then the lower bar moves at -10, the upper one
        # rests. Means over the nodes; what rings in the bars and the bulk viscosity take a per cent of the energy.
        lower, upper = (self.column("two_bars", f"{bar}-1.ALL", "velocity_z")[-1] for bar in ("LOWER", "UPPER"))
        self.assertAlmostEqual(lower, -10.0, delta=0.2)
        self.assertAlmostEqual(upper, 0.0, delta=0.2)
        # Momentum: both have the same mass, and the means here are those of the nodes.
        self.assertAlmostEqual(lower + upper, -10.0, delta=0.2)

    def test_free_fall(self):
        # u = v t - g t^2 / 2: exact in every scheme of second order.
        time = self.run_deck("free_fall")["time"]
        x, z = (self.column("free_fall", "TIP", f"displacement_{axis}") for axis in "xz")
        for t, ux, uz in zip(time, x, z, strict=True):
            self.assertAlmostEqual(ux, 2.0 * t, delta=1e-9)
            self.assertAlmostEqual(uz, 1.0 * t - 0.5 * 9.81 * t * t, delta=1e-9)

    def test_pull_and_release(self):
        # F L / (E A) = 4 2.5 1 / (1e6 0.01); half way of the amplitude at 0.25, held from 0.5 to 1, let go along the
        # second step.
        time = self.run_deck("pull_and_release")["time"]
        expected = {0.25: 0.5e-3, 0.5: 1e-3, 1.0: 1e-3, 1.5: 0.5e-3, 2.0: 0.0}
        names = [name for name in self.run_deck("pull_and_release") if "displacement_z" in name]
        self.assertEqual(len(names), 4)
        for name in names:
            values = self.run_deck("pull_and_release")[name]
            for t, u in zip(time, values, strict=True):
                if round(t, 6) in expected:
                    self.assertAlmostEqual(u, expected[round(t, 6)], delta=1e-10)
        self.assertTrue(set(expected) <= {round(t, 6) for t in time})

    def test_oscillator(self):
        # Mass 4 of the cell and 8 times 0.5, four springs of 1000; u = v / w sin(w t). The block gives 1e-9 of its
        # length per unit of force, and the trapezoidal rule stretches the period by (w h)^2 / 12 = 4e-5.
        w = math.sqrt(4000.0 / 8.0)
        time = self.run_deck("oscillator")["time"]
        values = [v for name, v in self.run_deck("oscillator").items() if "displacement_z" in name][0]
        for t, u in zip(time, values, strict=True):
            self.assertAlmostEqual(u, math.sin(w * t) / w, delta=1e-3 / w)

    def test_imposed_velocity_over_two_steps(self):
        # v = 4 t / 0.02 and -2 t / 0.02: u = v t / 2 at the end of both steps, 0.02.
        one = [v for name, v in self.run_deck("driven").items() if "ONE.TOP" in name and "displacement_x" in name]
        two = [v for name, v in self.run_deck("driven").items() if "TWO.BOTTOM" in name and "displacement_z" in name]
        self.assertEqual((len(one), len(two)), (4, 4))
        for values in one:
            self.assertAlmostEqual(values[-1], 0.04, delta=1e-9)
        for values in two:
            self.assertAlmostEqual(values[-1], -0.02, delta=1e-9)

    def test_a_bar_leaves_a_moving_rigid_wall_at_twice_its_speed(self):
        # One-dimensional waves: the bar leaves after 2 L / c = 0.8 ms, gap included 0.9 ms, with 2 V.
        leaves = self.column("bar_on_moving_wall", "BAR-1.ALL", "velocity_z")[-1]
        self.assertAlmostEqual(leaves, 20.0, delta=0.3)

    def test_rollers_draw_a_strip_along(self):
        # Their surfaces go at 0.05 m x 10 rad/s, which the strip has after 8 ms of slip and on the mean from then on: it
        # rings by 0.07 m/s about it with the period 4 x 0.15 m / 104 m/s, whose share in 32 ms is 0.4 %.
        time = self.run_deck("rollers")["time"]
        way = [v for name, v in self.run_deck("rollers").items() if "FRONT" in name and "displacement_x" in name]
        self.assertEqual(len(way), 5)
        begin = next(i for i, t in enumerate(time) if t >= 0.008)
        speed = sum(v[-1] - v[begin] for v in way) / 5 / (time[-1] - time[begin])
        self.assertAlmostEqual(speed, 0.5, delta=0.01 * 0.5)
        # The same as a case that is written by hand: the same numbers, up to the round-off of rates.
        case = self.out / "by_hand.toml"
        case.write_text(ROLLERS.replace("DECK", str(DECKS / "rollers.inp")), encoding="utf-8")
        self.call("run", case, "--out", self.out / "by_hand", "--quiet")
        by_hand, deck = (curves(self.out / name, "contact") for name in ("by_hand", "rollers"))
        for ours, theirs in (("above", "STRIP-1.UPPER on ABOVE.SKIN"), ("below", "STRIP-1.LOWER on BELOW.SKIN")):
            for column in ("force_x", "force_y", "impulse_x", "moment_z", "displacement_y", "penetration"):
                a, b = by_hand[f"{ours}.{column}"], deck[f"{theirs}.{column}"]
                self.assertEqual(len(a), len(b))
                size = max(map(abs, b))
                self.assertGreater(size, 0.0)
                self.assertLess(max(abs(x - y) for x, y in zip(a, b, strict=True)), 1e-9 * size, column)

    def test_masses_on_long_bars(self):
        # Saint-Venant (1883): a bar answers the velocity v of its end with the force v, so that a mass of 5 slows down
        # as exp(-t / 5). The coupled one begins together with the end's half cell, 0.1, whose momentum is a fiftieth
        # more. The hammer has the contact's stiffness 5 between: F' = 5 (v - F), 5 v' = -F. The cells follow a jump of
        # the velocity within the time of a wave through one of them, and ring behind it by a hundredth: that is allowed
        # twice to velocities, and a thousandth of the way to displacements, which hold its mean.
        s, f = (-5.0 + math.sqrt(21.0)) / 2.0, (-5.0 - math.sqrt(21.0)) / 2.0
        hammer = ((-f / (s - f), s), (s / (s - f), f))
        for name, terms in (("STRIKER.CORNER", hammer), ("TOP", ((1.02, -0.2),))):
            v, u = (self.column("hammers", name, f"{what}_z") for what in ("velocity", "displacement"))
            time = self.run_deck("hammers")["time"]
            self.assertGreater(time[-1], 9.99)
            for t, speed, way in zip(time, v, u, strict=True):
                due = -1e-3 * sum(a * math.exp(r * t) for a, r in terms)
                gone = -1e-3 * sum(a / r * (math.exp(r * t) - 1.0) for a, r in terms)
                self.assertAlmostEqual(speed, due, delta=0.025e-3, msg=f"{name} at {t}")
                self.assertAlmostEqual(way, gone, delta=0.005e-3, msg=f"{name} at {t}")

    def test_a_guided_plate_on_a_long_bar(self):
        # The hammer as a rigid plate with a *MASS, held in 1, 2 and 4 to 6: the same closed form, though it is hit off its
        # centre. An obstacle has no corner that trembles; the bar rings as above.
        text = (DECKS / "hammers.inp").read_text(encoding="utf-8")
        for old, new in (
            ("*Element, type=C3D8, elset=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*Surface, type=ELEMENT, name=FACE\nALL, S1",
             "*Element, type=R3D4, elset=ALL\n1, 1, 4, 3, 2\n*Surface, type=ELEMENT, name=FACE\nALL, SPOS"),
            ("*Solid Section, elset=ALL, material=HAMMER\n,", "*Element, type=MASS, elset=M\n2, 99\n*Mass, elset=M\n5."),
            ("*Node Output, nset=STRIKER.CORNER\nU, V\n", ""),
        ):  # fmt: skip
            self.assertIn(old, text)
            text = text.replace(old, new)
        deck = self.out / "plate.inp"
        deck.write_text(text, encoding="utf-8")
        self.call("run", deck, "--out", self.out / "plate", "--quiet")
        seen = curves(self.out / "plate", "contact")
        name = next(column[: -len(".velocity_z")] for column in seen if column.endswith(".velocity_z"))
        s, f = (-5.0 + math.sqrt(21.0)) / 2.0, (-5.0 - math.sqrt(21.0)) / 2.0
        self.assertGreater(seen["time"][-1], 9.99)
        for t, v, u in zip(seen["time"], seen[f"{name}.velocity_z"], seen[f"{name}.displacement_z"], strict=True):
            speed = (s * math.exp(f * t) - f * math.exp(s * t)) / (s - f)
            way = (s / f * (math.exp(f * t) - 1.0) - f / s * (math.exp(s * t) - 1.0)) / (s - f)
            self.assertAlmostEqual(v, -1e-3 * speed, delta=0.025e-3, msg=f"at {t}")
            self.assertAlmostEqual(u, -1e-3 * way, delta=0.005e-3, msg=f"at {t}")
        for column in ("velocity_x", "displacement_y"):
            self.assertEqual(max(map(abs, seen[f"{name}.{column}"])), 0.0)

    def findings(self, *words):
        """What a call that is refused says, a finding a line, without the place."""
        done = subprocess.run([self.carom, *map(str, words)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        accept = re.search(r'--accept "([^"]*)" runs without', done.stderr)
        places = re.findall(r"^(?:error: |  )\S*\.inp(?::\d+)*: (.*)$", done.stderr, re.MULTILINE)
        return [line for line in places if "that Carom does not carry over" not in line], accept and accept[1]

    def test_classes_of_public_decks(self):
        # All that is wrong in one go, in words; what can be accepted runs then, or says the rest beforehand.
        for kind in CLASSES:
            with self.subTest(kind.name):
                deck = self.out / "class.inp"
                deck.write_text(kind.text(), encoding="utf-8")
                accepted = []
                if kind.refused or kind.stays:
                    found, accept = self.findings("run", deck, "--out", self.out / "class")
                    self.assertEqual(len(found), len(kind.refused + kind.stays), found)
                    for line, due in zip(found, kind.refused + kind.stays, strict=True):
                        self.assertTrue(line.startswith(due), (line, due))
                    self.assertEqual(accept is not None, bool(kind.refused))
                    accepted = ["--accept", accept] if accept else []
                if kind.stays:
                    again, accept = self.findings("run", deck, "--out", self.out / "class", *accepted)
                    self.assertEqual((len(again), accept), (len(kind.stays), None), again)
                else:
                    self.call("run", deck, "--out", self.out / "class", "--quiet", *accepted)

    def test_what_is_left_out_is_told_and_what_changes_the_physics_is_refused(self):
        notes = self.call("check", DECKS / "driven.inp")
        self.assertIn("small strains and rotations", notes)
        deck = self.out / "tied.inp"
        text = (DECKS / "free_fall.inp").read_text(encoding="utf-8")
        deck.write_text(text.replace("*STEP", "*DASHPOT, ELSET=B.ALL\n1.\n*STEP"), encoding="utf-8")
        done = subprocess.run([self.carom, "run", deck], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("*DASHPOT: not carried out. The damper would be left out.", done.stderr)
        self.call("run", deck, "--accept", "dashpot", "--out", self.out / "tied", "--quiet")


if __name__ == "__main__":
    Decks.carom = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
