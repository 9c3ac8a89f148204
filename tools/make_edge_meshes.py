#!/usr/bin/env python3
"""Write the meshes of cases/edges: two square bars of HEXA8, A below and B above, rolled about their axes so that they show
each other an edge.

    python3 tools/make_edge_meshes.py cases/edges

`crossed` are equal bars of 60 mm that cross at right angles in their middles, `rolling` is a cube of 20 mm, rolled by 10
degrees and turned by 60, over a bar of 80 mm that is rolled by 45. Groups: A, B.
"""

import itertools
import math
import pathlib
import sys

from gmsh_file import HEXA8, GmshFile

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def turned(x, axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    out = list(x)
    out[i], out[j] = c * x[i] - s * x[j], s * x[i] + c * x[j]
    return out


def add_bar(mesh, name, size, cells, roll, turn, place):
    """A box about its middle, rolled about x, turned about z, then moved to the place."""
    def node(index):
        x = [s * (i / n - 0.5) for s, i, n in zip(size, index, cells)]
        x = turned(turned(x, 0, roll), 2, turn)
        return mesh.node([a + b for a, b in zip(x, place)], name)
    for index in itertools.product(*(range(n) for n in cells)):
        mesh.add(HEXA8, name, [node(tuple(i + d for i, d in zip(index, corner))) for corner in CORNERS])


def lowest_edge(side, roll):
    """y and z of the lowest edge of a bar about its middle, before it is turned."""
    return min((turned((0.0, y * side / 2, z * side / 2), 0, roll)[1:] for y in (-1, 1) for z in (-1, 1)),
               key=lambda x: x[1])


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    half = 0.01 * math.sqrt(0.5)
    mesh = GmshFile()
    add_bar(mesh, "A", (0.06, 0.01, 0.01), (9, 3, 3), 45.0, 0.0, (0.0, 0.0, -half))
    add_bar(mesh, "B", (0.06, 0.01, 0.01), (9, 3, 3), 45.0, 90.0, (0.0, 0.0, half + 1e-5))
    mesh.write(folder / "crossed.msh")
    mesh = GmshFile()
    add_bar(mesh, "A", (0.08, 0.02, 0.02), (12, 3, 3), 45.0, 0.0, (0.0, 0.0, -2 * half))
    y, z = lowest_edge(0.02, 10.0)
    x = turned((0.002, -y, 0.0), 2, 60.0)
    add_bar(mesh, "B", (0.02, 0.02, 0.02), (3, 3, 3), 10.0, 60.0, (x[0] + 0.002, x[1], 2e-4 - z))
    mesh.write(folder / "rolling.msh")


if __name__ == "__main__":
    main()
