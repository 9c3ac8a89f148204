#!/usr/bin/env python3
"""Write the CalculiX deck of the free bar (cases/free_bar/newmark.toml): same mesh, material, start and time step.

    python3 bench/peers/calculix_free_bar.py --across 8 --along 160 free_bar.inp
    ccx -i free_bar

The wall is one clamped C3D8 whose upper face is the master surface, met by surface-to-surface penalty contact of
1e14 Pa/m. Integration is *DYNAMIC, DIRECT with steps of 2e-6 s (CalculiX's own alpha method, ALPHA = -0.05): with
ALPHA = 0 its contact iterations do not end when the gap closes on an increment. With --explicit CalculiX chooses the
step itself (with DIRECT its first one does not end), without regard to the contact's stiffness. Standard library only.
"""

import argparse

SIDE, LENGTH, GAP = 0.02, 0.2, 2.0e-3
YOUNG, POISSON, DENSITY, SPEED = 2.0e11, 0.3, 8000.0, 100.0
PENALTY, STEP, END = 1.0e14, 2.0e-6, 1.4e-4


class BarMesh:
    """`across` x `across` x `along` cells; nodes are numbered from 1, along x first, then y, then z."""

    def __init__(self, across, along):
        self.across, self.along = across, along

    def node(self, i, j, k):
        row = self.across + 1
        return 1 + i + row * (j + row * k)

    def nodes(self):
        for k in range(self.along + 1):
            for j in range(self.across + 1):
                for i in range(self.across + 1):
                    yield (self.node(i, j, k), SIDE * (i / self.across - 0.5), SIDE * (j / self.across - 0.5),
                           GAP + LENGTH * k / self.along)

    def cells(self):
        for k in range(self.along):
            for j in range(self.across):
                for i in range(self.across):
                    face = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    yield [self.node(p, q, k + up) for up in (0, 1) for p, q in face]

    def node_count(self):
        return (self.across + 1) ** 2 * (self.along + 1)

    def cell_count(self):
        return self.across**2 * self.along


def mesh_lines(mesh):
    yield "*NODE, NSET=BAR"
    for number, x, y, z in mesh.nodes():
        yield f"{number}, {x:.12g}, {y:.12g}, {z:.12g}"
    yield "*ELEMENT, TYPE=C3D8, ELSET=BAR"
    for number, cell in enumerate(mesh.cells(), start=1):
        yield f"{number}, " + ", ".join(map(str, cell))
    first = mesh.node_count() + 1
    yield "*NODE, NSET=WALL"
    corners = [(-2, -2), (2, -2), (2, 2), (-2, 2)]
    positions = [(SIDE * x, SIDE * y, z) for z in (-SIDE, 0.0) for x, y in corners]
    for number, (x, y, z) in enumerate(positions, start=first):
        yield f"{number}, {x:.12g}, {y:.12g}, {z:.12g}"
    yield "*ELEMENT, TYPE=C3D8, ELSET=WALL"
    yield f"{mesh.cell_count() + 1}, " + ", ".join(str(first + i) for i in range(8))


def model_lines(mesh):
    middle = mesh.across // 2
    yield f"*NSET, NSET=A\n{mesh.node(middle, middle, 0)}"
    yield f"*NSET, NSET=B\n{mesh.node(middle, middle, mesh.along)}"
    yield f"*MATERIAL, NAME=STEEL\n*ELASTIC\n{YOUNG:g}, {POISSON:g}\n*DENSITY\n{DENSITY:g}"
    yield "*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL\n*SOLID SECTION, ELSET=WALL, MATERIAL=STEEL"
    yield "*BOUNDARY\nWALL, 1, 3"
    yield "*SURFACE, NAME=FOOT"
    for number in range(1, mesh.across**2 + 1):
        yield f"{number}, S1"
    yield f"*SURFACE, NAME=PLANE\n{mesh.cell_count() + 1}, S2"
    yield "*SURFACE INTERACTION, NAME=PENALTY\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR"
    yield f"{PENALTY:g}"
    yield "*CONTACT PAIR, INTERACTION=PENALTY, TYPE=SURFACE TO SURFACE\nFOOT, PLANE"
    yield f"*INITIAL CONDITIONS, TYPE=VELOCITY\nBAR, 3, {-SPEED:g}"


def step_lines(step, end, explicit):
    every = "FREQUENCY=100000, " if explicit else ""
    yield "*STEP, INC=100000" + (", NLGEOM" if explicit else "")
    yield f"*DYNAMIC, {'EXPLICIT' if explicit else 'DIRECT'}\n{step:g}, {end:g}"
    for place in "AB":
        yield f"*NODE PRINT, {every}NSET={place}\nU, V"
    yield f"*NODE PRINT, {every}NSET=WALL, TOTALS=ONLY\nRF"
    yield f"*EL PRINT, {every}ELSET=BAR, TOTALS=ONLY\nELSE, ELKE"
    yield "*END STEP"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--across", type=int, default=8, help="cells across the section (even)")
    parser.add_argument("--along", type=int, default=160, help="cells along the bar")
    parser.add_argument("--step", type=float, default=STEP, help="time step, s")
    parser.add_argument("--end", type=float, default=END, help="s")
    parser.add_argument("--explicit", action="store_true", help="explicit steps")
    parser.add_argument("deck", help="file to write, .inp")
    options = parser.parse_args()
    if options.across < 2 or options.across % 2 or options.along < 1:
        parser.error("--across must be even and at least 2 (A and B lie on the axis), --along at least 1")
    mesh = BarMesh(options.across, options.along)
    with open(options.deck, "w", encoding="ascii") as deck:
        deck.write("*HEADING\nFree bar against a rigid wall\n")
        for lines in (mesh_lines(mesh), model_lines(mesh), step_lines(options.step, options.end, options.explicit)):
            for line in lines:
                deck.write(line + "\n")


if __name__ == "__main__":
    main()
