#!/usr/bin/env python3
"""300 impacts of two bodies with default settings, drawn from a seed: every one must end good and be right.

    python3 impact_trial.py build/release/carom                 all, about an hour
    python3 impact_trial.py build/release/carom --small         one in twenty of them and what once failed, half a minute
    python3 impact_trial.py build/release/carom --only 17,203   these alone; --keep DIR keeps decks and results
    python3 impact_trial.py build/release/carom --seed 31337    300 others

Thirty impacts of four kinds: two bars in line, a ball on a plate, a block on a block, a cylinder across a beam. Each is
drawn with stiffnesses equal or 1 : 100, cells 1 : 4 to 4 : 1, a speed of 3e-4 to 3e-3 of the wave's, a tilt (blocks and
cylinders; of the order of the speed over the wave's, so that one touch grows over the face: of a block that comes down
on its corner the mesh decides, by the inertia of lumped masses and by the point load), turned arbitrarily in space, at
the origin or 100 m from it, in SI or mm-t-s, half of them with friction. All end after the rebound.
Each runs by ten draws of scheme, enforcement and method of contact, so that over all impacts every combination that the
table of compatibility allows, plain multipliers apart (they make energy), comes twice without and twice with friction.
Nothing else is chosen: stiffnesses, safety,
tolerances and masses are the defaults; the coarser side is the master; implicit steps last half as long as a wave of
the slower body needs through the finest cell, but are at most 600.
A run is right if
  good       it ends with exit code 0;
  momentum   linear momentum keeps to the impulses to 1e-9 of the summary's scale;
  gain       kinetic + strain + contact energy exceeds what was there and supplied, dissipation by friction left out, by
             less than 0.5 % at the end (mean of the last tenth) and, energy lent by explicit schemes apart, at any time;
  impulse    of contact along the axis of the impact at the end: bars within 3 % of the exact one-dimensional solution;
             others within 5 % of the median of the ten runs of the impact that ended good;
  overlap    no node of either skin is deeper inside of the other body than a quarter of the smaller cell (of the
             fields, by inversion of the cells' shape functions: the program's own gap is not asked).
A run that is refused, or stops, must say a remedy, and counts apart.
The exact impulse of bars: characteristics of the one-dimensional wave equation (Graff, Wave Motion in Elastic Solids,
1975, section 2.4): the contact force is F = Z1 Z2 V / (Z1 + Z2) while the first wave runs to the free end of the bar
with the shorter travel time and back; each later round trip multiplies it by (Z1 - Z2) / (Z1 + Z2), Z1 being that bar;
where that is not positive, the bars part.
Standard library only, and prlimit of util-linux.
"""

import argparse
import concurrent.futures
import itertools
import json
import math
import pathlib
import random
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

from ball_on_plate import ball_nodes, grid_cells, grid_faces, permuted, read_csv, read_field, with_vtu

SEED = 20261122
IMPACTS, DRAWS = 30, 10
METHODS = ("node_to_surface", "two_pass", "surface_to_surface")
COMBINATIONS = [(scheme, enforcement) for schemes, enforcements in (
    (("newmark", "hht", "wbz", "generalized_alpha", "bathe"), ("penalty", "augmented_lagrangian", "lagrange")),
    (("contact_stabilized_newmark",), ("lagrange",)),
    (("energy_momentum",), ("penalty",)),
    (("moreau_jean", "nonsmooth_generalized_alpha"), ("impulse",)),
    (("central_differences", "hulbert_chung", "noh_bathe", "tchamwa_wielgosz"), ("penalty",)),
    (("cd_lagrange",), ("impulse",)),
    (("forward_increment", "modified_mass"), ("lagrange",))) for scheme in schemes for enforcement in enforcements]
EXPLICIT = {"central_differences", "hulbert_chung", "noh_bathe", "tchamwa_wielgosz", "cd_lagrange",
            "forward_increment", "modified_mass"}
