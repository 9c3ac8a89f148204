"""`carom material` and `carom compare` from Python: what the command line leaves, as arrays and objects."""

import csv
import os
import pathlib
import signal
import subprocess
import threading
import time
import unittest

import numpy as np

import carom
from python_fixture import PROGRAM, FolderTest, falling_block

CASES = pathlib.Path(os.environ["CAROM_SOURCE"]) / "cases"
BAR = CASES / "impact_bar/newmark.toml"
E, NU, YIELD, HARDENING = 2.0e11, 0.3, 4.0e8, 2.0e9


def specimen(**part):
    """A case with a law that yields."""
    case = falling_block()
    case["materials"]["steel"] = {"law": "j2_small_strain", "E": E, "nu": NU, "rho": 7800.0, "yield_stress": YIELD,
                                  "hardening_modulus": HARDENING}
    case["part"][0].update(part)
    return case


class MaterialTest(FolderTest):
    def test_uniaxial_stress_is_the_bilinear_curve(self):
        # Textbook: E up to the yield stress, then the tangent E H / (E + H).
        curve = carom.material(specimen(), "uniaxial_stress", to=0.01, steps=50)
        elastic, tangent = E * curve["strain"], E * HARDENING / (E + HARDENING)
        expected = np.where(elastic < YIELD, elastic, YIELD + tangent * (curve["strain"] - YIELD / E))
        self.assertEqual(len(expected), 51)
        np.testing.assert_allclose(curve["stress_xx"], expected, rtol=0, atol=1e-6 * YIELD)
        self.assertEqual((curve.part, curve.unit("stress_xx"), curve.unit("energy")), ("block", "Pa", "Pa"))
        self.assertIsNone(curve.off_measured)

    def test_table_and_page_are_those_of_the_command(self):
        pathlib.Path("case.toml").write_text(specimen().resolved())
        arguments = ["--path", "simple_shear", "--to", "0.02,-0.01", "--steps", "7", "--rate", "3"]
        subprocess.run([PROGRAM, "material", "case.toml", *arguments, "--out", "cli"], check=True, capture_output=True)
        curve = carom.material("case.toml", "simple_shear", to=[0.02, -0.01], steps=7, rate=3.0, folder="python")
        for name in ("block.csv", "block.html"):
            self.assertEqual(pathlib.Path("cli", name).read_text(), pathlib.Path("python", name).read_text(), name)
        rows = [line for line in pathlib.Path("cli/block.csv").read_text().splitlines() if line[0] != "#"]
        self.assertEqual(rows[0].split(","), list(curve))
        np.testing.assert_array_equal(np.array([row.split(",") for row in rows[1:]], dtype=float).T,
                                      [curve[name] for name in curve])

    def test_path_of_arrays_is_that_of_the_file(self):
        table = {"time": [0.5, 1.0], "F_xx": [1.01, 1.01], "F_xy": [0.0, 0.02]}
        rows = zip(*table.values())
        pathlib.Path("path.csv").write_text("\n".join([",".join(table)] + [",".join(map(str, r)) for r in rows]) + "\n")
        one, other = carom.material(specimen(), table), carom.material(specimen(), "path.csv")
        self.assertGreater(abs(one["stress_xy"][-1]), 1e6)
        for name in one:
            np.testing.assert_array_equal(one[name], other[name])

    def test_measured_arrays_and_file(self):
        strain = np.linspace(0.0, 0.001, 11)  # elastic
        curve = carom.material(specimen(), "uniaxial_stress", measured=(strain, E * strain + 1e6))
        self.assertAlmostEqual(curve.off_measured, 1e6, delta=1.0)
        pathlib.Path("measured.csv").write_text("".join(f"{e},{E * e + 1e6}\n" for e in strain))
        self.assertAlmostEqual(carom.material(specimen(), "uniaxial_stress", measured="measured.csv").off_measured, 1e6,
                               delta=1.0)

    def test_errors(self):
        with self.assertRaises(carom.CaseError) as caught:
            carom.material(specimen(), "tension")
        self.assertEqual(caught.exception.key, "path")
        self.assertIn("uniaxial_strain", str(caught.exception))
        with self.assertRaisesRegex(carom.CaseError, "part: found \"rod\".*block"):
            carom.material(specimen(), "uniaxial_stress", part="rod")
        with self.assertRaisesRegex(carom.CaseError, "to: found .*-2.*> -1"):
            carom.material(specimen(), "uniaxial_stress", to=-2.0)
        with self.assertRaisesRegex(carom.CaseError, "G_xx.*F_xx"):
            carom.material(specimen(), {"time": [1.0], "G_xx": [1.0]})
        with self.assertRaisesRegex(ValueError, "time 2, F_xx 1"):
            carom.material(specimen(), {"time": [1.0, 2.0], "F_xx": [1.0]})
        for wrong in ({"steps": 0}, {"rate": 0.0}, {"measured": ([0.1], [1.0, 2.0])}):
            with self.assertRaises(ValueError):
                carom.material(specimen(), "uniaxial_stress", **wrong)


