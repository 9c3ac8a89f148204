#!/usr/bin/env python3
"""Independent one-dimensional reference of the bouncing bar (standard library only).

100 two-node elements with lumped mass, central differences, the contact of one node in closed form. Nothing here is
shared with the solver in C++. Data as in cases/impact_bar/twenty_impacts.toml.

    python3 impact_bar_reference.py     energy after twenty impacts for step sizes around Courant number 0.9

The energy after many impacts is chaotic: each impact leaves oscillations of the shortest waves, whose phase at the next
touch depends on the whole past. A step changed by a quarter of a percent gives another value; the printed range is what
a single published number has to be read with.
"""

import math
import sys

CELLS, LENGTH, MODULUS, DENSITY, GAP, GRAVITY = 100, 10.0, 900.0, 1.0, 0.05, 0.1
PERIOD = 16.0 / 3.0
CROSSING = LENGTH / CELLS / math.sqrt(MODULUS / DENSITY)
DROP_ENERGY = DENSITY * LENGTH * GRAVITY * GAP


def masses(layers):
    """Lumped; with layers, the mass of the foot spread evenly over that many nodes above it."""
    h = LENGTH / CELLS
    m = [0.5 * h] + [h] * (CELLS - 1) + [0.5 * h]
    for i in range(1, layers + 1):
        m[i] += 0.5 * h / layers
    if layers:
        m[0] = 0.0
    return [DENSITY * x for x in m]


class Bar:
    """contact: "penalty" (of stiffness E/h), "forward_increment", "cd_lagrange" or "modified_mass"."""

    def __init__(self, contact, layers=0):
        self.contact, self.m = contact, masses(layers)
        self.inverse = [1.0 / x if x else 0.0 for x in self.m]
        self.k = MODULUS * CELLS / LENGTH
        self.penalty = self.k
        self.u, self.v = [GAP] * (CELLS + 1), [0.0] * (CELLS + 1)
        self.a = [-GRAVITY if x else 0.0 for x in self.m]
        self.force, self.stretch = 0.0, [0.0] * CELLS

    def step(self, dt):
        half = [v + 0.5 * dt * a for v, a in zip(self.v, self.a)]
        u = self.u = [x + dt * v for x, v in zip(self.u, half)]
        if self.contact == "modified_mass":
            u[0] = max(0.0, u[1])  # in equilibrium with its element, or on the wall
        e = self.stretch = [b - a for a, b in zip(u, u[1:])]
        inner = [self.k * e[0]] + [self.k * (b - a) for a, b in zip(e, e[1:])] + [-self.k * e[-1]]
        self.force = self.contact_force(u[0], half[0], inner[0] * self.inverse[0] - GRAVITY, dt)
        a = self.a = [f * w - GRAVITY for f, w in zip(inner, self.inverse)]
        a[0] = 0.0 if not self.m[0] else a[0] + self.force * self.inverse[0]
        self.v = [v + 0.5 * dt * x for v, x in zip(half, a)]
        if not self.m[0]:
            self.v[0] = 0.0  # without mass it has no part in the energy

    def contact_force(self, u, half, free, dt):
        """Force on the foot at u with the velocity `half` of the half step before and the acceleration `free`."""
        if self.contact == "penalty":
            return max(0.0, -self.penalty * u)
        if self.contact == "modified_mass":
            return max(0.0, -self.k * self.u[1])
        if self.contact == "forward_increment":  # such that the next u is not below the wall
            return max(0.0, -(u + dt * (half + dt * free)) * self.m[0] / dt**2)
        return max(0.0, -(half + dt * free) * self.m[0] / dt) if u <= 0.0 else 0.0

    def energy(self):
        total = sum(0.5 * m * v * v + m * GRAVITY * u for m, v, u in zip(self.m, self.v, self.u))
        total += 0.5 * self.k * sum(e * e for e in self.stretch)
        return total + (0.5 * self.force**2 / self.penalty if self.contact == "penalty" else 0.0)


def energy_after_twenty_impacts(contact, layers, courant):
    """Over the energy of the start, after the first whole number of steps that reaches ten periods."""
    bar, dt = Bar(contact, layers), courant * CROSSING
    for _ in range(math.ceil(10.0 * PERIOD / dt - 1.0e-6)):
        bar.step(dt)
    return bar.energy() / DROP_ENERGY


def main():
    courants = [float(c) for c in sys.argv[1:]] or [0.895, 0.8975, 0.9, 0.9025, 0.905]
    print("Courant number".ljust(32) + "".join(f"{c:9.4f}" for c in courants))
    for contact, layers in (("modified_mass", 1), ("modified_mass", 4), ("forward_increment", 0), ("cd_lagrange", 0)):
        values = [energy_after_twenty_impacts(contact, layers, c) for c in courants]
        print(f"{contact}, {layers} layers".ljust(32) + "".join(f"{e:9.4f}" for e in values))


if __name__ == "__main__":
    main()
