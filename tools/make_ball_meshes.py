#!/usr/bin/env python3
"""Write the mesh of cases/balls: two balls of radius 10 mm of irregular tetrahedra, as Gmsh 4.1 writes them.

    python3 tools/make_ball_meshes.py cases/balls [n]

Each ball is a cube of n^3 blocks of six tetrahedra (n = 6 where none is given) with n / 6 layers of blocks out to the
sphere, whose squares are of equal angles; nodes inside and on the sphere are moved at random (seeded) by up to a tenth
of a cell, those of the sphere along it. A is about the origin, B about (20.01, 0, 0) mm, and both are turned at random.
Groups: A, B.
"""

import itertools
import math
import pathlib
import random
import sys

from gmsh_file import TETRA4, GmshFile, tetrahedra

RADIUS, GAP = 0.01, 1e-5
FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def scaled(x, size):
    length = math.hypot(*x)
    return [size * a / length for a in x]


def rotation(draw):
    """A rotation matrix, from a random quaternion."""
    a, b, c, d = scaled([draw.gauss(0.0, 1.0) for _ in range(4)], 1.0)
    return [[a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d]]


class Ball:
    """Positions of the nodes (i, j, k, layer) of a ball about the origin; layer 0 is the cube."""

    def __init__(self, n, draw):
        self.n, self.layers = n, max(1, round(n / 6))
        self.turn, self.positions = rotation(draw), {}
        move = 0.1 * RADIUS / n
        for index in itertools.product(range(n + 1), repeat=3):
            p = [2.0 * i / n - 1.0 for i in index]
            size = max(map(abs, p))
            # Sides of half the radius that bend outwards a little
            core = [0.55 * RADIUS * x * (1.0 - 0.09 * (sum(y * y for y in p) - size * size)) for x in p]
            self.put((*index, 0), [x + move * draw.uniform(-1, 1) for x in core] if 0.0 < size < 1.0 else core)
            if size < 1.0:
                continue
            out = scaled([math.tan(0.25 * math.pi * x) for x in p], RADIUS)
            out = scaled([x + move * draw.uniform(-1, 1) for x in out], RADIUS)
            for layer in range(1, self.layers + 1):
                share = layer / self.layers
                self.put((*index, layer), [a + share * (b - a) for a, b in zip(core, out)])

    def put(self, key, x):
        self.positions[key] = [sum(a * b for a, b in zip(row, x)) for row in self.turn]

    def blocks(self):
        """Corners of each block."""
        for index in itertools.product(range(self.n), repeat=3):
            places = [tuple(i + d for i, d in zip(index, corner)) for corner in CORNERS]
            yield [(*place, 0) for place in places]
            for face, c, side in itertools.product(FACES, range(3), (0, self.n)):
                if all(places[a][c] == side for a in face):
                    for layer in range(self.layers):
                        yield [(*places[a], layer + more) for more in (0, 1) for a in face]


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    n = int(sys.argv[2]) if len(sys.argv) == 3 else 6
    draw = random.Random(4)
    mesh = GmshFile(1e-9)
    for name, x in (("A", 0.0), ("B", 2 * RADIUS + GAP)):
        ball = Ball(n, draw)
        numbers = {key: mesh.node([p[0] + x, p[1], p[2]], name) for key, p in ball.positions.items()}
        for block in ball.blocks():
            for tetra in tetrahedra([numbers[key] for key in block]):
                mesh.add(TETRA4, name, tetra)
    mesh.write(pathlib.Path(sys.argv[1]) / "balls.msh", "4.1")


if __name__ == "__main__":
    main()