UNITS = {"SI": (1.0, 1.0), "mm-t-s": (1e3, 1e-3)}  # factors of length and mass; time is in seconds in both
ONCE_WRONG = (41, 81, 139, 159)  # broken off by a crash, 159 slow too: redundant rows of exact contact that follow
TIME_LIMIT = 120  # s of processor time
DEPTH_LIMIT = 0.25


# ------------------------------------------------------------------------------------------------------- the bodies
class Body:
    """Nodes and hexahedra of one body, and its outer faces, seen from outside."""

    def __init__(self, n, position):
        """A grid of n[0] x n[1] x n[2] cells, each corner (i, j, k) at position(i, j, k)."""
        self.number, self.nodes = {}, []
        for key in itertools.product(*(range(m + 1) for m in n)):
            self.number[key] = len(self.nodes)
            self.nodes.append(list(position(*key)))
        self.cells = [[self.number[c] for c in cell] for cell in grid_cells(n)]
        self.faces = {(axis, last): [[self.number[c] for c in face] for face in grid_faces(n, axis, last)]
                      for axis in range(3) for last in (False, True)}
        self.skin = [face for faces in self.faces.values() for face in faces]

    def move(self, shift, turn=None):
        for p in self.nodes:
            x = product(turn, p) if turn else p
            p[:] = [x[c] + shift[c] for c in range(3)]

    def lowest(self):
        return min(p[2] for p in self.nodes)


def box(size, n):
    """A box whose upper face's middle is the origin."""
    return Body(n, lambda i, j, k: (size[0] * (i / n[0] - 0.5), size[1] * (j / n[1] - 0.5), size[2] * (k / n[2] - 1.0)))


def ball(radius, n):
    nodes = ball_nodes(n)
    return Body((n, n, n), lambda *key: [radius * x for x in nodes[key]])


def cylinder(radius, length, n, along):
    """Axis along y; a square of n^2 cells mapped to the disc."""
    def position(i, j, k):
        a, b = (math.tan(0.25 * math.pi * (2.0 * m / n - 1.0)) for m in (i, k))
        size, reach = max(abs(a), abs(b)), math.hypot(a, b)
        stretch = (1.0 - size) / 1.2 + size * size / reach if reach > 0.0 else 1.0
        return radius * a * stretch, length * (j / along - 0.5), radius * b * stretch
    return Body((n, along, n), position)


def product(turn, x):
    return [sum(turn[i][c] * x[c] for c in range(3)) for i in range(3)]


def rotation(axis, angle):
    """Rodrigues' formula."""
    length = math.sqrt(sum(a * a for a in axis))
    u = [a / length for a in axis]
    c, s = math.cos(angle), math.sin(angle)
    cross = [[0.0, -u[2], u[1]], [u[2], 0.0, -u[0]], [-u[1], u[0], 0.0]]
    return [[(c if i == j else 0.0) + (1.0 - c) * u[i] * u[j] + s * cross[i][j] for j in range(3)] for i in range(3)]


