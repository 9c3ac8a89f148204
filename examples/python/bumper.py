"""Shows an optimisation: how stiff must a bumper be that brakes a mass as gently as its thickness allows?

A body of 10 kg with a bumper of 5 cm runs into a wall at 2 m/s. The mesh is made of arrays. scipy looks for the modulus
with the least peak force among those that are not compressed by more than 40 % of their thickness.
"""

import numpy as np
from scipy.optimize import brentq

import carom

AREA, THICKNESS, MASS, SPEED, CELLS = 1e-2, 0.05, 10.0, 2.0, 10


def column(cells):
    """Bars along x: the bumper from 0 to THICKNESS, and one stiff bar that is the body."""
    x = np.append(np.linspace(0.0, THICKNESS, cells + 1), THICKNESS + 0.1)
    points = np.column_stack([x, np.zeros_like(x), np.zeros_like(x)])
    rows = np.column_stack([np.arange(cells + 1), np.arange(1, cells + 2)])
    return carom.Mesh(points, {"line2": rows}, node_groups={"NOSE": [0], "FRONT": [cells]},
                      cell_groups={"BUMPER": np.arange(cells), "BODY": [cells]})


def impact(modulus):
    """The run of one bumper: the peak force on the wall, and the largest compression over the thickness."""
    case = carom.Case({
        "title": "bumper", "units": "SI",
        "materials": {"foam": {"law": "linear_elastic", "E": modulus, "nu": 0.0, "rho": 100.0},
                      "steel": {"law": "linear_elastic", "E": 2.1e9, "nu": 0.0, "rho": MASS / (AREA * 0.1)}},
        "part": [{"name": "bumper", "cells": "BUMPER", "section": "bar", "area": AREA, "material": "foam"},
                 {"name": "body", "cells": "BODY", "section": "bar", "area": AREA, "material": "steel"}],
        "support": [{"nodes": "all", "blocked": ["y", "z"]}],
        "initial": [{"nodes": "all", "velocity": [-SPEED, 0.0, 0.0]}],
        "contact": [{"name": "wall", "kind": "plane", "group": "NOSE", "point": [0.0, 0.0, 0.0],
                     "normal": [1.0, 0.0, 0.0], "measure": "node", "stiffness": 100 * modulus * AREA / THICKNESS}],
        "scheme": {"kind": "central_differences"}, "time": {"end": 0.06},
        "probe": [{"name": "front", "group": "FRONT", "quantities": ["displacement"]}]})
    case.mesh = column(CELLS)
    history = case.start(threads=1).finish().history
    return history["wall.force_x"].max(), -history["front.displacement_x"].min() / THICKNESS


# The softer, the gentler and the deeper: the best bumper is the one that uses all of its way.
best = brentq(lambda modulus: impact(modulus)[1] - 0.4, 1e5, 4e6, rtol=1e-4)
force, compression = impact(best)
print(f"modulus {best / 1e6:.3f} MPa: peak force {force / 1e3:.2f} kN, compressed by {100 * compression:.1f} %")

# A mass on a spring without mass: m v^2 = k x^2, F = k x. Waves in the bumper and the wall's own give change it a little.
expected = MASS * SPEED**2 / (0.4 * THICKNESS)**2 * THICKNESS / AREA
assert abs(best / expected - 1.0) < 0.1, (best, expected)
