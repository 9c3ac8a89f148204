#!/usr/bin/env python3
"""Write meshes of Taylor's bar: a cylinder of radius 3.2 mm and length 32.4 mm that stands on the plane y = 0.

    python3 tools/make_taylor_meshes.py FOLDER [NAME...]

Names are KIND_N, e.g. hexa8_4; without names those of the three densities N = 2, 4, 8 of every kind are written. The
bar has 2 N cells from its axis to its side, and cells as high as they are wide. Kinds:
  quad4          the half section x >= 0 in the plane z = 0, to be used as axisymmetric
  hexa8          the quarter x >= 0, z >= 0, with a core of N x N cells and rings
  penta6, tetra4, tetra10    the same, its hexahedra cut into two and six; middles on the side lie on the cylinder
  full_hexa8 ... the whole cylinder instead of a quarter
Groups: BAR; FOOT (y = 0), TOP, SIDE, CONTACT (the foot, and the side up to one radius: what may touch the wall); SYMX,
SYMZ (x = 0, z = 0; not of the whole bar); RIM (the node at (R, 0, 0)), CROWN (the node at (0, L, 0)).
"""

import itertools
import math
import pathlib
import sys

from gmsh_file import HEXA8, LINE2, PENTA6, POINT, QUAD4, TETRA4, TETRA10, TRIA3, TRIA6, GmshFile, tetrahedra, triangles

RADIUS, LENGTH = 3.2e-3, 32.4e-3
KINDS = ["quad4", "hexa8", "penta6", "tetra4", "tetra10"]
FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


def ring_point(across, level, n):
    """From the core's edge (level 0) to the circle (level n), at `across` in [0, 1] of the eighth of the section."""
    half = 0.5
    flat = (half, half * across)
    angle = math.pi / 4 * across
    bulge = 0.06 * math.cos(math.pi / 2 * across)  # the core's sides are curved: no flat angle in its corner
    inner = (flat[0] + bulge * half, flat[1])
    share = level / n
    return tuple((1 - share) * p + share * q for p, q in zip(inner, (math.cos(angle), math.sin(angle))))


def core_point(s, t):
    """Of the square with curved sides, s and t in [0, 1]."""
    def bulged(a, b):
        return 0.5 * a + 0.03 * a * math.cos(math.pi / 2 * b)
    return bulged(s, t), bulged(t, s)


def quarter_section(n):
    """Quadrilaterals of a quarter of the unit disc as positions (x, z), turning from x to z."""
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    cells = []
    for i, j in itertools.product(range(n), repeat=2):
        cells.append([core_point((i + a) / n, (j + b) / n) for a, b in square])
    for j, level in itertools.product(range(n), repeat=2):
        eighth = [ring_point((j + b) / n, level + a, n) for a, b in square]
        cells.append(eighth)
        cells.append([(z, x) for x, z in eighth[::-1]])
    return cells


def section(n, full):
    cells = quarter_section(n)
    turned = []
    for turn in range(4 if full else 1):
        c, s = [(1, 0), (0, 1), (-1, 0), (0, -1)][turn]
        turned += [[(c * x - s * z, s * x + c * z) for x, z in cell] for cell in cells]
    return turned


def on_side(x, y):
    """The middle of two nodes, on the cylinder if they are."""
    middle = [(p + q) / 2.0 for p, q in zip(x, y)]
    if all(abs(math.hypot(p[0], p[2]) - RADIUS) < 1e-9 * RADIUS for p in (x, y)):
        factor = RADIUS / math.hypot(middle[0], middle[2])
        middle[0], middle[2] = factor * middle[0], factor * middle[2]
    return middle


