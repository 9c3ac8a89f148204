"""Bodies of many shapes and cell types for the trial of shapes: grids of hexahedra, split where other cells are wanted.

Needs numpy.
"""

import itertools
import math

import numpy as np

from ball_on_plate import ball_nodes, grid_cells
from impact_trial import rotation

TYPES = ("HEXA8", "TETRA4", "TETRA10", "PENTA6", "PYRA5", "HEXA20", "HEXA27")
NODES_PER_CELL = {"HEXA8": 1.3, "TETRA4": 1.3, "TETRA10": 8.5, "PENTA6": 1.3, "PYRA5": 2.3, "HEXA20": 4.6, "HEXA27": 8.5}
GMSH = {"HEXA8": 5, "TETRA4": 4, "TETRA10": 11, "PENTA6": 6, "PYRA5": 7, "HEXA20": 17, "HEXA27": 12}
FACES = {8: ((0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7)),
         4: ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
         6: ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
         5: ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))}
# Middles of edges in the order of Gmsh
MIDDLES = {8: ((0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)),
           4: ((0, 1), (1, 2), (2, 0), (0, 3), (2, 3), (1, 3))}
# Six tetrahedra along the paths from corner 0 to corner 6 (Kuhn, 1960): the same diagonals in all cells of a grid
KUHN = ((0, 1, 2, 6), (0, 5, 1, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 4, 5, 6), (0, 7, 4, 6))


class Body:
    """Nodes and cells of one body; corners first in each cell, then what cells of second order have more."""

    def __init__(self, nodes, cells, kind="HEXA8"):
        self.nodes, self.cells, self.kind = np.array(nodes, dtype=float), cells, kind
        self.corners = {"T": 4, "P": 6, "H": 8}[kind[0]] if kind != "PYRA5" else 5

    def of_type(self, kind):
        """Cells of another type, of hexahedra."""
        nodes, cells = list(map(tuple, self.nodes)), self.cells
        if kind.startswith("TETRA"):
            cells = [[c[i] for i in tetra] for c in cells for tetra in KUHN]
        elif kind == "PENTA6":
            cells = [[c[i] for i in wedge] for c in cells for wedge in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))]
        elif kind == "PYRA5":
            cells = []
            for c in self.cells:
                cells += [[c[i] for i in face[::-1]] + [len(nodes)] for face in FACES[8]]
                nodes.append(tuple(self.nodes[c].mean(axis=0)))
        body = Body(nodes, cells, kind)
        body.check()
        if kind in ("TETRA10", "HEXA20", "HEXA27"):
            body.add_middles(kind == "HEXA27")
        return body

    def add_middles(self, of_faces):
        at, nodes = {}, list(self.nodes)

        def middle(corners):
            key = tuple(sorted(corners))
            if key not in at:
                at[key] = len(nodes)
                nodes.append(self.nodes[list(corners)].mean(axis=0))
            return at[key]

        cells = []
        for c in self.cells:
            more = [middle((c[a], c[b])) for a, b in MIDDLES[self.corners]]
            if of_faces:
                more += [middle([c[i] for i in face]) for face in FACES[8]] + [middle(c)]
            cells.append(list(c) + more)
        self.nodes, self.cells, self.middle = np.array(nodes), cells, at

    def check(self):
        """Each cell is positive at each of its corners."""
        beside = {8: ((1, 3, 4), (2, 0, 5), (3, 1, 6), (0, 2, 7), (7, 5, 0), (4, 6, 1), (5, 7, 2), (6, 4, 3)),
                  4: ((1, 2, 3),), 6: ((1, 2, 3), (2, 0, 4), (0, 1, 5), (5, 4, 0), (3, 5, 1), (4, 3, 2)),
                  5: ((1, 3, 4), (2, 0, 4), (3, 1, 4), (0, 2, 4))}[self.corners]
        x = self.nodes[np.array(self.cells)]
        for i, (a, b, c) in enumerate(beside):
            volume = (np.cross(x[:, a] - x[:, i], x[:, b] - x[:, i]) * (x[:, c] - x[:, i])).sum(axis=1)
            if not (volume > 0.0).all():
                raise ValueError(f"a {self.kind} is not positive at corner {i}")

    def facets(self):
        """Faces of one cell alone, seen from outside, with their middles of second order."""
        seen = {}
        for c in self.cells:
            for face in FACES[self.corners]:
                corners = [c[i] for i in face]
                key = tuple(sorted(corners))
                if seen.pop(key, None) is None:
                    seen[key] = corners
        if self.kind not in ("TETRA10", "HEXA20", "HEXA27"):
            return list(seen.values())
        out = []
        for key, corners in seen.items():
            middles = [self.middle[tuple(sorted(p))] for p in zip(corners, corners[1:] + corners[:1])]
            out.append(corners + middles + ([self.middle[key]] if self.kind == "HEXA27" else []))
        return out

    def cell(self):
        """The shortest edge of a cell's corners."""
        x = self.nodes[np.array(self.cells)[:, :self.corners]]
        pairs = {tuple(sorted(p)) for face in FACES[self.corners] for p in zip(face, face[1:] + face[:1])}
        return min(np.linalg.norm(x[:, a] - x[:, b], axis=1).min() for a, b in pairs)