def without_times(path):
    """The rows of compare.csv, but for the processor times."""
    with open(path, newline="") as file:
        return [{key: value for key, value in row.items() if key != "cpu_seconds"} for row in csv.DictReader(file)]


class CompareTest(FolderTest):
    def test_is_the_command(self):
        choices = {"scheme": ["newmark", "central_differences", "leapfrog"], "stiffness": 900, "cells": [10, 20],
                   "courant": 0.4}
        options = ["--scheme", ",".join(choices["scheme"]), "--stiffness", "900", "--cells", "10,20", "--courant", "0.4"]
        subprocess.run([PROGRAM, "compare", BAR, *options, "--out", "cli", "--quiet"], check=True)
        seen = []
        found = carom.compare(BAR, **choices, folder="python", progress=lambda *report: seen.append(report))
        self.assertEqual(without_times("cli/compare.csv"), without_times("python/compare.csv"))
        self.assertEqual([report[:2] for report in seen], [(1, 4), (2, 4), (3, 4), (4, 4)])
        rows = without_times("python/compare.csv")
        self.assertEqual([v.name for v in found.variants], [row["name"] for row in rows])
        for variant, row in zip(found.variants, rows):
            self.assertEqual((variant.scheme, variant.status), (row["scheme"], row["status"]))
            if variant.result is None:
                self.assertIn("not allowed", variant.status)
                self.assertTrue(np.isnan(variant.penetration))
                continue
            self.assertEqual(variant.errors["force"], (float(row["l2_force"]), float(row["l1_force"])))
            self.assertEqual(variant.steps, int(row["steps"]))
            # From its definition in docs/compare.md, of what the run has left.
            exact, force = variant.result.exact, variant.result.contact
            r, u = exact["wall.force_z"], np.interp(exact["time"], force["time"], force["wall.force_z"])
            l2 = np.sqrt(np.trapz((u - r)**2, exact["time"]) / np.trapz(r**2, exact["time"]))
            self.assertAlmostEqual(variant.errors["force"][0], l2, delta=1e-9)
        self.assertIsNone(found.reference)
        self.assertIn(found.recommended, found.variants)
        self.assertEqual(found.quantity, "force")
        self.assertIn(found.recommended.label, found._repr_html_())
        self.assertIn("\\begin{tabular}", found.to_latex())
        made = [v.label for v in found.variants if v.result is not None]
        self.assertEqual(sum(line.startswith("|") for line in found.to_markdown().splitlines()), 2 + len(made))
        for label in made:
            self.assertIn(label, found.to_csv())

    def test_a_tree_with_a_mesh_of_arrays_leaves_nothing(self):
        case = falling_block()
        points = np.array([[x, y, z + 5e-5] for z in (0.0, 0.1) for y in (0.0, 0.1) for x in (0.0, 0.1)])
        case.mesh = carom.Mesh(points, {"hexa8": [[0, 1, 3, 2, 4, 5, 7, 6]]},
                               node_groups={"FOOT": [0, 1, 2, 3], "TOP": [4, 5, 6, 7]}, cell_groups={"BLOCK": [0]})
        found = carom.compare(case, scheme="central_differences", refine=[0, 1])
        self.assertEqual([v.status for v in found.variants], ["passed", "passed"])
        self.assertEqual([v.result.summary["mesh"]["cells"] for v in found.variants], [1, 8])
        self.assertEqual((found.folder, found.variants[0].result.folder), ("", ""))
        self.assertEqual(list(self.folder.iterdir()), [])
        try:
            frame = found.to_pandas()
        except ImportError:
            self.skipTest("pandas is not installed (apt install python3-pandas)")
        self.assertEqual(list(frame["status"]), ["passed", "passed"])

    def test_refusals_come_before_any_run(self):
        case = falling_block()
        case.function("push", lambda t: 1.0)
        with self.assertRaisesRegex(ValueError, "push"):
            carom.compare(case, scheme="newmark")
        with self.assertRaisesRegex(carom.CaseError, "none of which is allowed"):
            carom.compare(BAR, scheme="leapfrog", folder="out")
        for wrong in ({"cells": 0}, {"courant": -1.0}, {"refine": 7}):
            with self.assertRaises(ValueError):
                carom.compare(BAR, **wrong)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_interrupt_ends_the_runs(self):
        case = falling_block(end=10.0)  # days
        threading.Timer(2.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            carom.compare(case, scheme="central_differences", folder="out")
        self.assertLess(time.monotonic() - begin, 60.0)


if __name__ == "__main__":
    unittest.main()
