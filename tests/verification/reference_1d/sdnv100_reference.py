#!/usr/bin/env python3
"""Independent one-dimensional reference of SDNV100 (standard library only).

A bar of two-node elements with consistent mass, Newmark's scheme and a penalty spring, or a multiplier, below its foot.
Within each step the contact is either open or closed: both linear problems are solved and the one that agrees with its
own assumption is kept, so the contact state is exact, not iterated to a tolerance. Nothing here is shared with the
solver in C++.

    python3 sdnv100_reference.py            every published quantity as JSON
    python3 sdnv100_reference.py 1e13       the same for another contact stiffness E_n (traction per penetration)
"""

import json
import math
import sys

END_STEP = 70
DT = 2.0e-6
BETA, GAMMA = 0.28, 0.55


def solve_tridiagonal(lower, diagonal, upper, rhs):
    """Thomas algorithm; lower[i] couples row i to i - 1, upper[i] couples row i to i + 1."""
    n = len(diagonal)
    d, b = diagonal[:], rhs[:]
    for i in range(1, n):
        factor = lower[i] / d[i - 1]
        d[i] -= factor * upper[i - 1]
        b[i] -= factor * b[i - 1]
    x = [0.0] * n
    x[-1] = b[-1] / d[-1]
    for i in range(n - 2, -1, -1):
        x[i] = (b[i] - upper[i] * x[i + 1]) / d[i]
    return x


class Tridiagonal:
    """Symmetric tridiagonal matrix: diagonal[i] and off[i] between i and i + 1."""

    def __init__(self, n):
        self.diagonal = [0.0] * n
        self.off = [0.0] * (n - 1)

    def add_element(self, e, a, b):
        """Add [[a, b], [b, a]] at nodes e, e + 1."""
        self.diagonal[e] += a
        self.diagonal[e + 1] += a
        self.off[e] += b

    def apply(self, x):
        y = [d * xi for d, xi in zip(self.diagonal, x)]
        for e, c in enumerate(self.off):
            y[e] += c * x[e + 1]
            y[e + 1] += c * x[e]
        return y


class Bar:
    """Two-node elements between the heights `z`; contact spring of `stiffness` [N/m] under node 0, wall at z = 0.

    Stiffness math.inf: node 0 is on the wall, or above it without a force, at the end of every step.
    """

    def __init__(self, z, modulus, density, area, stiffness):
        self.z = z
        self.stiffness = stiffness
        self.mass = Tridiagonal(len(z))
        self.tangent = Tridiagonal(len(z))
        for e in range(len(z) - 1):
            h = z[e + 1] - z[e]
            self.mass.add_element(e, density * area * h / 3.0, density * area * h / 6.0)
            self.tangent.add_element(e, modulus * area / h, -modulus * area / h)

    def contact_force(self, u):
        """Force of the spring on node 0, upwards."""
        return max(0.0, -self.stiffness * (self.z[0] + u[0])) if math.isfinite(self.stiffness) else 0.0


def dot(x, y):
    return sum(a * b for a, b in zip(x, y))


def mean(x, y):
    return [0.5 * (a + b) for a, b in zip(x, y)]


def difference(x, y):
    return [a - b for a, b in zip(x, y)]


def newmark_step(bar, u, v, a, newmark=(BETA, GAMMA)):
    """One step of Newmark's scheme; returns u, v, a at its end, and the contact force there."""
    beta, gamma = newmark
    n = len(u)
    u_star = [u[i] + DT * v[i] + DT * DT * (0.5 - beta) * a[i] for i in range(n)]
    v_star = [v[i] + DT * (1.0 - gamma) * a[i] for i in range(n)]
    c = beta * DT * DT
    off = [m + c * k for m, k in zip(bar.mass.off, bar.tangent.off)]
    for closed in (False, True):
        diagonal = [m + c * k for m, k in zip(bar.mass.diagonal, bar.tangent.diagonal)]
        rhs = [-f for f in bar.tangent.apply(u_star)]
        if not closed:
            a_new = solve_tridiagonal([0.0] + off, diagonal, off + [0.0], rhs)
        elif math.isfinite(bar.stiffness):
            diagonal[0] += c * bar.stiffness
            rhs[0] -= bar.stiffness * (bar.z[0] + u_star[0])
            a_new = solve_tridiagonal([0.0] + off, diagonal, off + [0.0], rhs)
        else:
            a_foot = -(bar.z[0] + u_star[0]) / c
            others = [rhs[1] - off[0] * a_foot] + rhs[2:]
            a_new = [a_foot] + solve_tridiagonal([0.0] + off[1:], diagonal[1:], off[1:] + [0.0], others)
        u_new = [u_star[i] + c * a_new[i] for i in range(n)]
        force = bar.contact_force(u_new)
        agrees = (bar.z[0] + u_new[0] < 0.0) == closed
        if closed and not math.isfinite(bar.stiffness):
            force = diagonal[0] * a_new[0] + off[0] * a_new[1] - rhs[0]
            agrees = force >= 0.0
        if agrees:
            v_new = [v_star[i] + gamma * DT * a_new[i] for i in range(n)]
            return u_new, v_new, a_new, force
    raise RuntimeError("neither open nor closed agrees with itself")


