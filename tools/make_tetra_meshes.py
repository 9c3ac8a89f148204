#!/usr/bin/env python3
"""Write the meshes of cases/tetrahedra: square bars along z in tetrahedra, as Gmsh 4.1 writes them.

    python3 tools/make_tetra_meshes.py cases/tetrahedra

`bar` is [0, a]^2 x [0, L], `bars` has a second one, _B, from -L_B to 0 with other cells, so that no node of one touches a
node of the other. Nodes inside of the bars and inside of their faces are moved at random (seeded) by up to a quarter of a
cell, so that no two tetrahedra are alike. Groups: BAR; FOOT (z = 0), HEAD (the other end), SIDEX and SIDEY (x, y = 0
and a).
"""

import itertools
import pathlib
import random
import sys

from gmsh_file import TETRA4, TRIA3, GmshFile, tetrahedra, triangles

WIDTH = 0.2
FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def add_bar(mesh, cells, low, high, suffix, seed):
    """cells[0] x cells[0] x cells[1] blocks of six tetrahedra from z = low to high."""
    moved = random.Random(seed)
    n = (cells[0], cells[0], cells[1])
    step = (WIDTH / n[0], WIDTH / n[1], (high - low) / n[2])
    numbers = {}
    for index in itertools.product(*(range(m + 1) for m in n)):
        x = [i * h for i, h in zip(index, step)]
        for c in range(3):
            if 0 < index[c] < n[c]:
                x[c] += 0.25 * step[c] * moved.uniform(-1.0, 1.0)
        x[2] += low
        numbers[index] = mesh.node(x, suffix)
    names = ["SIDEX", "SIDEX", "SIDEY", "SIDEY", "FOOT", "HEAD"]
    for index in itertools.product(*(range(m) for m in n)):
        places = [tuple(i + d for i, d in zip(index, corner)) for corner in CORNERS]
        hexa = [numbers[place] for place in places]
        for tetra in tetrahedra(hexa):
            mesh.add(TETRA4, "BAR" + suffix, tetra)
        for face in FACES:
            for c, side in itertools.product(range(3), (0, 1)):
                if all(places[a][c] == side * n[c] for a in face):
                    name = names[2 * c + side]
                    if suffix and c == 2:
                        name = names[5 - side]  # the second bar touches with its upper end
                    for triangle in triangles([hexa[a] for a in face]):
                        mesh.add(TRIA3, name + suffix, triangle)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    for name, with_second in (("bar", False), ("bars", True)):
        mesh = GmshFile(1e-9)
        add_bar(mesh, (3, 16), 0.0, 1.0, "", 1)
        if with_second:
            add_bar(mesh, (4, 18), -1.0, 0.0, "_B", 2)
        mesh.write(folder / f"{name}.msh", "4.1")


if __name__ == "__main__":
    main()
