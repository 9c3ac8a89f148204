#!/usr/bin/env python3
"""SDNV100 on its 20 cells: the velocity field of better.toml beside that of other schemes.

    python3 sdnv100_better_test.py build/release/carom
"""

import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import sdnv100_better as better  # noqa: E402


def documented_rows():
    """{scheme: printed numbers} of the table of docs/sdnv100.md."""
    text = (ROOT / "docs" / "sdnv100.md").read_text(encoding="utf-8")
    lines = text.partition("| scheme and contact | error")[2].splitlines()[2:]
    rows = {}
    for line in lines:
        if not line.startswith("|"):
            break
        name, *cells = (cell.strip() for cell in line.strip("|").split("|"))
        rows[name] = [cell.split()[0] for cell in cells]
    return rows


class Better(unittest.TestCase):
    carom = ""

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as name:
            cls.found = {variant: better.measures(better.run(cls.carom, pathlib.Path(name) / str(i), data))
                         for i, (variant, data) in enumerate(better.VARIANTS.items())}

    def test_better_meets_its_goals(self):
        """An earlier computation with the same scheme in one dimension has 3.2 %, 1.105 and 99.9 m/s."""
        m = self.found[better.BETTER]
        self.assertLessEqual(m["error"], 0.035)
        self.assertLessEqual(m["L1 norm"], 0.035)
        self.assertLessEqual(m["peak"], 1.11)
        self.assertLessEqual(abs(m["centre"] / better.SPEED - 1.0), 2.0e-3)
        self.assertGreaterEqual(m["kinetic"], 0.998)
        self.assertLessEqual(m["balance"], 1.0e-10)

    def test_manual_is_twice_as_far(self):
        """Independent one-dimensional computation of the manual's scheme: 1.50 of the force, 94.7 m/s, 2934.38 J."""
        m = self.found[better.MANUAL]
        self.assertGreaterEqual(m["error"], 1.8 * self.found[better.BETTER]["error"])
        self.assertAlmostEqual(m["peak"], 1.50, delta=0.01)
        self.assertAlmostEqual(m["centre"], 94.7, delta=0.05)
        self.assertAlmostEqual(m["kinetic"], 2934.38 / 3200.0, delta=1.0e-5)

    def test_documentation(self):
        """Every printed digit, and one unit of the last for what rounding and the order of sums may do to it."""
        rows = documented_rows()
        self.assertEqual(list(rows), list(self.found))
        for name, m in self.found.items():
            values = [100.0 * m["error"], 100.0 * m["L1 norm"], m["peak"], m["centre"], 100.0 * m["kinetic"]]
            for printed, value in zip(rows[name], values):
                unit = 10.0 ** -len(printed.partition(".")[2])
                self.assertAlmostEqual(float(printed), value, delta=1.01 * unit, msg=name)

    def test_picture(self):
        """One line of 1401 points for the exact curve in each of three panels, two for the runs."""
        svg = (ROOT / "docs" / "images" / "sdnv100_better.svg").read_text(encoding="utf-8")
        self.assertEqual(svg.count("<polyline"), 9)


if __name__ == "__main__":
    Better.carom = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
