#!/usr/bin/env python3
"""Write the mesh of cases/mixed_cells: a square bar along z in cells of second order of three types, as Gmsh 4.1 writes them.

    python3 tools/make_mixed_mesh.py cases/mixed_cells

From z = 0: three layers of 2 x 2 HEXA20, three of PENTA15 (two a block), four of PYRA13 (six a block). Nodes inside of the bar
and inside of its faces are moved at random (seeded) by up to a tenth of a cell. Groups: BAR; FOOT (z = 0), HEAD (the other end), SIDEX and SIDEY (x, y = 0 and a).
"""

import itertools
import pathlib
import random
import sys

import gmsh_file as gmsh

WIDTH, LENGTH, ACROSS, ALONG = 0.2, 1.0, 2, 10
FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
WEDGES = [(0, 5, 1, 3, 6, 2), (0, 4, 5, 3, 7, 6)]  # along y, so that their faces towards z have four corners
LAYERS = 3 * ["HEXA20"] + 3 * ["PENTA15"] + 4 * ["PYRA13"]


def cells_of(mesh, kind, hexa):
    """The cells of a block and the faces of its six sides, in the order of FACES."""
    quads = [[hexa[a] for a in face] for face in FACES]
    if kind == "HEXA20":
        return [(gmsh.HEXA20, hexa)], [[quad] for quad in quads]
    if kind == "PENTA15":
        sides = [[quad] for quad in quads]
        sides[2], sides[4] = ([(hexa[a], hexa[b], hexa[c]) for a, b, c in two]
                              for two in (((0, 1, 5), (0, 5, 4)), ((3, 6, 2), (3, 7, 6))))
        return [(gmsh.PENTA15, [hexa[a] for a in wedge]) for wedge in WEDGES], sides
    top = mesh.between(*hexa)
    return [(gmsh.PYRA13, [*quad[::-1], top]) for quad in quads], [[quad] for quad in quads]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    mesh, moved, n = gmsh.GmshFile(1e-9), random.Random(1), (ACROSS, ACROSS, ALONG)
    step = (WIDTH / ACROSS, WIDTH / ACROSS, LENGTH / ALONG)
    numbers = {}
    for index in itertools.product(*(range(m + 1) for m in n)):
        x = [i * h for i, h in zip(index, step)]
        for c in range(3):
            if 0 < index[c] < n[c]:
                x[c] += 0.1 * step[c] * moved.uniform(-1.0, 1.0)
        numbers[index] = mesh.node(x)
    names = ["FOOT", "HEAD", "SIDEY", "SIDEX", "SIDEY", "SIDEX"]
    for index in itertools.product(*(range(m) for m in n)):
        hexa = [numbers[tuple(i + d for i, d in zip(index, corner))] for corner in CORNERS]
        cells, sides = cells_of(mesh, LAYERS[index[2]], hexa)
        for kind, corners in cells:
            mesh.add(kind, "BAR", corners)
        outer = [index[2] == 0, index[2] == n[2] - 1, index[1] == 0, index[0] == n[0] - 1, index[1] == n[1] - 1,
                 index[0] == 0]
        for is_outer, name, faces in zip(outer, names, sides):
            for face in faces if is_outer else []:
                mesh.add(gmsh.QUAD8 if len(face) == 4 else gmsh.TRIA6, name, face)
    mesh.write(pathlib.Path(sys.argv[1]) / "bar.msh", "4.1")


if __name__ == "__main__":
    main()
