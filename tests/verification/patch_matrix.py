#!/usr/bin/env python3
"""Contact patch test over cell types, meshes and enforcements: two blocks, one on the other, pressed by a uniform
pressure; the exact solution is a uniform stress.

    python3 patch_matrix.py build/release/carom            all pairs of types, some minutes
    python3 patch_matrix.py build/release/carom --small    some of them, some seconds: those that must be exact

The blocks are 1 wide and 0.5 high, E = 1000, nu = 0.3, on planes of symmetry, the sides free, the top under a pressure
of 10. Nothing but the contact holds the upper block along the pressure. In the plane they are 1 wide as well; rings
(axisymmetric) reach from the radius 1 to 2 and are held at both radii, where the exact hoop and radial stresses are
those of a strain along the axis alone. Meshes: matching, 2 : 3 cells, and "turned", where the inner nodes of the upper
block are turned about its axis.
Measured, over the pressure:
  stress    greatest deviation of any component of any cell's stress from the exact one, and of the greatest von Mises
            stress of a point;
  pressure  greatest deviation of the contact pressure at a node that has one.
Needs numpy.
"""

import argparse
import itertools
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import shape_bodies
from ball_on_plate import read_field, with_vtu

PRESSURE, E, NU = 10.0, 1000.0, 0.3
SOLIDS = ("HEXA8", "HEXA20", "HEXA27", "TETRA4", "TETRA10", "PENTA6")
PLANES = ("QUAD4", "QUAD8", "TRIA3", "TRIA6")
GMSH = shape_bodies.GMSH | {"QUAD4": 3, "TRIA3": 2, "QUAD8": 16, "TRIA6": 9, "LINE2": 1, "LINE3": 8}
OF_FACE = {3: 2, 4: 3, 6: 9, 8: 16, 9: 10, 2: 1}
MESHES = {"matching": (2, 2, 0.0), "2 : 3": (2, 3, 0.0), "turned": (2, 3, 0.4)}
# name: keys of [scheme] and of [[contact]]
ENFORCEMENTS = {"default": ("", ""), "penalty": ('enforcement = "penalty"\n', ""),
                "lagrange": ('enforcement = "lagrange"\n', ""),
                "lagrange, surface_to_surface": ('enforcement = "lagrange"\n', 'method = "surface_to_surface"\n')}


def turned(x, y, most):
    """(x, y) of the unit square, turned about its middle, the less the nearer to its border."""
    angle = most * (4.0 * x * (1.0 - x)) * (4.0 * y * (1.0 - y))
    u, v = x - 0.5, y - 0.5
    return 0.5 + u * math.cos(angle) - v * math.sin(angle), 0.5 + u * math.sin(angle) + v * math.cos(angle)


def solid_block(kind, n, z, turn):
    def position(i, j, k):
        return (*turned(i / n, j / n, turn), z + 0.25 * k)
    body = shape_bodies.grid((n, n, 2), position).of_type(kind)
    return body.nodes, body.cells, body.facets()


def plane_block(kind, n, y, turn):
    """In x and y; a turn there moves the inner nodes along the contact."""
    def position(i, j):
        x, h = i / n, 0.5 * j
        return (x + (0.3 * turn * math.sin(2.0 * math.pi * x) if 0 < i < n else 0.0), y + h, 0.0)
    corners = [position(i, j) for j in range(2) for i in range(n + 1)]
    cells = [[i, i + 1, i + n + 2, i + n + 1] for i in range(n)]
    if kind.startswith("TRIA"):
        cells = [[c[k] for k in triangle] for c in cells for triangle in ((0, 1, 2), (0, 2, 3))]
    nodes, middles = [np.array(p) for p in corners], {}
    sides = {}
    for c in cells:
        for a, b in zip(c, c[1:] + c[:1]):
            sides[tuple(sorted((a, b)))] = sides.get(tuple(sorted((a, b))), []) + [[a, b]]
    if kind in ("QUAD8", "TRIA6"):
        for a, b in sides:
            middles[a, b] = len(nodes)
            nodes.append(0.5 * (nodes[a] + nodes[b]))
        cells = [c + [middles[tuple(sorted(p))] for p in zip(c, c[1:] + c[:1])] for c in cells]
    outer = [of[0] for of in sides.values() if len(of) == 1]
    return np.array(nodes), cells, [s + ([middles[tuple(sorted(s))]] if middles else []) for s in outer]


