#!/usr/bin/env python3
"""Write the mesh of cases/gears: two spur gears of involute teeth (module 5 mm, pressure angle 20 degrees) that mesh.

    python3 tools/make_gear_meshes.py cases/gears

The driven gear, 24 teeth about the origin, is cells (QUAD4, z = 0) of the group GEAR, with the edges TEETH (its whole
profile) and BORE (a polygon around its circle of 35 mm). Its teeth are thinner than half of the pitch by BACKLASH on the
pitch circle. The driver, 18 teeth about (-105 mm, 0), is a line, the group DRIVER: counter-clockwise, so that it is met
from outside. A driver's tooth stands on the line between the axes, and the driven gear is turned so that it touches the
flank that leads when the driver turns counter-clockwise. Nodes lie on the involutes; below the base circle flanks are
radial. MARK is the node of the bore on the positive x axis, but for that turn.
"""

import math
import pathlib
import sys

from gmsh_file import LINE2, POINT, QUAD4, GmshFile

MODULE, PRESSURE_ANGLE = 5e-3, math.radians(20.0)
DRIVER_TEETH, GEAR_TEETH = 18, 24
ADDENDUM, DEDENDUM, BACKLASH, BORE = MODULE, 1.25 * MODULE, 0.1e-3, 35e-3
ACROSS, ALONG, BELOW, GAP = 4, 9, 5, 3  # cells: of a tooth across and along, of the rim, of the ground between teeth


def involute(angle):
    return math.tan(angle) - angle


def half_tooth(teeth, r, thinner=0.0):
    """Half of the angle that a tooth takes at the radius r; `thinner`: on the whole pitch circle's arc of it."""
    pitch = MODULE * teeth / 2
    base = pitch * math.cos(PRESSURE_ANGLE)
    at_pitch = math.pi / (2 * teeth) - thinner / (2 * pitch)
    return at_pitch + involute(PRESSURE_ANGLE) - involute(math.acos(min(1.0, base / r)))


def radii(teeth):
    """Along a flank, from the ground to the tip."""
    pitch = MODULE * teeth / 2
    return [pitch - DEDENDUM + (DEDENDUM + ADDENDUM) * k / ALONG for k in range(ALONG + 1)]


def place(r, angle, centre=0.0):
    return (centre + r * math.cos(angle), r * math.sin(angle))


def add_gear(mesh, turn):
    """Cells ring by ring: those of the rim go around, those of the teeth stand on them."""
    levels = radii(GEAR_TEETH)
    ground = levels[0]

    def tooth(k, level, i):
        half = half_tooth(GEAR_TEETH, levels[level], BACKLASH)
        return mesh.node(place(levels[level], turn + 2 * math.pi * k / GEAR_TEETH + half * (2 * i / ACROSS - 1)))

    half = half_tooth(GEAR_TEETH, ground, BACKLASH)
    angles = []  # of the nodes on the ground circle
    for k in range(GEAR_TEETH):
        middle = turn + 2 * math.pi * k / GEAR_TEETH
        angles += [middle + half * (2 * i / ACROSS - 1) for i in range(ACROSS)]
        angles += [middle + half + (2 * math.pi / GEAR_TEETH - 2 * half) * i / GAP for i in range(GAP)]
    angles.append(angles[0])

    def rim(level, i):
        return mesh.node(place(BORE * (ground / BORE) ** (level / BELOW), angles[i]))
    for i in range(len(angles) - 1):
        for level in range(BELOW):
            mesh.add(QUAD4, "GEAR", [rim(level, i), rim(level + 1, i), rim(level + 1, i + 1), rim(level, i + 1)])
        mesh.add(LINE2, "BORE", [rim(0, i), rim(0, i + 1)])
        if i % (ACROSS + GAP) >= ACROSS:
            mesh.add(LINE2, "TEETH", [rim(BELOW, i), rim(BELOW, i + 1)])
    for k in range(GEAR_TEETH):
        for level in range(ALONG):
            for i in range(ACROSS):
                mesh.add(QUAD4, "GEAR", [tooth(k, level, i), tooth(k, level + 1, i), tooth(k, level + 1, i + 1),
                                         tooth(k, level, i + 1)])
            mesh.add(LINE2, "TEETH", [tooth(k, level, 0), tooth(k, level + 1, 0)])
            mesh.add(LINE2, "TEETH", [tooth(k, level, ACROSS), tooth(k, level + 1, ACROSS)])
        for i in range(ACROSS):
            mesh.add(LINE2, "TEETH", [tooth(k, ALONG, i), tooth(k, ALONG, i + 1)])
    mesh.add(POINT, "MARK", [rim(0, ACROSS // 2)])


def add_driver(mesh):
    levels = radii(DRIVER_TEETH)
    centre = -MODULE * (DRIVER_TEETH + GEAR_TEETH) / 2
    nodes = []
    for k in range(DRIVER_TEETH):
        middle = 2 * math.pi * k / DRIVER_TEETH
        halves = [half_tooth(DRIVER_TEETH, r) for r in levels]
        corners = [(r, middle - half) for r, half in zip(levels, halves)]
        corners += [(levels[-1], middle + halves[-1] * (2 * i / ACROSS - 1)) for i in range(1, ACROSS)]
        corners += [(r, middle + half) for r, half in reversed(list(zip(levels, halves)))]
        gap = 2 * math.pi / DRIVER_TEETH - 2 * halves[0]
        corners += [(levels[0], middle + halves[0] + gap * i / GAP) for i in range(1, GAP)]
        nodes += [mesh.node(place(r, angle, centre), "DRIVER") for r, angle in corners]
    for a, b in zip(nodes, nodes[1:] + nodes[:1]):
        mesh.add(LINE2, "DRIVER", [a, b])


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    mesh = GmshFile()
    # Between two teeth of the gear there is half a pitch; turned by half of the backlash, one touches the driver's.
    add_gear(mesh, math.pi / GEAR_TEETH * (1 - GEAR_TEETH % 2) + BACKLASH / (MODULE * GEAR_TEETH))
    add_driver(mesh)
    mesh.write(pathlib.Path(sys.argv[1]) / "involute.msh")


if __name__ == "__main__":
    main()
