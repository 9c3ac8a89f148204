#!/usr/bin/env python3
"""Write the meshes of cases/hertz: a body of radius R = 10 mm that touches the plane y = 0 at the origin.

    python3 tools/make_hertz_meshes.py cases/hertz

Plane meshes (QUAD4, z = 0) are the half x >= 0 of a disc, to be used as axisymmetric sphere or plane-strain cylinder;
solid ones (HEXA8) are the quarter x >= 0, z >= 0 of a ball. `half_*` ends at the cut y = R, `full_*` and `solid_*` are
the whole body, `two_*` is the body and its mirror image at y = 0, whose
groups end in _B (`two_half_*`: of `half_*`). The number is n:

The lower half is the image of a quarter disc (eighth of a ball) of radius 2 R about the origin, with a square (cubic)
core of n x n cells and rings that grow geometrically, under the map that takes the half space to the ball about (0, R):
f(x) = (x + |x|^2 e_y / 2R) / (1 + x . e_y / R + |x|^2 / 4R^2). It is conformal (two inversions and a shift), so that
cells keep their shapes, and it takes |x| = 2R to the plane y = R. The upper half is the mirror image of the same with a
wider core. Groups: BODY; SURFACE (what may touch: twice the core); CUT (y = R); SYMX, SYMZ (x = 0, z = 0); POLE,
CENTRE, TOP (nodes on the axis).
"""

import itertools
import math
import pathlib
import sys

RADIUS = 0.01
POINT, LINE2, QUAD4, HEXA8 = 15, 1, 3, 5
DIMENSION = {POINT: 0, LINE2: 1, QUAD4: 2, HEXA8: 3}


def ring_position(on_cube, level, levels, ratio):
    """Ring `level` of `levels`: from the unit cube's surface to a sphere."""
    angles = [math.tan(math.pi / 4 * v) for v in on_cube]
    length = math.sqrt(sum(v * v for v in angles))
    weight = level / levels
    return [ratio**level * ((1.0 - weight) * flat + weight * v / length) for flat, v in zip(on_cube, angles)]


def quarter(dimension, core, n, levels, radius):
    """Cells of the quarter disc or eighth of a ball, as lists of corner positions in the order of Gmsh."""
    cells = []
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    if dimension == 3:
        corners = [(*c, up) for up in (0, 1) for c in corners]
    for low in itertools.product(range(n), repeat=dimension):
        cells.append([[core * (a + b) / n for a, b in zip(low, corner)] for corner in corners])
    ratio = (radius / core) ** (1.0 / levels)
    for axis in range(dimension):
        for low in itertools.product(range(n), repeat=dimension - 1):
            for level in range(levels):
                cell = []
                for corner in corners:
                    on_cube = [(a + b) / n for a, b in zip(low, corner[1:])]
                    on_cube.insert(0, 1.0)
                    on_cube = on_cube[-axis:] + on_cube[:-axis] if axis else on_cube
                    cell.append([core * v for v in ring_position(on_cube, level + corner[0], levels, ratio)])
                cells.append(cell if dimension == 3 or axis == 0 else [cell[i] for i in (0, 3, 2, 1)])
    return cells


def to_ball(x):
    square = sum(v * v for v in x)
    below = 1.0 + x[1] / RADIUS + square / (4.0 * RADIUS**2)
    return [(v + (square / (2.0 * RADIUS) if i == 1 else 0.0)) / below for i, v in enumerate(x)]