# ------------------------------------------------------------------------------------------------------ the impacts
class Impact:
    """One geometry: two bodies, the flying one above the other (along z before it is turned), all drawn."""

    def __init__(self, number, friction, seed):
        draw = random.Random(f"{seed} impact {number}")
        self.number = number
        self.kind = ("bars", "ball", "blocks", "cylinder")[number % 4]
        self.friction = draw.choice((0.1, 0.3)) if friction else 0.0
        self.ratio = draw.choice((0.25, 0.5, 1.0, 2.0, 4.0))  # cell of the lower body over that of the flying one
        self.stiffer = draw.choice((1.0, 1.0, 0.01, 100.0))  # E of the flying body over that of the lower one
        self.speed = 10.0 ** draw.uniform(-3.5, -2.5)
        self.units = draw.choice(tuple(UNITS))
        self.distance = draw.choice((0.0, 100.0))
        self.turn = rotation([draw.gauss(0.0, 1.0) for _ in range(3)], draw.uniform(0.0, math.pi))
        self.nu, finite = 0.3, draw.choice(("neo_hookean", "st_venant_kirchhoff"))
        self.law = draw.choice(("linear_elastic", "linear_elastic", "linear_elastic", finite))
        self.held = None  # faces of the lower body that are held
        self.tilt, self.slide = 0.0, 0.0
        self.gap = 1e-5
        getattr(self, self.kind)(draw)
        if self.ratio < 1.0:
            self.law = "linear_elastic"  # many cells
        elif self.tilt:
            self.law = finite  # the bodies turn
        for body in (self.upper, self.lower):
            body.cell = min(math.dist(body.nodes[a], body.nodes[b]) for cell in body.cells
                            for a, b in ((cell[0], cell[1]), (cell[1], cell[2]), (cell[0], cell[4])))
        away = [draw.gauss(0.0, 1.0) for _ in range(3)]
        length = math.sqrt(sum(a * a for a in away))
        for body in (self.upper, self.lower):
            body.move([self.distance * a / length for a in away], self.turn)

    def modulus(self):
        """Of the flying and of the lower body; the softer one has 2e9."""
        return tuple(2e9 * f for f in (max(1.0, self.stiffer), max(1.0, 1.0 / self.stiffer)))

    density = (1200.0, 1200.0)

    def waves(self):
        p_wave = (1.0 - self.nu) / ((1.0 + self.nu) * (1.0 - 2.0 * self.nu))
        return tuple(math.sqrt(p_wave * E / rho) for E, rho in zip(self.modulus(), self.density))

    def velocity(self):
        v = self.speed * min(self.waves())
        return product(self.turn, [self.slide * v, 0.0, -v])

    def normal_speed(self):
        return self.speed * min(self.waves())

    def fly(self, shift=(0.0, 0.0), tilt=None):
        """Puts the flying body over the lower one's upper face at z = 0."""
        self.upper.move([0.0, 0.0, 0.0], tilt)
        self.upper.move([shift[0], shift[1], self.gap - self.upper.lowest()])

    def bars(self, draw):
        self.law, self.nu = "linear_elastic", 0.0
        length, wide = draw.uniform(0.16, 0.24), 0.04
        n = draw.choice((2, 3))
        cell = wide / n if n > 2 else 0.5 * wide
        count = max(12, round(length / cell))
        m = {0.25: 4, 0.5: 3, 1.0: n, 2.0: 2, 4.0: 1}[self.ratio]
        c1, c2 = self.waves()
        other = 1.6 * length * c2 / c1 if self.stiffer != 0.01 else 1.3 * length  # the lower bar's travel time is longer
        other = max(other, 0.16) if self.stiffer != 100.0 else max(0.35 * length, other)
        counts = count, max(14, min(60, round(other / (cell * self.ratio))))
        self.upper = box((wide, wide, length), (n, n, counts[0]))
        self.lower = box((wide, wide, other), (m, m, counts[1]))
        self.fly()
        trip = [2.0 * L / c for L, c in ((length, c1), (other, c2))]
        Z = [math.sqrt(E * rho) for E, rho in zip(self.modulus(), self.density)]
        short = 0 if trip[0] <= trip[1] else 1
        z_1, z_2 = Z[short], Z[1 - short]
        flight = self.gap / self.normal_speed()
        # Until the wave is back from the far end of the longer bar, less the two cells over which a mesh smears its
        # front, or soon after the bars have parted.
        back = [t * (1.0 - 2.0 / n) for t, n in zip(trip, counts)]
        until = back[1 - short] if z_1 > z_2 else min(1.25 * trip[short], max(back))
        if trip[1 - short] <= trip[short] * 1.02:
            until = back[1 - short]
        force = Z[0] * Z[1] / (Z[0] + Z[1]) * self.normal_speed() * wide * wide
        impulse, begin = 0.0, 0.0
        while begin < until and force > 1e-12 * Z[0]:
            impulse += force * (min(until, begin + trip[short]) - begin)
            force *= (z_1 - z_2) / (z_1 + z_2)
            begin += trip[short]
        self.exact = impulse
        self.end = flight + until

    def ball(self, draw):
        radius, self.ratio = 0.03, min(self.ratio, 2.0)  # a plate of cells as large as the ball is no plate
        n = {0.25: 3, 0.5: 4, 1.0: 4, 2.0: 6}[self.ratio]
        cell = 2.0 * radius / n * self.ratio
        wide, high = max(2, round(0.07 / cell)), max(1, round(0.03 / cell))
        self.upper = ball(radius, n)
        self.lower = box((wide * cell, wide * cell, high * cell), (wide, wide, high))
        self.held = (2, False)
        self.slide = draw.choice((0.0, 0.3)) if self.friction else 0.0
        self.fly((0.13 * radius, 0.21 * radius))
        # Hertz (Johnson, Contact Mechanics, 1985, section 11.4): duration 2.94 d / v, for the greatest approach d
        E = 1.0 / sum((1.0 - self.nu**2) / E for E in self.modulus())
        v, mass = self.normal_speed(), 4.0 / 3.0 * math.pi * radius**3 * self.density[0]
        depth = (15.0 * mass * v * v / (16.0 * math.sqrt(radius) * E)) ** 0.4
        self.end = (self.gap + 0.25 * cell * cell / radius) / v + 1.4 * 2.94 * depth / v

    def blocks(self, draw):
        size = 0.05
        n = {0.25: 4, 0.5: 5, 1.0: 6, 2.0: 8, 4.0: 8}[self.ratio]
        cell = size / n * self.ratio
        wide, high = max(3, round(1.2 * size / cell)), max(3, round(0.6 * size / cell))
        self.upper = box((size, size, size), (n, n, n))
        self.lower = box((wide * cell, wide * cell, high * cell), (wide, wide, high))
        self.held = draw.choice((None, (2, False)))
        self.tilt = self.speed * draw.choice((0.0, 0.5, 2.0))
        self.slide = draw.choice((0.0, 0.4)) if self.friction else draw.choice((0.0, 0.0, 0.2))
        self.fly((0.11 * size, 0.07 * size), rotation((0.8, 0.6, 0.0), self.tilt) if self.tilt else None)
        rise = math.sin(self.tilt) * size * 1.4
        travel = 2.0 * size / min(self.waves()) * (1.5 if self.stiffer == 1.0 else 2.0)
        self.end = (self.gap + 0.6 * rise) / self.normal_speed() + 2.0 * travel

    def cylinder(self, draw):
        radius, n, self.ratio = 0.02, 6, min(self.ratio, 2.0)
        cell = 0.25 * math.pi * radius * 2.0 / n * self.ratio * 2.0
        wide, high = max(2, round(0.03 / cell)), max(2, round(0.02 / cell))
        length = max(6, min(20, round(0.14 / cell)))
        self.upper = cylinder(radius, 0.06, n, 6)
        self.lower = box((length * cell, wide * cell, high * cell), (length, wide, high))
        self.held = (2, False)
        self.tilt = self.speed * draw.choice((0.0, 0.5))
        self.slide = draw.choice((0.0, 0.3)) if self.friction else 0.0
        self.fly((0.003, 0.002), rotation((1.0, 0.0, 0.0), self.tilt) if self.tilt else None)
        # the mean gap of a facet closes after its rise; then some passages of waves through the cylinder
        rise = 0.5 * math.sin(self.tilt) * 0.06 + radius * (1.0 - math.cos(0.25 * math.pi / n * 2.0))
        self.end = (self.gap + rise) / self.normal_speed() + 24.0 * radius / min(self.waves())

    def step(self):
        """Of implicit schemes: Courant number 1/2 in the finest cell, waves of the slower body; at most 600 steps of
        linear bodies, 150 of others."""
        most = 600.0 if self.law == "linear_elastic" else 150.0
        return max(0.5 * min(self.upper.cell, self.lower.cell) / min(self.waves()), self.end / most)

    def describe(self):
        return (f"{self.kind:8} E {self.stiffer:g} cells {self.ratio:g} mu {self.friction:g} tilt {self.tilt:g} "
                f"slide {self.slide:g} {self.distance:g} m {self.units}")


