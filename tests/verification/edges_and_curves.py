#!/usr/bin/env python3
"""Edges and curves with default settings: bars that cross, boxes that tumble into a bin, a break of 16 balls, a ball
that rolls in a groove, balls that meet obliquely with friction.

    python3 edges_and_curves.py build/release/carom                 all, some ten minutes
    python3 edges_and_curves.py build/release/carom --small         some of them, some ten seconds
    python3 edges_and_curves.py build/release/carom --only bin,maw  these alone; --keep DIR keeps decks and results

The decks name bodies, materials, contacts with their friction, a scheme and the end, and for implicit schemes the
step; nothing else. All that is judged are recorded nodes (scene.py) and forces of contact.csv. Every run must end
good and gain less than 0.5 % of energy (impact_trial.py); momenta of bodies that nothing holds keep to 1e-11 of what
flies.

flat     Two bars of 60 x 10 x 10 mm cross, flat on flat, 20 m/s. Impulse: that of 48 x 8 x 8 cells (0.1274 N s,
         cases/edges/crossed_flat_faces.toml), within 5 %.
rolled   The same turned about their axes by 45 degrees, edge on edge, 5 m/s, at right angles and askew, off their
         middles. The impulse is along the cross product of the edges, z, within 2 degrees from the first touch on,
         which comes at 2 us. Its size: that of 27 x 9 x 9 cells (0.0354 N s, cases/edges/crossed_*.toml), 5 %; by
         impulses, which take the motion of the nodes that meet, 12 %.
bin      Boxes fall into a bin of five planes, tumble and come to rest. Momentum: that of gravity and of the planes'
         forces, 1e-9. Work of gravity: the way of the centres, 1e-9. At rest: kinetic energy below 1e-3 of what was
         there and came in. No node outside of the bin and no two surfaces in each other by more than a quarter of a
         cell.
break    15 balls of coarse tetrahedra, R / h = 3, in a triangle, 20 um apart, and one that hits them at a hundredth of
         the bar wave's speed. Out of the plane: below 2.5 % of that speed; the ball in front bears impulses of 2.7
         times what comes in, and between two such balls these are up to 1.8 % off the line of centres. In the plane:
         balls on Hertz's springs, integrated here, 5 %.
groove   A ball rolls through a groove of three times its radius to the other side, gravity growing from nothing.
         Angle: that of a rigid ball that rolls, 5/7 of a pendulum's acceleration, within 1 degree of 25 (it sinks in by
         2 % of its radius, and rolls more slowly by that); along the groove: 2 % of its radius. The verdict's overlap
         does not count: it takes what is 0.02 of a cell deep, by surface_crossing.py, for 0.3.
maw      Two equal balls (halves, cut along the plane of motion) meet obliquely with friction. Rebound of the
         tangential motion over its approach, psi_2 of psi_1, from the balls' spin, against Maw, Barber and Fawcett,
         The oblique impact of elastic spheres, Wear 38 (1976) 101, by the method of dimensionality reduction
         (Lyashenko and Popov, Scientific Reports 5 (2015) 8479), for a line of centres that turns: 6 % of the
         tangential impulse of balls that slide throughout. By default the springs of contact are as stiff as a layer
         of one mean cell of the skin, tangentially too, which is felt where the balls stick.
Needs numpy.
"""

import argparse
import math
import pathlib
import random
import shutil
import sys
import tempfile
import time

import numpy as np

from impact_trial import DEPTH_LIMIT, gained, rotation
from scene import Scene
from shape_bodies import ball, box, grid

NU = 0.3


def turned(axis, angle):
    return np.array(rotation(axis, angle))


def material(law, E, rho):
    return {"law": law, "E": E, "nu": NU, "rho": rho}