class Patch:
    def __init__(self, kinds, mesh, section):
        self.kinds, self.section = kinds, section
        lower, upper, turn = MESHES[mesh]
        make = solid_block if section == "solid" else plane_block
        self.blocks = [make(kinds[0], lower, 0.0, 0.0), make(kinds[1], upper, 0.5, turn)]
        if section == "axisymmetric":
            for nodes, _, _ in self.blocks:
                nodes[:, 0] += 1.0

    def write_mesh(self, path):
        up = 2 if self.section == "solid" else 1
        low = 1.0 if self.section == "axisymmetric" else 0.0
        names, elements, first = [], [], 1
        def add(name, dimension, code, cells):
            names.append(f'{dimension} {len(names) + 1} "{name}"')
            elements.extend(f"{code(c)} 2 {len(names)} {len(names)} " + " ".join(str(n + first) for n in c) for c in cells)
        for b, (nodes, cells, facets) in enumerate(self.blocks):
            kind = self.kinds[b]
            add(f"B{b}", 3 if self.section == "solid" else 2, lambda c, k=kind: GMSH[k], cells)
            code = (lambda c: OF_FACE[len(c)]) if self.section == "solid" else (lambda c: 1 if len(c) == 2 else 8)
            for name, axis, at in (("LOW", up, 0.5 * b), ("HIGH", up, 0.5 * b + 0.5), ("X", 0, low), ("Y", 1, 0.0),
                                   ("R", 0, low + 1.0)):
                if self.section != "solid" and name == "Y":
                    continue
                on = [f for f in facets if np.abs(nodes[f][:, axis] - at).max() < 1e-9]
                add(f"{name}{b}", 2 if self.section == "solid" else 1, code, on)
            first += len(nodes)
        nodes = np.vstack([nodes for nodes, _, _ in self.blocks])
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names,
                 "$EndPhysicalNames", "$Nodes", str(len(nodes))]
        lines += [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(nodes.tolist(), 1)]
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        lines += [f"{i} {e}" for i, e in enumerate(elements, 1)] + ["$EndElements", ""]
        path.write_text("\n".join(lines), encoding="utf-8")

    def exact(self):
        """xx, yy, zz, of both blocks."""
        if self.section == "solid":
            return [0.0, 0.0, -PRESSURE]
        if self.section == "plane_strain":
            return [0.0, -PRESSURE, -NU * PRESSURE]
        side = -NU / (1.0 - NU) * PRESSURE
        return [side, -PRESSURE, side]

    def write(self, folder, enforcement):
        folder.mkdir(parents=True)
        self.write_mesh(folder / "m.msh")
        scheme, contact = ENFORCEMENTS[enforcement]
        up = "z" if self.section == "solid" else "y"
        text = ['units = "SI"\n[mesh]\nfile = "m.msh"',
                f'[materials.m]\nlaw = "linear_elastic"\nE = {E}\nnu = {NU}\nrho = 1.0']
        for b in range(2):
            text.append(f'[[part]]\nname = "B{b}"\ncells = "B{b}"\nmaterial = "m"\nsection = "{self.section}"')
            held = ["X", "R"] if self.section == "axisymmetric" else ["X"]
            text += [f'[[support]]\nnodes = "{name}{b}"\nsymmetry = "x"' for name in held]
            if self.section == "solid":
                text.append(f'[[support]]\nnodes = "Y{b}"\nsymmetry = "y"')
        text.append(f'[[support]]\nnodes = "LOW0"\nsymmetry = "{up}"')
        text.append(f'[[load]]\ngroup = "HIGH1"\npressure = {PRESSURE}\nfunction = "ramp"')
        text.append('[functions.ramp]\ntime = [0.0, 1.0]\nvalue = [0.0, 1.0]')
        text.append(f'[[contact]]\nname = "c"\nkind = "pair"\ngroup = "LOW1"\nmaster = "HIGH0"\n{contact}')
        text.append(f'[scheme]\nkind = "statics"\n{scheme}[time]\nend = 1.0\nstep = 1.0')
        text.append(with_vtu('[output]\nfields = ["displacement", "stress", "contact_pressure"]\nfields_every = 1\n'))
        (folder / "case.toml").write_text("\n".join(text), encoding="utf-8")

    def run(self, carom, folder, enforcement):
        """(stress, pressure), or a text that says why not."""
        self.write(folder, enforcement)
        run = subprocess.run(["prlimit", "--cpu=120", carom, "run", "case.toml", "--out", "out", "--quiet", "--threads", "1"],
                             cwd=folder, text=True, capture_output=True, check=False)
        out = folder / "out"
        if run.returncode not in (0, 1):
            return f"exit code {run.returncode}"
        summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        frame = sorted((out / "fields").glob("*.vtu"))[-1]
        stress = np.array(read_field(frame, "stress")).reshape(-1, 6)
        exact = np.array(self.exact() + [0.0, 0.0, 0.0])
        mises = math.sqrt(0.5 * sum((a - b)**2 for a, b in itertools.combinations(exact[:3], 2)))
        worst = max(np.abs(stress - exact).max(), abs(summary["stress"]["value"] - mises)) / PRESSURE
        pressure = np.array(read_field(frame, "contact_pressure"))
        pressed = pressure[pressure > 0.0]
        return worst, (np.abs(pressed - PRESSURE).max() / PRESSURE if len(pressed) else math.inf)