class Mesh:
    def __init__(self, dimension):
        self.dimension = dimension
        self.numbers = {}
        self.nodes = []
        self.cells = []

    def node(self, x, body=""):
        key = (body, *(round(v / RADIUS * 1e9) for v in x))
        if key not in self.numbers:
            self.nodes.append((list(x) + [0.0])[:3])
            self.numbers[key] = len(self.nodes)
        return self.numbers[key]

    def faces(self, cell):
        if self.dimension == 2:
            return [[cell[i], cell[(i + 1) % 4]] for i in range(4)]
        sides = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
        return [[cell[i] for i in side] for side in sides]

    def half(self, core, n, levels, upper, touching, body=""):
        """The lower or upper half; faces within `touching` of the origin are SURFACE. "_B" is mirrored at y = 0."""
        turned = (0, 3, 2, 1) if self.dimension == 2 else (0, 3, 2, 1, 4, 7, 6, 5)
        face_kind = LINE2 if self.dimension == 2 else QUAD4
        for cell in quarter(self.dimension, core, n, levels, 2.0 * RADIUS):
            where = {}
            members = []
            for x in cell:
                y = to_ball(x)
                if abs(math.sqrt(sum(v * v for v in x)) - 2.0 * RADIUS) < 1e-9 * RADIUS:
                    y[1] = RADIUS
                if upper:
                    y[1] = 2.0 * RADIUS - y[1]
                if body:
                    y[1] = -y[1]
                members.append(self.node(y, body))
                where[members[-1]] = x
            if upper != bool(body):
                members = [members[i] for i in turned]
            self.cells.append((QUAD4 if self.dimension == 2 else HEXA8, "BODY" + body, members))
            for face in self.faces(members):
                group = face_group([where[number] for number in face], upper, touching)
                if group:
                    self.cells.append((face_kind, group + body, face))

    def write(self, path, full):
        marks = [(0.0, "POLE"), (RADIUS, "CENTRE")] + ([(2.0 * RADIUS, "TOP")] if full else [])
        for y, group in marks:
            self.cells.append((POINT, group, [self.node([0.0, y, 0.0][: self.dimension])]))
        tags = {}
        for kind, group, _ in self.cells:
            tags.setdefault((DIMENSION[kind], group), len(tags) + 1)
        with open(path, "w", encoding="ascii") as out:
            out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(tags)}\n")
            for (dimension, group), tag in tags.items():
                out.write(f'{dimension} {tag} "{group}"\n')
            out.write(f"$EndPhysicalNames\n$Nodes\n{len(self.nodes)}\n")
            for number, x in enumerate(self.nodes, start=1):
                out.write(f"{number} {x[0]:.12g} {x[1]:.12g} {x[2]:.12g}\n")
            out.write(f"$EndNodes\n$Elements\n{len(self.cells)}\n")
            for number, (kind, group, members) in enumerate(self.cells, start=1):
                tag = tags[(DIMENSION[kind], group)]
                out.write(f"{number} {kind} 2 {tag} {tag} {' '.join(map(str, members))}\n")
            out.write("$EndElements\n")


def face_group(points, upper, touching):
    """Group of a face, from where it is before the map; empty inside of the body."""
    zero = 1e-9 * RADIUS
    radii = [math.sqrt(sum(v * v for v in x)) for x in points]
    if all(abs(r - 2.0 * RADIUS) < zero for r in radii):
        return "" if upper else "CUT"
    for axis, group in enumerate(["SYMX", "", "SYMZ"][: len(points[0])]):
        if group and all(abs(x[axis]) < zero for x in points):
            return group
    on_surface = all(abs(x[1]) < zero for x in points)
    return "SURFACE" if on_surface and not upper and max(radii) <= touching else ""


def rings(core, n):
    """So many that a ring is as high as its cells are wide."""
    return max(2, round(math.log(2.0 * RADIUS / core) / math.log(1.0 + math.pi / (4 * n))))


def make(path, dimension, core, n, full):
    mesh = Mesh(dimension)
    for body in ("", "_B") if path.name.startswith("two_") else ("",):
        mesh.half(core, n, rings(core, n), False, 2.0 * core, body)
        if full:
            mesh.half(0.7 * RADIUS, n, rings(0.7 * RADIUS, n), True, 0.0, body)
    mesh.write(path, full)
    print(f"{path}: {len(mesh.nodes)} nodes, {sum(c[1] == 'BODY' for c in mesh.cells)} cells")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    for name, dimension, core, n, full in MESHES:
        make(folder / f"{name}.msh", dimension, core, n, full)


# Name, dimension, side of the core, cells along it, whole body or lower half.
MESHES = [
    ("half_8", 2, 0.4e-3, 8, False),
    ("half_16", 2, 0.4e-3, 16, False),
    ("full_6", 2, 0.6e-3, 6, True),
    ("two_6", 2, 0.6e-3, 6, True),
    ("two_half_8", 2, 0.4e-3, 8, False),
    ("solid_4", 3, 0.6e-3, 4, True),
]


if __name__ == "__main__":
    main()
