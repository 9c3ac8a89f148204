#!/usr/bin/env python3
"""Halves and quarters of symmetric impacts against the whole, drawn from a seed: the same contact force.

    python3 symmetry_trial.py build/release/carom               60 impacts, each whole, as a half and as a quarter
    python3 symmetry_trial.py build/release/carom --small       eight of them
    python3 symmetry_trial.py build/release/carom --only 17     these alone; --only 0-9: a range
    python3 symmetry_trial.py build/release/carom --seed 31337  60 others
    python3 symmetry_trial.py build/release/carom --keep DIR    keeps decks and results

Two bodies that are symmetric about two planes: boxes, plates, balls, rollers along either axis, keels (ridges below). The lower
one rests, the upper one falls on it or, in statics, is pressed on it. Drawn are sizes, laws, types of cells, friction,
units and where the planes are; schemes and kinds of contact come by turns; nothing else is said. Of a half the nodes
in the plane are held across it ([[support]] symmetry), and nothing is said of contact there.

The energy of contact of the whole is twice that of a half (src/contact/mirror_images.hpp), so the force over time is twice
its own, up to the rounding of the explicit step, and else to what ends the iterations: LIMIT of the largest force. They are
compared as long as they take the same steps and are symmetric, the half about the other plane: a node that comes to an
edge between two facets settles behind one of them, and then bodies get forces along x or y. Where the whole is not
symmetric from the touch on, or finds no equilibrium, nothing is compared; a fifth of them at most may be such.
"""

import argparse
import contextlib
import csv
import io
import itertools
import math
import pathlib
import random
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "tools"))
import gmsh_file as gmsh  # noqa: E402
from ball_on_plate import ball_nodes, grid_cells  # noqa: E402

SEED = 20261127
VARIANTS = 60
SMALL = range(0, VARIANTS, 8)
SCHEMES = ("central_differences", "newmark", "cd_lagrange", "statics", "hulbert_chung", "hht")
KINDS = ("all", "pair")
EXPLICIT = ("central_differences", "hulbert_chung", "cd_lagrange")
LIMIT = {"central_differences": 1e-9, "hulbert_chung": 1e-9, "cd_lagrange": 1e-4, "newmark": 1e-6, "hht": 1e-6,
         "statics": 1e-3}
# In statics, whose steps are long, a quarter may settle otherwise where that is not seen from outside.
SYMMETRIC = 1e-7  # of the largest force: what is along x and y
E, RHO = 1e5, 1e-3


def box(a, b, c):
    n = [max(2, 2 * round(2 * x)) for x in (a, b, c)]
    return n, lambda i, j, k: (a * (i / n[0] - 0.5), b * (j / n[1] - 0.5), c * (k / n[2] - 0.5))


def ball(radius):
    nodes = ball_nodes(6)
    return [6, 6, 6], lambda i, j, k: tuple(radius * x for x in nodes[(i, j, k)])


def roller(radius, length):
    """Along x; squares of equal angles, rounder outwards."""
    def position(i, j, k):
        p = [math.tan(0.25 * math.pi * (2 * t / 6 - 1)) for t in (j, k)]
        size, far = max(map(abs, p)), math.hypot(*p)
        stretch = (1 - size) / 1.3 + size * size / far if far > 0.0 else 0.0
        return (length * (i / 6 - 0.5), radius * p[0] * stretch, radius * p[1] * stretch)
    return [6, 6, 6], position


def keel(width, length, height):
    """A slab bent along x, its ridge below."""
    return [6, 6, 2], lambda i, j, k: (length * (i / 6 - 0.5), width * (j / 6 - 0.5),
                                       height * k / 2 + 0.6 * width * abs(j / 6 - 0.5))


def turned(body):
    n, position = body

    def turn(i, j, k):
        x, y, z = position(j, n[1] - i, k)
        return (-y, x, z)
    return [n[1], n[0], n[2]], turn


def draw_body(draw, shape):
    a, b, c = (draw.uniform(0.7, 1.3) for _ in range(3))
    return {"box": lambda: box(a, b, 0.6 * c), "plate": lambda: box(2 * a, 2 * b, 0.5), "ball": lambda: ball(0.5 * a),
            "roller": lambda: roller(0.5 * a, b), "roller across": lambda: turned(roller(0.5 * a, b)),
            "keel": lambda: keel(a, b, 0.4 * c), "keel across": lambda: turned(keel(a, b, 0.4 * c))}[shape]()