class Variant:
    """One run of an impact."""

    def __init__(self, number, impact, scheme, enforcement, method):
        self.number, self.impact = number, impact
        self.scheme, self.enforcement, self.method = scheme, enforcement, method

    def name(self):
        return f"{self.scheme} {self.enforcement} {self.method}"

    def write(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        impact, (length, mass) = self.impact, UNITS[self.impact.units]
        self.write_mesh(folder / "bodies.msh", length)
        stress, density = mass / length, mass / length**3
        text = [f'title = "{self.number}: {impact.describe()}; {self.name()}"', f'units = "{impact.units}"',
                '[mesh]\nfile = "bodies.msh"']
        for name, E, rho in zip(("UPPER", "LOWER"), impact.modulus(), impact.density):
            text.append(f'[materials.{name}]\nlaw = "{impact.law}"\nE = {E * stress!r}\nnu = {impact.nu}\n'
                        f'rho = {rho * density!r}\n[[part]]\nname = "{name}"\ncells = "{name}"\nmaterial = "{name}"')
        if impact.held:
            text.append('[[support]]\nnodes = "HELD"\nblocked = ["x", "y", "z"]')
        velocity = [v * length for v in impact.velocity()]
        text.append(f'[[initial]]\npart = "UPPER"\nvelocity = {velocity!r}')
        friction = f"\nfriction = {impact.friction}" if impact.friction else ""
        slave, master = ("UPPER", "LOWER") if impact.ratio >= 1.0 else ("LOWER", "UPPER")
        text.append(f'[[contact]]\nname = "touch"\nkind = "pair"\ngroup = "{slave}_SKIN"\nmaster = "{master}_SKIN"\n'
                    f'method = "{self.method}"{friction}')
        text.append(f'[scheme]\nkind = "{self.scheme}"\nenforcement = "{self.enforcement}"')
        text.append(f"[time]\nend = {impact.end!r}")
        if self.scheme not in EXPLICIT:
            text.append(f"step = {impact.step()!r}")
        text.append(with_vtu('[output]\nfields = ["displacement"]\n'))
        (folder / "case.toml").write_text("\n".join(text), encoding="utf-8")

    def write_mesh(self, path, length):
        """Gmsh's format 2.2."""
        upper, lower = self.impact.upper, self.impact.lower
        shift = len(upper.nodes)
        parts = [(3, "UPPER", upper.cells, 0), (3, "LOWER", lower.cells, shift), (2, "UPPER_SKIN", upper.skin, 0),
                 (2, "LOWER_SKIN", lower.skin, shift)]
        if self.impact.held:
            parts.append((2, "HELD", lower.faces[self.impact.held], shift))
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(parts))]
        lines += [f'{dimension} {tag} "{name}"' for tag, (dimension, name, _, _) in enumerate(parts, 1)]
        nodes = upper.nodes + lower.nodes
        lines += ["$EndPhysicalNames", "$Nodes", str(len(nodes))]
        lines += [f"{i} {x * length!r} {y * length!r} {z * length!r}" for i, (x, y, z) in enumerate(nodes, 1)]
        elements = [f"{5 if dimension == 3 else 3} 2 {tag} {tag} " + " ".join(str(i + 1 + first) for i in cell)
                    for tag, (dimension, _, cells, first) in enumerate(parts, 1) for cell in cells]
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        lines += [f"{i} {element}" for i, element in enumerate(elements, 1)] + ["$EndElements", ""]
        path.write_text("\n".join(lines), encoding="utf-8")

    def run(self, carom, folder):
        """What the run says, as a dictionary: fault (text, "" if none), message, impulse, ..."""
        self.write(folder)
        begin = time.monotonic()
        record = {"number": self.number, "impact": self.impact.number, "name": self.name(), "fault": "", "message": ""}
        run = subprocess.run(["prlimit", f"--cpu={TIME_LIMIT}:{TIME_LIMIT + 5}", carom, "run", "case.toml", "--out", "out",
                              "--quiet", "--threads", "1"], cwd=folder, text=True, capture_output=True, check=False)
        record |= {"wall": time.monotonic() - begin, "code": run.returncode}
        if run.returncode == -signal.SIGXCPU:
            return record | {"fault": f"over {TIME_LIMIT} s of processor time"}
        summary_file = folder / "out" / "summary.json"
        if not summary_file.exists():
            return record | {"fault": "refused" if run.returncode == 2 else "no summary",
                             "message": (run.stdout + run.stderr).strip()}
        summary = json.loads(summary_file.read_text(encoding="utf-8"))
        record |= {"message": summary["message"], "steps": summary["scheme"]["steps"],
                   "refused": [item["name"] for item in summary["verdict"] if not item["pass"]]}
        if run.returncode == 3:
            return record | {"fault": "stopped"}
        return record | self.measure(folder / "out", summary)

    def measure(self, out, summary):
        impact, (length, mass) = self.impact, UNITS[self.impact.units]
        contact, energy = read_csv(out / "contact.csv"), read_csv(out / "energy.csv")
        impulse = [contact[f"touch.impulse_{c}"][-1] / (mass * length) for c in "xyz"]
        axis = product(impact.turn, [0.0, 0.0, 1.0])
        sign = 1.0 if impact.ratio >= 1.0 else -1.0  # the force is the slave's
        found = {"impulse": sign * sum(a * b for a, b in zip(axis, impulse)),
                 "momentum": summary["linear_momentum"]["error"]}
        found["gain"] = gained(energy, self.scheme)
        found["overlap"] = self.deepest(out, length) / min(impact.upper.cell, impact.lower.cell)
        faults = []
        if summary["outcome"] != "good":
            faults.append("verdict: " + ", ".join(i["name"] for i in summary["verdict"] if not i["pass"]))
        if not found["momentum"] <= 1e-9:
            faults.append("momentum")
        if not found["gain"] <= 5e-3:
            faults.append("gain")
        if not found["overlap"] <= DEPTH_LIMIT:
            faults.append("overlap")
        return found | {"fault": "; ".join(faults)}

    def deepest(self, out, length):
        """Deepest node of either skin inside of the other body, over the end and each tenth frame before it."""
        frames = sorted((out / "fields").glob("*.vtu"))
        upper, lower = self.impact.upper, self.impact.lower
        reference = read_field(frames[0], "Points")
        at = {tuple(reference[3 * i:3 * i + 3]): i for i in range(len(reference) // 3)}
        order = [at[tuple(x * length for x in p)] for p in upper.nodes + lower.nodes]
        deepest = 0.0
        for frame in frames[::-10]:
            u = permuted(read_field(frame, "displacement"), order, length)
            x = [[p[c] + u[3 * i + c] for c in range(3)] for i, p in enumerate(upper.nodes + lower.nodes)]
            sides = (x[:len(upper.nodes)], upper), (x[len(upper.nodes):], lower)
            deepest = max(deepest, depth(*sides[0], *sides[1]), depth(*sides[1], *sides[0]))
        return deepest


def gained(energy, scheme):
    """Energy gained at the end (mean of the last tenth) or, what explicit schemes lend left out, at any time, over the
    initial kinetic energy."""
    lost = [a + q + min(0.0, i) for a, q, i in zip(energy["algorithmic"], energy["quadrature"], energy["impact"])]
    tail = lost[-max(1, len(lost) // 10):]
    kept = [q + min(0.0, i) for q, i in zip(energy["quadrature"], energy["impact"])] if scheme in EXPLICIT else lost
    return max(-statistics.fmean(tail), -min(kept)) / max(energy["kinetic"][0], 1e-300)


# ----------------------------------------------------------------------------------------------------- inside or not
def depth(points, body, corners, other):
    """Deepest node of the skin of a body inside of the other one: distance from its nearest facet's plane triangles."""
    low = [min(p[c] for p in corners) for c in range(3)]
    high = [max(p[c] for p in corners) for c in range(3)]
    deepest = 0.0
    for i in sorted({n for face in body.skin for n in face}):
        x = points[i]
        if any(x[c] < low[c] or x[c] > high[c] for c in range(3)):
            continue
        if any(is_inside(x, [corners[n] for n in cell]) for cell in other.cells):
            deepest = max(deepest, min(distance(x, [corners[n] for n in face]) for face in other.skin))
    return deepest


def is_inside(x, corner):
    """By Newton's method on the trilinear map; where that does not converge, x is far from the cell."""
    if any(x[c] < min(p[c] for p in corner) or x[c] > max(p[c] for p in corner) for c in range(3)):
        return False
    xi = [0.0, 0.0, 0.0]
    signs = ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1))
    for _ in range(12):
        residual, J = list(x), [[0.0] * 3 for _ in range(3)]
        for p, s in zip(corner, signs):
            f = [1.0 + s[c] * xi[c] for c in range(3)]
            N = 0.125 * f[0] * f[1] * f[2]
            for c in range(3):
                residual[c] -= N * p[c]
                J[c][0] += 0.125 * s[0] * f[1] * f[2] * p[c]
                J[c][1] += 0.125 * s[1] * f[0] * f[2] * p[c]
                J[c][2] += 0.125 * s[2] * f[0] * f[1] * p[c]
        columns = [[J[r][c] for r in range(3)] for c in range(3)]
        det = dot(columns[0], cross(columns[1], columns[2]))
        if det == 0.0:
            return False
        change = [dot(residual, cross(columns[1], columns[2])) / det, dot(columns[0], cross(residual, columns[2])) / det,
                  dot(columns[0], cross(columns[1], residual)) / det]
        xi = [a + b for a, b in zip(xi, change)]
        if max(map(abs, xi)) > 5.0:
            return False
    return max(map(abs, xi)) < 1.0 and max(map(abs, change)) < 1e-6


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def distance(x, quad):
    return min(to_triangle(x, quad[0], quad[1], quad[2]), to_triangle(x, quad[0], quad[2], quad[3]))


def to_triangle(p, a, b, c):
    """Distance of a point from a triangle (Ericson, Real-Time Collision Detection, 2005, section 5.1.5)."""
    ab, ac, ap = ([q[i] - a[i] for i in range(3)] for q in (b, c, p))
    d_1, d_2 = dot(ab, ap), dot(ac, ap)
    if d_1 <= 0.0 and d_2 <= 0.0:
        return math.dist(p, a)
    bp = [p[i] - b[i] for i in range(3)]
    d_3, d_4 = dot(ab, bp), dot(ac, bp)
    if d_3 >= 0.0 and d_4 <= d_3:
        return math.dist(p, b)
    cp = [p[i] - c[i] for i in range(3)]
    d_5, d_6 = dot(ab, cp), dot(ac, cp)
    if d_6 >= 0.0 and d_5 <= d_6:
        return math.dist(p, c)
    v_c, v_b, v_a = d_1 * d_4 - d_3 * d_2, d_5 * d_2 - d_1 * d_6, d_3 * d_6 - d_5 * d_4
    if v_c <= 0.0 <= d_1 and d_3 <= 0.0:
        return math.dist(p, [a[i] + ab[i] * d_1 / (d_1 - d_3) for i in range(3)])
    if v_b <= 0.0 <= d_2 and d_6 <= 0.0:
        return math.dist(p, [a[i] + ac[i] * d_2 / (d_2 - d_6) for i in range(3)])
    if v_a <= 0.0 and d_4 - d_3 >= 0.0 and d_5 - d_6 >= 0.0:
        t = (d_4 - d_3) / ((d_4 - d_3) + (d_5 - d_6))
        return math.dist(p, [b[i] + t * (c[i] - b[i]) for i in range(3)])
    s = v_a + v_b + v_c
    return math.dist(p, [a[i] + ab[i] * v_b / s + ac[i] * v_c / s for i in range(3)])


# --------------------------------------------------------------------------------------------------------- the trial
def variants(seed):
    """All variants in order: each impact with DRAWS draws from a deck that holds every combination twice."""
    decks = {}
    for friction in (False, True):
        deck = [c + (m,) for c in COMBINATIONS for m in METHODS] * 2
        random.Random(f"{seed} deck {friction}").shuffle(deck)
        decks[friction] = iter(deck)
    out = []
    for i in range(IMPACTS):
        friction = (i + i // 4) % 2 == 1
        impact = Impact(i, friction, seed)
        out += [Variant(DRAWS * i + k, impact, *next(decks[friction])) for k in range(DRAWS)]
    return out


def judge_impulses(records, impacts):
    """Adds the faults of impulses: against the exact value, or the median of what ended good."""
    for impact in impacts.values():
        own = [r for r in records if r["impact"] == impact.number and "impulse" in r]
        exact = getattr(impact, "exact", None)
        good = [r["impulse"] for r in own if not r["fault"]] or [r["impulse"] for r in own]
        if not good:
            continue
        reference, tolerance = (exact, 0.03) if exact else (statistics.median(good), 0.05)
        for r in own:
            r["error"] = r["impulse"] / reference - 1.0
            if not abs(r["error"]) <= tolerance:
                r["fault"] = "; ".join(filter(None, [r["fault"], "impulse"]))


def line(r):
    figures = " ".join(f"{key} {r[key]:.2g}" for key in ("error", "gain", "momentum", "overlap") if key in r)
    return f"{r['number']:4} {r['impact']:3} {r['name']:58} {r.get('steps', 0):6} {r.get('wall', 0.0):6.1f} s  {figures}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("carom", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--small", action="store_true", help="every twentieth variant, and those that once failed")
    parser.add_argument("--only", help="numbers of variants, or of impacts as i3, separated by commas")
    parser.add_argument("--keep", type=pathlib.Path, help="keep decks and results here")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--seed", type=int, default=SEED)
    given = parser.parse_args()
    chosen = variants(given.seed)
    if given.only:
        wanted = given.only.split(",")
        chosen = [v for v in chosen if str(v.number) in wanted or f"i{v.impact.number}" in wanted]
    elif given.small:
        chosen = [v for v in chosen if v.number % 20 == 0 or v.number in ONCE_WRONG]
    begin = time.monotonic()
    folder = given.keep or pathlib.Path(tempfile.mkdtemp())
    try:
        records = run_all(given.carom, folder, chosen, given.jobs)
    finally:
        if not given.keep:
            shutil.rmtree(folder)
    judge_impulses(records, {v.impact.number: v.impact for v in chosen})
    bad = report(records, {v.impact.number: v.impact for v in chosen})
    if given.keep:
        (given.keep / "records.json").write_text(json.dumps(records, indent=1), encoding="utf-8")
    print(f"{len(records) - bad} right of {len(records)}; {time.monotonic() - begin:.0f} s")
    return 1 if bad > len(records) // 100 else 0


def run_all(carom, folder, chosen, jobs):
    records = []
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for r in pool.map(lambda v: v.run(carom, folder / str(v.number)), chosen):
            records.append(r)
            print(line(r), r["fault"], flush=True)
    return records


def report(records, impacts):
    """Prints what is wrong, impact by impact; returns the number of wrong runs."""
    bad = [r for r in records if r["fault"]]
    print("\nwrong:")
    for number, own in itertools.groupby(bad, key=lambda r: r["impact"]):
        print(f"impact {number}: {impacts[number].describe()}")
        for r in own:
            print(f"{line(r)}\n       {r['fault']}: {r['message'][:300]}")
    return len(bad)


if __name__ == "__main__":
    sys.exit(main())
