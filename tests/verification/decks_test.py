#!/usr/bin/env python3
"""The decks of tests/data/decks, run as they are and converted to a case: closed forms, and the same curves both ways.

    python3 decks_test.py build/release/carom
"""

import csv
import math
import pathlib
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