class Judge:
    """Runs, prints what was measured, and counts what is wrong."""

    def __init__(self, carom, folder):
        self.carom, self.folder, self.wrong = carom, folder, 0

    def run(self, name, scene, scheme, step=None, judged_here=()):
        """judged_here: items of the verdict that do not count."""
        begin = time.monotonic()
        more = "" if step is None else f"\nstep = {step!r}"
        record = scene.run(self.carom, self.folder / name, f'kind = "{scheme}"', more)
        steps = record.summary["scheme"]["steps"]
        print(f"{name}, {scheme}: {steps} steps, {time.monotonic() - begin:.0f} s", flush=True)
        if record.code != 0:
            print("    " + record.summary["message"])
        is_good = record.code == 0 or (record.code == 1 and not set(record.refused) - set(judged_here))
        self.limit("exit code", 0 if is_good else record.code, 0)
        kinetic = max(record.energy["kinetic"])
        self.limit("energy gained", gained(record.energy | {"kinetic": [kinetic]}, scheme), 5e-3)
        return record

    def limit(self, what, value, most):
        is_right = value <= most
        self.wrong += not is_right
        print(f"    {what:42} {value:9.2g}, at most {most:g}{'' if is_right else '  WRONG'}", flush=True)

    def momentum(self, record):
        bodies, p = record.scene.bodies, record.momentum()
        scale = max(b.mass.sum() * np.linalg.norm(v) for b, (v, _) in zip(bodies, record.scene.motion))
        self.limit("change of momentum, of what flies", np.abs(p - p[0]).max() / scale, 1e-11)

    def depth(self, record, frames):
        self.limit("surfaces in each other, in cells", record.depths(frames)[0], DEPTH_LIMIT)


def everything(name, friction=0.0):
    return f'[[contact]]\nname = "{name}"\nkind = "all"' + (f"\nfriction = {friction}" if friction else "")


FIELDS = '[output]\nfields = ["displacement", "velocity"]'


# ------------------------------------------------------------------------------------------------------ bars that cross
def crossed_bars(divisions, roll, law, speed, end, angle=0.5 * math.pi, aside=(0.0, 0.0)):
    scene = Scene("Crossed bars", end)
    high = 0.01 * (math.sqrt(2.0) if roll else 1.0) + 1e-5
    for i in range(2):
        bar = box((0.06, 0.01, 0.01), divisions)
        turn = turned((1, 0, 0), 0.25 * math.pi) if roll else np.eye(3)
        if i:
            turn = turned((0, 0, 1), angle) @ turn
        bar.nodes = bar.nodes @ turn.T + (np.array([*aside, high]) if i else 0.0)
        scene.add(bar, material(law, 2.1e9, 1200.0), (0.0, 0.0, -speed if i else 0.0))
    scene.text += [everything("bars"), FIELDS]
    return scene


def flat(judge, small):
    for scheme, step in (("central_differences", None), ("cd_lagrange", None))[:1 if small else 2]:
        scene = crossed_bars((24, 4, 4), False, "st_venant_kirchhoff", 20.0, 5e-4)
        record = judge.run("flat_" + scheme, scene, scheme, step)
        judge.momentum(record)
        impulse = -scene.bodies[0].mass.sum() * record.velocity(0)[-1][2]
        judge.limit("impulse over that of fine cells, less 1", abs(impulse / 0.1274 - 1.0), 0.05)
        judge.depth(record, range(0, len(record.x), 5))


def rolled(judge, small):
    places = (("square", 0.5 * math.pi, (0.0, 0.0)), ("askew", 0.9, (0.0013, 0.0007)))
    for scheme, step, most in (("central_differences", None, 0.05), ("cd_lagrange", None, 0.12), ("hht", 2e-6, 0.05)):
        for name, angle, aside in places[small:]:
            scene = crossed_bars((9, 3, 3), True, "neo_hookean", 5.0, 4e-4, angle, aside)
            record = judge.run(f"rolled_{name}_{scheme}", scene, scheme, step)
            judge.momentum(record)
            impulse = np.array([record.contact["bars.B1_on_B0.impulse_" + c] for c in "xyz"]).T
            size = np.linalg.norm(impulse, axis=1)
            is_felt = size > 0.0
            first = np.array(record.contact["time"])[is_felt].min(initial=math.inf)
            judge.limit("first force, in times of the first touch", first / 2e-6, 2.0)
            tilt = np.degrees(np.arccos(np.clip(-impulse[is_felt, 2] / size[is_felt], -1.0, 1.0)))
            judge.limit("impulse off z, in degrees", tilt.max(initial=0.0), 2.0)
            seen = -scene.bodies[0].mass.sum() * record.velocity(0)[-1][2]
            judge.limit("impulse over that of fine cells, less 1", abs(seen / 0.0354 - 1.0), most)
            judge.depth(record, range(0, len(record.x), 5))


