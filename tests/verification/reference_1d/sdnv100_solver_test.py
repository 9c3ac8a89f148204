#!/usr/bin/env python3
"""Carom's runs of SDNV100 against the one-dimensional reference, against each other, and over the contact stiffness.

    python3 sdnv100_solver_test.py build/release/carom
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "tools"), str(pathlib.Path(__file__).resolve().parent)]

import sdnv100_reference as reference  # noqa: E402
import sdnv100_stiffness  # noqa: E402

CASES = ROOT / "cases" / "sdnv100"
PROBES = [f"{place}.{quantity}_z" for place in "AB" for quantity in ("displacement", "velocity")]
ENERGIES = ["ENER_CIN", "ENER_TOT", "TRAV_LIAI", "DISS_SCH"]


def read_columns(path, names):
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name: [float(row[name]) for row in rows] for name in names}


class Solver(unittest.TestCase):
    carom = ""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name)

    def run_case(self, case, name, exit_codes=(0,)):
        """Runs a case file into self.out / name; returns that folder."""
        done = subprocess.run([self.carom, "run", str(case), "--out", str(self.out / name), "--quiet"],
                              capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, exit_codes, msg=f"{case}: {done.stdout}{done.stderr}")
        return self.out / name

    def run_with_solver(self, case, kind):
        """Runs cases/sdnv100/<case> with [solver] kind."""
        text = (CASES / case).read_text(encoding="utf-8").replace('file = "', f'file = "{CASES}/')
        path = self.out / f"{kind}_{case}"
        path.write_text(text + f'\n[solver]\nkind = "{kind}"\n', encoding="utf-8")
        return self.run_case(path, kind)

    def assert_columns_agree(self, one, other, tolerance, what):
        """Differences are relative to the largest value of a column."""
        for name, values in one.items():
            self.assertEqual(len(values), len(other[name]), msg=f"{what}: rows of {name}")
            scale = max(map(abs, values))
            difference = max(abs(a - b) for a, b in zip(values, other[name])) / scale
            self.assertLessEqual(difference, tolerance, msg=f"{what}: {name}")

    def assert_meets_reference(self, case, model):
        """Every step, 5e-9 as for the 8 digits of the manual's instants."""
        folder = self.run_case(CASES / case, "run")
        history, _ = reference.run(*model)
        expected = {f"{place}.{quantity}_z": [row[i][node] for row in history]
                    for place, node in (("A", 0), ("B", -1)) for i, quantity in enumerate(("displacement", "velocity"))}
        self.assert_columns_agree(expected, read_columns(folder / "probes.csv", PROBES), 5.0e-9, case)

    def test_every_step_of_as_published(self):
        self.assert_meets_reference("as_published.toml", reference.as_published())

    def test_every_step_of_current(self):
        self.assert_meets_reference("current.toml", reference.current())

    def test_plain_multipliers(self):
        """Modellings B, C and H: every check holds, the verdict fails for the energy that the scheme takes and, but for H,
        touches make, and the mean velocity of the foot over the shock is that of Code_Aster's tests."""
        for name, mean in (("b", 0.00305885413073), ("c", 0.00305885413073), ("h", None)):
            folder = self.run_case(CASES / "plain" / f"{name}.toml", name, exit_codes=(1,))
            summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
            self.assertEqual([c for c in summary["checks"] if not c["pass"]], [], msg=name)
            failed = {item["name"] for item in summary["verdict"] if not item["pass"]}
            made = {"energy gained"} if name != "h" else set()
            self.assertEqual(failed, {"algorithmic dissipation"} | made, msg=name)
            if mean is None:
                continue
            v = read_columns(folder / "probes.csv", ["A.velocity_z"])["A.velocity_z"][10:51]
            found = 12500.0 * reference.DT * (sum(v) - 0.5 * (v[0] + v[-1]))
            # Terms of up to 2.5 each, of speeds that b has to 2e-10.
            self.assertAlmostEqual(found, mean, delta=1.0e-11 if name == "c" else 2.0e-9, msg=name)

    def test_conjugate_gradients_and_cholmod_agree(self):
        # 1e-9: both solve to the ledger's bound, 1e-10 of the initial energy over the run.
        for case in ("as_published.toml", "current.toml"):
            cg, cholmod = self.run_with_solver(case, "cg"), self.run_with_solver(case, "cholmod")
            for table, names in (("probes.csv", PROBES), ("energy.csv", ENERGIES)):
                self.assert_columns_agree(read_columns(cg / table, names), read_columns(cholmod / table, names), 1.0e-9,
                                          f"{case} {table}")

    def test_med_and_gmsh_files_agree(self):
        # 1e-12: the files hold the same coordinates to 15 digits and differ in the order of nodes and cells.
        med, gmsh = (self.run_case(CASES / f"current_{kind}.toml", kind) for kind in ("med", "msh"))
        self.assert_columns_agree(read_columns(med / "probes.csv", PROBES), read_columns(gmsh / "probes.csv", PROBES),
                                  1.0e-12, "MED against Gmsh")

    def test_stiffness_sweep(self):
        """All checks hold; the verdict rightly fails on the penetration of the softest wall and, for the stiffest ones,
        on the dissipation and the energy that contact closing within a step makes."""
        errors, oscillations = {}, {}
        for exponent in sdnv100_stiffness.EXPONENTS:
            name = f"E_n_1e{exponent}"
            folder = self.run_case(CASES / "stiffness" / f"{name}.toml", name, exit_codes=(0, 1))
            summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
            self.assertEqual([c["name"] for c in summary["checks"] if not c["pass"]], [], msg=name)
            failed = {item["name"] for item in summary["verdict"] if not item["pass"]}
            self.assertLessEqual(failed, {"penetration", "algorithmic dissipation", "energy gained"}, msg=name)
            errors[exponent], oscillations[exponent] = sdnv100_stiffness.measures(
                sdnv100_stiffness.read_foot(folder / "probes.csv"), 10.0**exponent)
        self.assertTrue(sdnv100_stiffness.is_monotone(errors, -1.0), msg=f"displacement errors {errors}")
        self.assertTrue(sdnv100_stiffness.is_monotone(oscillations, 1.0), msg=f"velocity oscillations {oscillations}")


if __name__ == "__main__":
    Solver.carom = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
