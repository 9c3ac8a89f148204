"""Meshes that tools/ make: volumes and areas of Taylor's bar in every kind of cell, and what `carom mesh` reads of them."""

import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

CAROM = str(pathlib.Path(sys.argv.pop(1)).resolve())
TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
RADIUS, LENGTH = 3.2e-3, 32.4e-3
N = 2

# Tetrahedra that fill each cell, and triangles that cover each face, by places in its node list (Gmsh's types).
SOLIDS = {5: [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)],
          6: [(0, 1, 2, 3), (1, 2, 3, 4), (2, 3, 4, 5)], 4: [(0, 1, 2, 3)], 11: [(0, 1, 2, 3)]}
FACES = {3: [(0, 1, 2), (0, 2, 3)], 2: [(0, 1, 2)], 9: [(0, 1, 2)]}


def minus(a, b):
    return [p - q for p, q in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def read(path):
    """Nodes by number, and (group, type, nodes) of every cell of a Gmsh 2.2 file."""
    lines = path.read_text().splitlines()
    def section(name):
        first = lines.index(f"${name}") + 1
        return [line.split() for line in lines[first + 1 : first + 1 + int(lines[first])]]
    names = {int(tag): name.strip('"') for _, tag, name in section("PhysicalNames")}
    nodes = {int(i): [float(v) for v in x] for i, *x in section("Nodes")}
    return nodes, [(names[int(tag)], int(kind), [int(n) for n in members])
                   for _, kind, _, tag, _, *members in section("Elements")]


class Taylor(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def make(self, tool, *names):
        subprocess.run(["/usr/bin/python3", TOOLS / tool, self.folder, *names], check=True, capture_output=True)

    def test_volumes_and_areas_of_the_quarter(self):
        angle = math.pi / 4 / N  # the circle is a polygon
        section = 2 * N * 0.5 * RADIUS**2 * math.sin(angle)
        arc = 2 * N * 2 * RADIUS * math.sin(angle / 2)
        expected = {"FOOT": section, "TOP": section, "SIDE": arc * LENGTH, "SYMX": RADIUS * LENGTH,
                    "SYMZ": RADIUS * LENGTH}
        layers = round(LENGTH / RADIUS * 2 * N)
        expected["CONTACT"] = section + arc * math.floor(RADIUS * layers / LENGTH) * LENGTH / layers
        kinds = ["hexa8", "penta6", "tetra4", "tetra10"]
        self.make("make_taylor_meshes.py", *(f"{kind}_{N}" for kind in kinds))
        for kind in kinds:
            nodes, cells = read(self.folder / f"taylor_{kind}_{N}.msh")
            volume, area = 0.0, dict.fromkeys(expected, 0.0)
            for group, of_type, members in cells:
                x = [nodes[n] for n in members]
                for a, b, c, d in SOLIDS.get(of_type, []):
                    part = dot(minus(x[b], x[a]), cross(minus(x[c], x[a]), minus(x[d], x[a]))) / 6
                    volume += abs(part) if of_type == 6 else part
                for a, b, c in FACES.get(of_type, []):
                    normal = cross(minus(x[b], x[a]), minus(x[c], x[a]))
                    area[group] += 0.5 * math.sqrt(dot(normal, normal))
            self.assertAlmostEqual(volume / (section * LENGTH), 1.0, delta=1e-9, msg=kind)  # 12 digits in the file
            for group, value in expected.items():
                self.assertAlmostEqual(area[group] / value, 1.0, delta=1e-9, msg=f"{kind} {group}")

    def test_middles_on_the_side_lie_on_the_cylinder(self):
        self.make("make_taylor_meshes.py", f"tetra10_{N}")
        nodes, cells = read(self.folder / f"taylor_tetra10_{N}.msh")
        on_side = {n for group, _, members in cells if group == "SIDE" for n in members}
        for n in on_side:
            self.assertAlmostEqual(math.hypot(nodes[n][0], nodes[n][2]) / RADIUS, 1.0, delta=1e-9)

    def summary(self, name):
        done = subprocess.run([CAROM, "mesh", self.folder / name], capture_output=True, text=True, check=True)
        return done.stdout

    def test_carom_reads_them_without_turning_a_cell(self):
        self.make("make_taylor_meshes.py", f"quad4_{N}", f"full_tetra10_{N}", f"full_hexa8_{N}")
        for name in (f"quad4_{N}", f"full_tetra10_{N}", f"full_hexa8_{N}"):
            self.assertIn("0 cells turned", self.summary(f"taylor_{name}.msh"))

    def test_bars_of_tetrahedra_in_the_format_of_gmsh_4(self):
        self.make("make_tetra_meshes.py")
        text = self.summary("bars.msh")
        self.assertIn("Gmsh 4.1 text", text)
        self.assertIn("0 cells turned", text)
        for group in ("BAR", "BAR_B", "FOOT", "FOOT_B", "SIDEX", "SIDEY_B"):
            self.assertRegex(text, rf" {group} +\d+  T")

    def test_bars_that_show_each_other_an_edge_are_those_of_the_cases(self):
        self.make("make_edge_meshes.py")
        for name in ("crossed.msh", "rolling.msh"):
            self.assertIn("0 cells turned", self.summary(name))
            nodes, cells = read(self.folder / name)
            in_cases, cells_in_cases = read(TOOLS.parent / "cases" / "edges" / name)
            self.assertEqual(cells, cells_in_cases)
            for n, x in nodes.items():
                self.assertLess(math.dist(x, in_cases[n]), 1e-10)  # written to ten digits
            lowest_above = min(nodes[n][2] for group, _, members in cells if group == "B" for n in members)
            highest_below = max(nodes[n][2] for group, _, members in cells if group == "A" for n in members)
            self.assertAlmostEqual(highest_below, 0.0, delta=1e-10)
            self.assertAlmostEqual(lowest_above, {"crossed.msh": 1e-5, "rolling.msh": 2e-4}[name], delta=1e-10)

    def test_balls_are_those_of_the_case(self):
        self.make("make_ball_meshes.py")
        self.assertIn("0 cells turned", self.summary("balls.msh"))
        in_cases = (TOOLS.parent / "cases" / "balls" / "balls.msh").read_text(encoding="ascii").split()
        made = (self.folder / "balls.msh").read_text(encoding="ascii").split()
        self.assertEqual(len(made), len(in_cases))
        for a, b in zip(made, in_cases):
            self.assertTrue(a == b or abs(float(a) - float(b)) < 1e-12)  # written to twelve digits of centimetres

    def test_gears_are_those_of_the_case(self):
        self.make("make_gear_meshes.py")
        self.assertIn("0 cells turned", self.summary("involute.msh"))
        nodes, cells = read(self.folder / "involute.msh")
        in_cases, cells_in_cases = read(TOOLS.parent / "cases" / "gears" / "involute.msh")
        self.assertEqual(cells, cells_in_cases)
        for n, x in nodes.items():
            self.assertLess(math.dist(x, in_cases[n]), 1e-12)  # written to twelve digits
        # A tooth takes half of the pitch on the pitch circle, less the backlash: the chord between the involutes there,
        # which lie between nodes 1.25 mm apart, whose sag is below h^2 / 8 rho = 10 um.
        driver = sorted({n for group, _, members in cells if group == "DRIVER" for n in members})
        x = [(nodes[n][0] + 0.105, nodes[n][1]) for n in driver]
        upper = [(math.hypot(*p), math.atan2(p[1], p[0])) for p in x if 0.0 < math.atan2(p[1], p[0]) < math.pi / 18]
        upper.sort()
        (r, a), (s, b) = next((p, q) for p, q in zip(upper, upper[1:]) if p[0] <= 0.045 < q[0])
        self.assertAlmostEqual((a + (b - a) * (0.045 - r) / (s - r)) * 0.045, math.pi / 4 * 5e-3, delta=10e-6)


if __name__ == "__main__":
    unittest.main()