def allowed(kinds, mesh, enforcement):
    """Error of the stress that is allowed. Faces and means over them are exact: to round-off, or to 1e-6 by the augmented
    Lagrangian (the default), where faces are parallelograms, whose shape functions are polynomials in space. Elsewhere the
    rules of the overlaps integrate rational functions; pieces of the faces of HEXA20 there are no pieces of their parent
    squares either."""
    if mesh != "turned" or kinds[1] in PLANES:
        return 1e-6 if enforcement == "default" else 1e-7  # fields have seven digits
    if kinds[1] == "HEXA20":
        return 2e-3
    return 1e-4 if enforcement == "penalty" else 1e-5  # its rule of 3 points on linear faces, and the rule of 7


def matrix(small):
    if small:
        for mesh, kinds in itertools.product(("2 : 3", "turned"), (("HEXA8", "TETRA4"), ("TETRA4", "HEXA8"), (
                "HEXA20", "HEXA20"), ("TETRA10", "HEXA27"), ("PENTA6", "TETRA10"))):
            yield kinds, mesh, "solid", "default"
        for section in ("plane_strain", "axisymmetric"):
            yield ("QUAD8", "TRIA6"), "turned", section, "default"
        for enforcement in ("lagrange", "lagrange, surface_to_surface"):
            yield ("HEXA8", "TETRA4"), "turned", "solid", enforcement
            yield ("TETRA10", "HEXA27"), "2 : 3", "solid", enforcement
        return
    for section, types in (("solid", SOLIDS), ("plane_strain", PLANES), ("axisymmetric", PLANES)):
        for enforcement, kinds, mesh in itertools.product(ENFORCEMENTS, itertools.product(types, types), MESHES):
            yield kinds, mesh, section, enforcement


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("carom")
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for the runs")
    given = parser.parse_args()
    carom, bad, worst = str(pathlib.Path(given.carom).resolve()), 0, {}
    os.environ["OMP_NUM_THREADS"] = "1"
    with tempfile.TemporaryDirectory() as temporary:
        folder = given.keep or pathlib.Path(temporary)
        for i, (kinds, mesh, section, enforcement) in enumerate(matrix(given.small)):
            found = Patch(kinds, mesh, section).run(carom, folder.resolve() / str(i), enforcement)
            is_text = isinstance(found, str)
            is_bad = is_text or found[0] > allowed(kinds, mesh, enforcement)
            bad += is_bad
            key = (section, enforcement, mesh)
            if not is_text:
                worst[key] = max(worst.get(key, ((0.0, 0.0), ())), (found, kinds), key=lambda entry: entry[0][0])
            if is_bad or given.small:
                print(f"{i:4d} {' on '.join(reversed(kinds)):20} {mesh:9} {section:13} {enforcement:28} "
                      + (found if is_text else f"stress {found[0]:.1e}  pressure {found[1]:.1e}")
                      + ("  BAD" if is_bad else ""), flush=True)
    print("\nworst stress, and the pressure of the same run")
    for (section, enforcement, mesh), ((stress, pressure), kinds) in worst.items():
        print(f"{section:13} {enforcement:28} {mesh:9} {stress:8.1e} {pressure:8.1e}  {' on '.join(reversed(kinds))}")
    print(f"{bad} bad")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