class Impact:
    """One of them, whole or cut."""

    def __init__(self, seed, number):
        draw = random.Random(f"{seed} {number}")
        self.scheme, self.kind = SCHEMES[number % len(SCHEMES)], KINDS[number // len(SCHEMES) % len(KINDS)]
        self.presses = self.scheme == "statics"
        # A ridge on a ridge meets node on node, where edges of the whole itself are chosen by their numbers.
        lower = draw.choice(("plate", "box", "ball", "roller"))
        upper = draw.choice(("box",) if self.presses else ("box", "ball", "roller", "roller across", "keel", "keel across"))
        self.name = f"{number}: {self.scheme}, {self.kind}, {upper} on {lower}"
        self.bodies = [draw_body(draw, lower), draw_body(draw, upper)]
        self.law = "linear_elastic" if self.presses else draw.choice(("linear_elastic", "neo_hookean"))
        self.cells = draw.choice((gmsh.HEXA8, gmsh.HEXA20)) if self.scheme in EXPLICIT else gmsh.HEXA8
        self.friction = draw.choice((0.0, 0.0, 0.3))
        self.speed = draw.uniform(10.0, 60.0)
        self.length = draw.choice((1.0, 1e-3))  # of a unit of the sizes
        self.origin = [draw.choice((0.0, 7.0)), draw.choice((0.0, -3.0)), 0.0]
        self.side = [draw.choice((1, -1)), draw.choice((1, -1))]

    def deck(self, folder, cuts):
        """cuts: how many of the planes x = origin and y = origin cut it."""
        mesh = gmsh.GmshFile(digits=1e-9 * self.length)
        held = [set() for _ in range(2)]
        pressed = {"FOOT": set(), "HEAD": set()}
        low = [[f(p) for f in (min, max)] for p in ([z for *_, z in self.points(b)] for b in range(2))]
        rise = low[0][1] - low[1][0] + 2e-4
        for b, (n, position) in enumerate(self.bodies):
            for corners in grid_cells(n):
                x = [position(*key) for key in corners]
                if any(min(self.side[d] * p[d] for p in x) < -1e-9 for d in range(cuts)):
                    continue
                nodes = [mesh.node([self.length * (o + v) for o, v in zip(self.origin, (p[0], p[1], p[2] + rise * b))],
                                   str(b)) for p in x]
                mesh.add(self.cells, f"B{b}", nodes)
        ids = {}
        for kind, group, nodes in list(mesh.cells):
            for node in nodes:
                ids[node] = int(group[1])
        for node, b in ids.items():
            x = [v / self.length - o for v, o in zip(mesh.nodes[node - 1], self.origin)]
            for d in range(cuts):
                if abs(x[d]) < 1e-7:
                    held[d].add(node)
            if b == 0 and x[2] < low[0][0] + 1e-7:
                pressed["FOOT"].add(node)
            if b == 1 and x[2] > low[1][1] + rise - 1e-7:
                pressed["HEAD"].add(node)
        groups = {f"CUT{d}": held[d] for d in range(cuts)} | (pressed if self.presses else {})
        for name, nodes in groups.items():
            for node in sorted(nodes):
                mesh.cells.append((gmsh.POINT, name, [node]))
        folder.mkdir(parents=True, exist_ok=True)
        with contextlib.redirect_stdout(io.StringIO()):
            mesh.write(str(folder / "bodies.msh"))
        size, speed = self.length, math.sqrt(E / RHO)
        text = f'title = "{self.name}, {cuts} cuts"\n[mesh]\nfile = "bodies.msh"\n[materials.M]\nlaw = "{self.law}"\n'
        text += f"E = {E}\nnu = 0.3\nrho = {RHO}\n"
        for b in range(2):
            text += f'[[part]]\nname = "B{b}"\ncells = "B{b}"\nmaterial = "M"\n'
        for d in range(cuts):
            text += f'[[support]]\nnodes = "CUT{d}"\nsymmetry = "{"xy"[d]}"\n'
        if self.presses:
            text += '[[support]]\nnodes = "FOOT"\nblocked = ["x", "y", "z"]\n'
            text += f'[[support]]\nnodes = "HEAD"\nblocked = ["x", "y"]\ndisplacement = {{ z = {-0.02 * size}, function = "ramp" }}\n'
            text += '[functions.ramp]\ntime = [0.0, 1.0]\nvalue = [0.0, 1.0]\n'
        else:
            text += f'[[initial]]\npart = "B1"\nvelocity = [0.0, 0.0, {-self.speed}]\n'
        sides = 'kind = "all"' if self.kind == "all" else 'kind = "pair"\ngroup = "B1"\nmaster = "B0"'
        text += f'[[contact]]\nname = "touch"\n{sides}\nfriction = {self.friction}\n[scheme]\nkind = "{self.scheme}"\n'
        if self.presses:
            text += 'enforcement = "penalty"\n[time]\nend = 1.0\nstep = 0.25\n'
        else:
            step = (0.02 if self.scheme in ("newmark", "hht") else 0.005) * size / speed
            if self.cells == gmsh.HEXA20:
                step *= 0.5
            text += f"[time]\nend = {200 * step}\nstep = {step}\n"
        text += "[output]\nfields = []\n"
        (folder / "case.toml").write_text(text, encoding="utf-8")

    def points(self, b):
        n, position = self.bodies[b]
        return [position(*key) for key in itertools.product(*(range(m + 1) for m in n))]


def forces(folder):
    """Of touch along x, y and z, with the time."""
    with (folder / "out/contact.csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    column = next(i for i, name in enumerate(rows[0]) if name.endswith("force_x"))
    return [(float(row[0]), [float(v) for v in row[column:column + 3]]) for row in rows[1:]]


def run(carom, folder):
    done = subprocess.run([carom, "run", "case.toml", "--out", "out", "--threads", "1", "--quiet"], cwd=folder,
                          capture_output=True, text=True, check=False)
    return done.returncode, (done.stderr.strip().splitlines() or [""])[-1]


def judge(carom, folder, impact):
    """What is WRONG, or why nothing is compared; "" where all is right."""
    found = []
    for cuts in range(3):
        impact.deck(folder / str(cuts), cuts)
        found.append(run(carom, folder / str(cuts)))
    if found[0][0] not in (0, 1):
        return f"not compared, since the whole ends with {found[0][0]}"
    if any(code not in (0, 1) for code, _ in found):
        return f"WRONG, exit codes {[code for code, _ in found]}: {next(text for code, text in found if code not in (0, 1))}"
    whole = forces(folder / "0")
    largest = max(abs(force[2]) for _, force in whole)
    if not largest > 0.0:
        return "WRONG, no force"
    for cuts in (1, 2):
        pairs = list(itertools.takewhile(
            lambda pair, cuts=cuts: pair[0][0] == pair[1][0] and all(
                abs(v) < SYMMETRIC * largest for v in pair[0][1][:2] + pair[1][1][cuts:2]),
            zip(whole, forces(folder / str(cuts)))))
        if not any(of_whole[2] for (_, of_whole), _ in pairs):
            return "not compared, since it is not symmetric from the touch on"
        off = max(abs(of_whole[2] - 2**cuts * of_part[2]) for (_, of_whole), (_, of_part) in pairs) / largest
        if not off < LIMIT[impact.scheme]:
            return f"WRONG, {cuts} cuts: the force is off by {off:.2g} of the largest, at most {LIMIT[impact.scheme]:g}"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("carom", type=pathlib.Path)
    parser.add_argument("--small", action="store_true", help="eight of them")
    parser.add_argument("--only", help="numbers or ranges of variants, separated by commas")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--keep", type=pathlib.Path, help="keep decks and results here")
    options = parser.parse_args()
    numbers = SMALL if options.small else range(VARIANTS)
    if options.only:
        numbers = [n for part in options.only.split(",") for n in range(int(part.split("-")[0]), int(part.split("-")[-1]) + 1)]
    wrong = skipped = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or pathlib.Path(scratch)
        for number in numbers:
            impact = Impact(options.seed, number)
            why = judge(options.carom.resolve(), folder / str(number), impact)
            print(f"{impact.name}: {why or 'right'}", flush=True)
            wrong += why.startswith("WRONG")
            skipped += why.startswith("not")
    print(f"{len(numbers) - wrong - skipped} of {len(numbers)} right, {skipped} not compared")
    return 1 if wrong or skipped > 0.2 * len(numbers) else 0


if __name__ == "__main__":
    sys.exit(main())