def groups_of(points, full):
    """Groups of a face (an edge in the plane) by the places of its corners; none inside of the bar."""
    zero = 1e-9 * RADIUS
    def all_at(measure, value):
        return all(abs(measure(x) - value) < zero for x in points)
    if all_at(lambda x: x[1], 0.0):
        return ["FOOT", "CONTACT"]
    if all_at(lambda x: x[1], LENGTH):
        return ["TOP"]
    if all_at(lambda x: math.hypot(x[0], x[2]), RADIUS):
        low = all(x[1] <= RADIUS + zero for x in points)
        return ["SIDE", "CONTACT"] if low else ["SIDE"]
    if full:
        return []
    return ["SYMX"] if all_at(lambda x: x[0], 0.0) else (["SYMZ"] if all_at(lambda x: x[2], 0.0) else [])


def add_groups(mesh, kind, corners, full):
    for group in groups_of([mesh.nodes[a - 1] for a in corners], full):
        mesh.add(kind, group, corners)


def plane_mesh(n):
    mesh = GmshFile(1e-9 * RADIUS)
    layers = round(LENGTH / RADIUS * 2 * n)
    for i, j in itertools.product(range(2 * n), range(layers)):
        x = [mesh.node([RADIUS * (i + a) / (2 * n), LENGTH * (j + b) / layers])
             for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        mesh.add(QUAD4, "BAR", x)
        for a in range(4):
            points = [x[a], x[(a + 1) % 4]]
            if abs(sum(mesh.nodes[p - 1][0] for p in points)) > 0.0:  # the axis is no side
                add_groups(mesh, LINE2, points, True)
    return mesh


def add_hexa(mesh, kind, hexa, full):
    """A hexahedron, or what it is cut into, and its faces in the groups they belong to."""
    quads = [[hexa[a] for a in face] for face in FACES]
    if kind == "hexa8":
        mesh.add(HEXA8, "BAR", hexa)
    elif kind == "penta6":  # cut along the bar, at the smallest node of the lower section
        for a, b, c in triangles(hexa[:4]):
            above = {low: high for low, high in zip(hexa[:4], hexa[4:])}
            mesh.add(PENTA6, "BAR", (a, b, c, above[a], above[b], above[c]))
    else:
        for tetra in tetrahedra(hexa):
            mesh.add(TETRA4 if kind == "tetra4" else TETRA10, "BAR", tetra)
    for f, quad in enumerate(quads):
        if kind == "hexa8" or (kind == "penta6" and f > 1):
            add_groups(mesh, QUAD4, quad, full)
            continue
        for triangle in triangles(quad):
            add_groups(mesh, TRIA6 if kind == "tetra10" else TRIA3, triangle, full)


def solid_mesh(kind, n, full):
    mesh = GmshFile(1e-9 * RADIUS, on_side)
    layers = round(LENGTH / RADIUS * 2 * n)
    for j in range(layers):
        for cell in section(n, full):
            heights = [LENGTH * (j + up) / layers for up in (0, 1)]
            # x to z is clockwise seen along y: the section is run backwards
            hexa = [mesh.node([RADIUS * x, y, RADIUS * z]) for y in heights for x, z in cell[::-1]]
            add_hexa(mesh, kind, hexa, full)
    return mesh


def make(folder, name):
    kind, n = name.rsplit("_", 1)
    full = kind.startswith("full_")
    mesh = plane_mesh(int(n)) if kind == "quad4" else solid_mesh(kind.removeprefix("full_"), int(n), full)
    for place, group in (([RADIUS, 0.0, 0.0], "RIM"), ([0.0, LENGTH, 0.0], "CROWN")):
        mesh.add(POINT, group, [mesh.node(place if kind != "quad4" else place[:2])])
    mesh.write(folder / f"taylor_{name}.msh")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    names = sys.argv[2:] or [f"{kind}_{n}" for kind in KINDS for n in (2, 4, 8)]
    for name in names:
        if name.rsplit("_", 1)[0].removeprefix("full_") not in KINDS:
            sys.exit(f"{name}: not one of {', '.join(KINDS)} with _N")
        make(pathlib.Path(sys.argv[1]), name)


if __name__ == "__main__":
    main()