# ------------------------------------------------------------------------------------------------------- boxes in a bin
GRAVITY, FRICTION = 9.81, 0.4
WALLS = {"floor": ((0, 0, 0), (0, 0, 1)), "west": ((-0.045, 0, 0), (1, 0, 0)), "east": ((0.045, 0, 0), (-1, 0, 0)),
         "south": ((0, -0.045, 0), (0, 1, 0)), "north": ((0, 0.045, 0), (0, -1, 0))}


def boxes_over_a_bin(count, end, draw):
    scene = Scene(f"{count} boxes tumble into a bin", end)
    for i in range(count):
        layer, at = divmod(i, 4)
        body = box([0.02 * draw.uniform(0.8, 1.2) for _ in range(3)], (2, 2, 2))
        turn = turned([draw.gauss(0.0, 1.0) for _ in range(3)], draw.uniform(0.0, math.pi))
        centre = [(at % 2 - 0.5) * 0.045 + draw.uniform(-0.003, 0.003),
                  (at // 2 - 0.5) * 0.045 + draw.uniform(-0.003, 0.003), 0.025 + 0.042 * layer]
        body.nodes = body.nodes @ turn.T + centre
        velocity = (draw.uniform(-0.2, 0.2), draw.uniform(-0.2, 0.2), -1.0)
        spin = [draw.gauss(0.0, 10.0) for _ in range(3)]
        scene.add(body, material("neo_hookean", 2.0e6, 1000.0), velocity, spin)
        scene.group("SKIN", body, body.facets())
    scene.text += [f"[[load]]\ngravity = [0.0, 0.0, {-GRAVITY}]", everything("boxes", FRICTION), FIELDS]
    for name, (point, normal) in WALLS.items():
        scene.text.append(f'[[contact]]\nname = "{name}"\nkind = "plane"\ngroup = "SKIN"\nfriction = {FRICTION}\n'
                          f"point = {list(map(float, point))}\nnormal = {list(map(float, normal))}")
    return scene


def bin_of_boxes(judge, small):
    count, end = (8, 0.1) if small else (30, 0.9)
    scene = boxes_over_a_bin(count, end, random.Random(1))
    record = judge.run("bin", scene, "central_differences")
    mass = np.concatenate([b.mass for b in scene.bodies])
    rows = np.searchsorted(record.contact["time"], record.times)
    pushed = sum(np.array([record.contact[f"{wall}.impulse_{c}"] for c in "xyz"]).T[rows] for wall in WALLS)
    due = record.momentum()[0] + pushed - np.outer(record.times, [0.0, 0.0, GRAVITY * mass.sum()])
    scale = mass.sum() * math.sqrt(2.0 * GRAVITY * 0.3 + 1.0)
    judge.limit("momentum off gravity's and the planes'", np.abs(record.momentum() - due).max() / scale, 1e-9)
    fallen = GRAVITY * (mass @ (record.x[0] - record.x[-1])[:, 2])
    supplied = record.kinetic()[0] + fallen
    work = record.energy["external_work"][-1]
    judge.limit("work of gravity off the way of the centres", abs(work / fallen - 1.0), 1e-9)
    if not small:
        judge.limit("kinetic energy at the end, of all", record.kinetic()[-1] / supplied, 1e-3)
    cell = min(b.cell_size for b in scene.bodies)
    outside = max(max((np.array(point) - x) @ normal) for x in record.x for point, normal in WALLS.values())
    judge.limit("nodes outside of the bin, in cells", outside / cell, DEPTH_LIMIT)
    judge.depth(record, range(0, len(record.x), 5))


# -------------------------------------------------------------------------------------------------------------- a break
def ball_of_tetrahedra(radius, n, seed):
    draw = random.Random(seed)
    body = ball(radius, n)
    body.nodes = body.nodes @ turned([draw.gauss(0.0, 1.0) for _ in range(3)], draw.uniform(0.0, math.pi)).T
    return body.of_type("TETRA4")


def hertz_balls(x, v, mass, radius, modulus, end):
    """Velocities after: balls of this radius with Hertz's force 4/3 E* sqrt(R*) d^(3/2) between each two."""
    x, v = np.array(x), np.array(v)
    stiffness, h = 4.0 / 3.0 * modulus / (2.0 * (1.0 - NU**2)) * math.sqrt(0.5 * radius), end / 20000.0
    for _ in range(20000):
        x = x + h * v
        way = x[:, None] - x[None]
        distance = np.linalg.norm(way, axis=2) + 10.0 * radius * np.eye(len(x))
        force = stiffness * np.maximum(0.0, 2.0 * radius - distance)**1.5
        v = v + h / mass * (force[..., None] * way / distance[..., None]).sum(axis=1)
    return v


def break_of_balls(judge, small):
    radius, E, rho, n, end = 0.01, 7.0e8, 2700.0, 6, 1.0e-3
    speed, apart = 0.01 * math.sqrt(E / rho), 2.0 * radius + 2e-5
    places = [(row * apart * math.sqrt(0.75), (j - 0.5 * row) * apart, 0.0)
              for row in range(2 if small else 5) for j in range(row + 1)] + [(-apart, 0.0, 0.0)]
    scene = Scene("A break of balls", end)
    for k, place in enumerate(places):
        body = ball_of_tetrahedra(radius, n, k)
        body.nodes = body.nodes + place
        scene.add(body, material("st_venant_kirchhoff", E, rho), (speed if place[0] < 0.0 else 0.0, 0.0, 0.0))
    scene.text += [everything("balls"), FIELDS]
    record = judge.run("break", scene, "central_differences")
    judge.momentum(record)
    found = np.array([record.velocity(i)[-1] for i in range(len(places))]) / speed
    judge.limit("out of the plane, of the speed", np.abs(found[:, 2]).max(), 0.025)
    due = hertz_balls(places, [v for v, _ in scene.motion], scene.bodies[0].mass.sum(), radius, E, end) / speed
    judge.limit("off balls on Hertz's springs, of the speed", np.abs(found - due).max(), 0.05)


# --------------------------------------------------------------------------------------------------- a ball in a groove
def groove_wall(radius, thick, length, half_angle, n):
    def place(i, j, k):
        phi, r = half_angle * (2.0 * j / n[1] - 1.0), radius + thick * i / n[0]
        return (length * (k / n[2] - 0.5), r * math.sin(phi), -r * math.cos(phi))
    body = grid(n, place)
    body.check()
    return body


def rolling(start, length, gravity, growth, times):
    """Angles of a ball that rolls in a groove, `length` from the groove's axis to its centre."""
    angle, rate, t, out = start, 0.0, 0.0, []
    for end in times:
        steps = max(1, math.ceil((end - t) / 1e-6))
        h = (end - t) / steps
        for _ in range(steps):
            rate -= h * 5.0 / 7.0 * gravity * min(1.0, (t + 0.5 * h) / growth) / length * math.sin(angle)
            angle += h * rate
            t += h
        out.append(angle)
    return np.array(out)


def groove(judge, _):
    radius, wide, start, gravity, growth, gap = 0.01, 0.03, math.radians(25.0), 100.0, 0.02, 1e-6
    scene = Scene("A ball rolls in a groove", 0.065)
    body = ball_of_tetrahedra(radius, 6, 3)
    length = wide - radius - gap
    body.nodes = body.nodes + length * np.array([0.0, math.sin(start), -math.cos(start)])
    scene.add(body, material("neo_hookean", 2.0e6, 1000.0))
    wall = groove_wall(wide, 0.004, 0.06, math.radians(55.0), (2, 16, 10))
    scene.add(wall, material("neo_hookean", 2.0e7, 1000.0))
    scene.group("SKIN", body, body.facets())
    distance = np.hypot(wall.nodes[:, 1], wall.nodes[:, 2])
    for name, r in (("GROOVE", wide), ("BACK", wide + 0.004)):
        scene.group(name, wall, [f for f in wall.facets() if (np.abs(distance[f] - r) < 1e-9).all()])
    scene.text += ['[[support]]\nnodes = "BACK"\nblocked = ["x", "y", "z"]',
                   f"[functions.grows]\ntime = [0.0, {growth}]\nvalue = [0.0, 1.0]",
                   f'[[load]]\ngravity = [0.0, 0.0, {-gravity}]\nfunction = "grows"',
                   '[[contact]]\nname = "groove"\nkind = "pair"\ngroup = "SKIN"\nmaster = "GROOVE"\nfriction = 0.5',
                   FIELDS]
    record = judge.run("groove", scene, "hht", 2e-4, ("overlap of bodies",))
    centre = record.centre(0)
    angle = np.arctan2(centre[:, 1], -centre[:, 2])
    due = rolling(start, length, gravity, growth, record.times)
    judge.limit("angle off that of a rolling ball, degrees", np.degrees(np.abs(angle - due)).max(), 1.0)
    judge.limit("way along the groove, in radii", np.abs(centre[:, 0] - centre[0, 0]).max() / radius, 0.02)
    judge.depth(record, range(0, len(record.x), 5))


# ----------------------------------------------------------------------------------------------- oblique, with friction
def spaced(n, finest, at_end):
    """-1 to 1 in n parts, about 0 or at -1 `finest` times as large as on the average."""
    t = np.linspace(0.0 if at_end else -1.0, 1.0, n + 1)
    return 2.0 * t * (finest + (1.0 - finest) * t) - 1.0 if at_end else t * (finest + (1.0 - finest) * t * t)


def half_ball(radius, n, finest, side):
    """y >= 0; finest at the pole on the z axis, z = -side * radius."""
    x, z = (np.tan(0.25 * math.pi * spaced(n, finest, at_end)) for at_end in (False, True))
    y = x[n // 2:]

    def place(i, j, k):
        p = np.array([x[i], y[j], z[k]])
        size, length = np.abs(p).max(), np.linalg.norm(p)
        if length > 0.0:
            p = p * ((1.0 - size) / 1.3 + size * size / length)
        return radius * p * (side, 1.0, side)
    body = grid((n, n // 2, n), place)
    body.check()
    return body


class ObliqueBalls:
    """psi_1, the normal speed of approach over the bar wave's, and the mesh: n cells across, the finest of them a part
    `finest` of the mean."""

    def __init__(self, psi, slow, n, finest):
        self.psi, self.mu, self.radius, self.E, rho = psi, 0.1, 0.01, 7.0e10, 2700.0
        self.ratio = 2.0 * (1.0 - NU) / (2.0 - NU)  # of tangential to normal stiffness
        self.normal = slow * math.sqrt(self.E / rho)
        self.along = psi * self.mu * self.normal / self.ratio
        bodies = [half_ball(self.radius, n, finest, side) for side in (-1.0, 1.0)]
        mass = rho * 4.0 / 3.0 * math.pi * self.radius**3
        self.stiffness = self.E / (2.0 * (1.0 - NU**2))
        self.depth = (15.0 / 32.0 * mass * self.normal**2 / (self.stiffness * math.sqrt(0.5 * self.radius)))**0.4
        self.time, gap = 2.9432 * self.depth / self.normal, 0.02 * self.depth
        self.contact = math.sqrt(0.5 * self.radius * self.depth)  # greatest radius of the contact, Hertz
        self.cell = self.radius * math.tan(0.25 * math.pi * spaced(n, finest, False)[n // 2 + 1])
        self.scene = Scene(f"Two balls meet obliquely, psi = {psi}", 1.2 * self.time + gap / self.normal)
        for i, (body, z) in enumerate(zip(bodies, (-self.radius, self.radius + gap))):
            body.nodes = body.nodes + (0.0, 0.0, z)
            self.scene.add(body, material("st_venant_kirchhoff", self.E, rho),
                           (self.along, 0.0, -self.normal) if i else (0.0, 0.0, 0.0))
            on_cut = [f for f in body.facets() if (np.abs(body.nodes[f, 1]) < 1e-12).all()]
            self.scene.group("CUT", body, on_cut)
            self.scene.group(f"ROUND{i}", body, [f for f in body.facets() if f not in on_cut])
        self.mass = sum(b.mass.sum() for b in bodies)  # of a whole ball
        self.scene.text += ['[[support]]\nnodes = "CUT"\nsymmetry = "y"',
                            '[[contact]]\nname = "balls"\nkind = "pair"\ngroup = "ROUND1"\nmaster = "ROUND0"\n'
                            f"friction = {self.mu}", FIELDS]

    def psi_of(self, spin):
        """psi_2, by the tangential impulse that the spin tells: psi_1 less kappa / mu times its change of motion."""
        impulse = 0.4 * self.mass * self.radius * spin
        return self.psi - self.ratio / (self.mu * self.normal) * 7.0 * impulse / self.mass

    def collide(self, is_limit=False):
        """psi_2 of elastic balls whose contact is independent springs on a line, of normal force k dx (d - x^2 / R*)
        and tangential stiffness ratio k dx, that slide at mu times the normal force; is_limit: the line of centres
        stands still."""
        R, steps, n = self.radius, 6000, 300
        x = (np.arange(n) + 0.5) * 1.02 * self.contact / n
        dx, h, shape = 2.0 * 1.02 * self.contact / n, self.time / steps, 2.0 * x * x / R
        q, u, spin, slip = np.array([0.0, 2.0 * R]), np.array([self.along, -self.normal]), 0.0, np.zeros(n)
        inertia = 0.4 * self.mass * R * R
        while True:
            q = q + h * u * ((0.0, 1.0) if is_limit else (1.0, 1.0))
            distance = np.hypot(*q)
            normal = q / distance
            along = np.array([normal[1], -normal[0]])
            if distance > 2.0 * R:
                return self.psi_of(spin)
            pressed = np.maximum(2.0 * R - distance - shape, 0.0)
            most = self.mu * pressed / self.ratio
            slip = np.clip(slip + h * (u @ along - spin * distance), -most, most)
            force = self.stiffness * dx * pressed.sum()
            friction = self.ratio * self.stiffness * dx * slip.sum()
            u = u + 2.0 / self.mass * h * (force * normal - friction * along)
            spin += h * R * friction / inertia

    def seen(self, record):
        spins = []
        for i, body in enumerate(self.scene.bodies):  # of halves: the others move as mirror images
            x, v = record.of(record.x, i)[-1], record.of(record.v, i)[-1]
            r, w = x - body.mass @ x / body.mass.sum(), v - body.mass @ v / body.mass.sum()
            spins.append((body.mass * (r[:, 2] * w[:, 0] - r[:, 0] * w[:, 2])).sum() /
                         (body.mass * (r[:, 0]**2 + r[:, 2]**2)).sum())
        return self.psi_of(np.mean(spins))


def maw(judge, small):
    """The finer the mesh and the slower the balls, the nearer to the theory."""
    for psi in ((3.0,) if small else (0.5, 1.5, 3.0, 4.5, 6.0)):
        balls = ObliqueBalls(psi, 5e-4, *((8, 0.15) if small else (12, 0.1)))
        record = judge.run(f"maw_{psi}", balls.scene, "central_differences")
        print(f"    psi_1 {psi}: psi_2 {balls.seen(record):.3f}, due {balls.collide():.3f}, in the limit "
              f"{balls.collide(True):.3f}; contact's radius over the finest cell {balls.contact / balls.cell:.2f}, "
              f"over the balls' {balls.contact / balls.radius:.3f}")
        sliding = 7.0 * balls.ratio  # psi_1 - psi_2 of balls that slide throughout, 4 chi
        off = abs(balls.seen(record) - balls.collide()) / sliding
        judge.limit("off the theory, of the impulse of sliding", off, 0.06)


SCENES = {"flat": flat, "rolled": rolled, "bin": bin_of_boxes, "break": break_of_balls, "groove": groove, "maw": maw}
SMALL = ("flat", "rolled", "bin")


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("carom", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--small", action="store_true", help="some of them")
    parser.add_argument("--only", type=lambda text: text.split(","), help="names, separated by commas")
    parser.add_argument("--keep", type=pathlib.Path, help="keep decks and results here")
    given = parser.parse_args()
    folder = given.keep or pathlib.Path(tempfile.mkdtemp())
    judge = Judge(given.carom, folder)
    try:
        for name in given.only or (SMALL if given.small else SCENES):
            SCENES[name](judge, given.small)
    finally:
        if not given.keep:
            shutil.rmtree(folder)
    print(f"{judge.wrong} wrong")
    return 1 if judge.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