def run(bar, u0, v0, newmark=(BETA, GAMMA)):
    """70 steps from the uniform state u0, v0; returns the histories and the energies in Code_Aster's terms."""
    n = len(bar.z)
    u, v, a, force = [u0] * n, [v0] * n, [0.0] * n, bar.contact_force([u0] * n)
    history = [(u, v, force)]
    energy = {"ENER_CIN": 0.0, "ENER_TOT": 0.0, "TRAV_LIAI": 0.0}
    for _ in range(END_STEP):
        u1, v1, a1, force1 = newmark_step(bar, u, v, a, newmark)
        du = difference(u1, u)
        energy["ENER_CIN"] += dot(mean(v, v1), bar.mass.apply(difference(v1, v)))
        energy["ENER_TOT"] += dot(bar.tangent.apply(mean(u, u1)), du)
        energy["TRAV_LIAI"] -= 0.5 * (force + force1) * du[0]
        u, v, a, force = u1, v1, a1, force1
        history.append((u, v, force))
    energy["DISS_SCH"] = -energy["ENER_CIN"] - energy["ENER_TOT"] - energy["TRAV_LIAI"]
    return history, energy


def values_at(history, quantities):
    """{"u_B(8e-05)": value, ...} for (field, node, time) triples; A is node 0, B the last one."""
    values = {}
    for field, point, time in quantities:
        u, v, _ = history[round(time / DT)]
        values[f"{field}_{point}({time:g})"] = {"u": u, "v": v}[field][0 if point == "A" else -1]
    return values


def uniform_heights(bottom, elements=20, length=0.2):
    return [bottom + length * i / elements for i in range(elements + 1)]


def as_published(stiffness_per_area=1.0e14):
    """nu = 0.3, laterally blocked, quarter section, the gap as initial displacement +2 mm."""
    young, nu, density, area = 2.0e11, 0.3, 8000.0, 1.0e-4
    modulus = young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))
    return Bar(uniform_heights(0.0), modulus, density, area, stiffness_per_area * area), 2.0e-3, -100.0


def current(heights=None):
    """nu = 0, full section, 1e10 N/m on each of the four foot nodes, the gap in the mesh."""
    return Bar(heights or uniform_heights(2.0e-3), 2.0e11, 8000.0, 4.0e-4, 4.0e10), 0.0, -100.0


def multipliers(heights, newmark=(BETA, GAMMA)):
    """Modellings B and C of Code_Aster's validation base; H with 0.3025, 0.6."""
    return Bar(heights, 2.0e11, 8000.0, 4.0e-4, math.inf), 0.0, -100.0, newmark


PUBLISHED_POINTS = [("u", "B", 4e-5), ("u", "B", 8e-5), ("u", "B", 1.2e-4), ("v", "B", 4e-5), ("v", "B", 8e-5),
                    ("v", "A", 1.2e-4), ("v", "B", 1.2e-4), ("v", "A", 1.32e-4), ("v", "B", 1.32e-4)]
CURRENT_POINTS = [("u", "A", 4e-5), ("v", "A", 4e-5), ("u", "B", 8e-5), ("v", "B", 8e-5), ("u", "A", 1e-4),
                  ("v", "A", 1e-4), ("v", "A", 1.2e-4), ("v", "B", 1.2e-4), ("v", "A", 1.3e-4)]


def velocity_oscillation(history):
    """Root mean square of v_A at the ends of the steps while the exact bar rests on the wall, over v0."""
    bar_speed = math.sqrt(2.0e11 * 0.7 / (1.3 * 0.4) / 8000.0)
    inside = [v[0] for step, (_, v, _) in enumerate(history)
              if 2.0e-5 < step * DT < 2.0e-5 + 0.4 / bar_speed]
    return math.sqrt(sum(x * x for x in inside) / len(inside)) / 100.0


def summary(model, points):
    history, energy = run(*model)
    return {"values": values_at(history, points), "energies": energy,
            "peak_contact_force": max(force for _, _, force in history),
            "deepest_foot": min(u[0] for u, _, _ in history), "velocity_oscillation": velocity_oscillation(history)}


def main():
    stiffness = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0e14
    result = {"as_published": summary(as_published(stiffness), PUBLISHED_POINTS)}
    if len(sys.argv) == 1:
        result["current"] = summary(current(), CURRENT_POINTS)
    print(json.dumps(result, indent=2))


if __name__ == "__main__":
    main()