def grid(n, position, keep=lambda i, j, k: True, closed=False):
    """n[0] x n[1] x n[2] hexahedra, corner (i, j, k) at position(i, j, k); closed: j = n[1] is j = 0 again."""
    number, nodes, cells = {}, [], []
    for cell in grid_cells(n):
        if not keep(*cell[0]):
            continue
        row = []
        for i, j, k in cell:
            key = (i, j % n[1] if closed else j, k)
            if key not in number:
                number[key] = len(nodes)
                nodes.append(position(*key))
            row.append(number[key])
        cells.append(row)
    return Body(nodes, cells)


def box(size, n, shear=0.0):
    """Its middle is the origin; x is sheared by z."""
    def position(i, j, k):
        z = size[2] * (k / n[2] - 0.5)
        return (size[0] * (i / n[0] - 0.5) + shear * z, size[1] * (j / n[1] - 0.5), z)
    return grid(n, position)


def ball(radius, n):
    nodes = ball_nodes(n)
    return grid((n, n, n), lambda *key: [radius * x for x in nodes[key]])


def ring(inner, outer, length, angle, n):
    """A tube where the angle is a whole turn."""
    def position(i, j, k):
        r, phi = inner + (outer - inner) * i / n[0], angle * j / n[1]
        return (r * math.cos(phi), r * math.sin(phi), length * (k / n[2] - 0.5))
    return grid(n, position, closed=angle > 6.28)


def section(size, length, n, along, shape):
    """L or H, of legs n cells thick."""
    wide = 3 * n

    def keep(i, j, _):
        a, b = i // n, j // n
        return a == 0 or b == 0 if shape == "L" else a != 1 or b == 1
    return grid((wide, wide, along), lambda i, j, k: (size * (i / wide - 0.5), size * (j / wide - 0.5),
                                                      length * (k / along - 0.5)), keep)


SHAPES = ("box", "rolled box", "wedge", "needle", "ball", "tube", "sector", "L", "H", "bar")


def draw_body(draw, shape, size):
    """A function of the size of the cells, in sizes of the body, and of how often they are cut: meshes fit a number of nodes
    by it."""
    a, b, c = (draw.uniform(0.6, 1.4) for _ in range(3))
    shear, angle, inner = 1.0 / math.tan(draw.uniform(0.6, 1.1)), draw.uniform(1.0, 3.5), draw.uniform(0.4, 0.7)
    aspect = draw.uniform(1.0, 3.0)

    def make(cell, finer):
        def count(extent, cell, least=1):
            return finer * max(least, round(extent / cell))

        if shape in ("box", "rolled box"):
            d = (a, b, c)
            return box([size * x for x in d], [count(x, cell) for x in d])
        if shape == "wedge":
            d = (0.9 * a, b, 0.6 * c)
            return box([size * x for x in d], [count(x, cell) for x in d], shear)
        if shape in ("needle", "bar"):
            wide = 0.16 * a if shape == "needle" else 0.35 * a
            own = min(cell, wide)
            d, stretch = (wide, wide * min(1.2, b), 1.5 * c), aspect if shape == "needle" else 1.0
            return box([size * x for x in d], [count(d[0], own), count(d[1], own), count(d[2], own * stretch, 3)])
        if shape == "ball":
            return ball(0.5 * size * a, finer * max(2, min(4, 2 * round(0.5 * a / cell))))
        if shape in ("tube", "sector"):
            outer, turn = 0.5 * a, 2.0 * math.pi if shape == "tube" else angle
            n = [count(outer * (1.0 - inner), cell), count(turn * outer, cell, 12 if shape == "tube" else 4),
                 count(0.8 * b, cell)]
            return ring(size * outer * inner, size * outer, 0.8 * size * b, turn, n)
        return section(size * a, size * b, count(a / 3.0, cell), count(b, cell), shape)
    return make
