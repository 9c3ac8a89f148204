#!/usr/bin/env python3
"""600 impacts of bodies of random shape with default settings, drawn from a seed: nearly all must end good and be right.

    python3 shape_trial.py build/release/carom                 all
    python3 shape_trial.py build/release/carom --small         some twenty of them, a minute or two
    python3 shape_trial.py build/release/carom --only 17,203   these alone; --only 0-99: a range
    python3 shape_trial.py build/release/carom --keep DIR      keeps decks, results and records
    python3 shape_trial.py build/release/carom --seed 31337    600 others
    python3 shape_trial.py --self-test                         the test of crossing alone, on known configurations

Two to five bodies: boxes, rolled boxes, wedges, needles, balls, tubes, sectors of rings, L and H sections, bars. One
rests; each further one is turned so that an edge, a corner or a face of it points to an edge, a corner or a face of a
body that is there (edges on edges and corners on faces preferred), put at a small gap and thrown along that direction.
Types of cells come by turns, and so do schemes, an implicit one after each explicit one (but modified_mass, which wants
bodies of many layers); drawn are laws (those of small strains up to 1.5e-3 of the wave's speed, St. Venant and Kirchhoff's
up to 1e-2, as their strains and rotations allow; needles and bars, which turn about their axes soon, have none of small
strains; no plasticity by energy_momentum, which refuses it), stiffnesses 1 : 1 to 1 : 100, cells, speeds (1e-4 to 1e-1
of the bar wave's in the softest body), units, friction (half) and place (the origin, or 100 m from it).
The deck says [[contact]] kind = "all" and the scheme, and nothing else: method, enforcement, stiffnesses, tolerances and
masses are the defaults. Implicit steps last half as long as a wave of the slowest body needs through the finest cell,
but are at most 600 (linear) or 150. All end some travels of waves after the touch.
A run is right if
  good       it ends with exit code 0;
  momentum   linear momentum keeps to the impulses to 1e-9 of the summary's scale;
  gain       energy gained, as in impact_trial.py, is below 0.5 %;
  crossing   in no frame of the fields the surfaces of two bodies are in each other by more than a quarter of the smaller
             cell (surface_crossing.py: triangles of their skins; the program's own gap is not asked);
  impulse    with --refined, of every tenth without round bodies: the impulses of all bodies are within 5 % of the largest
             of those of the same bodies on cells half as large.
Runs that are refused, stop, crash or take more than TIME_LIMIT of processor time are wrong, each a class of its own. Runs
with more than SLOW times the steps that `carom check` foretells are listed apart, and so are depths above NOTED.
Needs numpy (Debian: python3-numpy), and prlimit of util-linux.
"""

import argparse
import collections
import copy
import json
import math
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import numpy as np

import shape_bodies
import surface_crossing
from ball_on_plate import read_csv, read_field, with_vtu
from impact_trial import DEPTH_LIMIT, EXPLICIT, UNITS, gained, rotation, run_all
from shape_placing import place

SEED = 20261125
VARIANTS = 600
SMALL = range(0, VARIANTS, 29)
TIME_LIMIT = 60  # s of processor time
SLOW = 4.0
NOTED = 0.05  # of a cell
NODES = {True: 2000, False: 700}  # most nodes, explicit and implicit
SCHEMES = (("central_differences", "cd_lagrange", "central_differences", "cd_lagrange", "hulbert_chung",
            "central_differences", "cd_lagrange", "noh_bathe", "central_differences", "tchamwa_wielgosz",
            "cd_lagrange", "forward_increment", "central_differences", "cd_lagrange"),
           ("newmark", "hht", "generalized_alpha", "newmark", "hht", "bathe", "newmark", "moreau_jean", "hht",
            "energy_momentum", "newmark", "wbz", "hht", "contact_stabilized_newmark", "newmark",
            "nonsmooth_generalized_alpha"))
NU = 0.3
ROUND = {"ball", "tube", "sector"}
SLENDER = {"needle", "bar"}
FINITE = {"linear_elastic": "st_venant_kirchhoff", "j2_small_strain": "j2"}  # for laws of small strains


class Variant:
    """One impact, all drawn but scheme and first type of cells."""

    def __init__(self, number, seed):
        draw = random.Random(f"{seed} shape {number}")
        self.number = number
        own = SCHEMES[number % 2]
        self.scheme = own[number // 2 % len(own)]
        self.friction = draw.choice((0.1, 0.3, 0.6)) if draw.random() < 0.5 else 0.0
        self.speed = 10.0 ** (draw.uniform(-3.0, -1.0) if draw.random() < 0.85 else draw.uniform(-4.0, -3.0))
        self.units, self.distance = draw.choice(tuple(UNITS)), draw.choice((0.0, 0.0, 100.0))
        count = draw.choice((2, 2, 2, 2, 3, 3, 4, 5))
        laws = [draw.choice(self.laws()) for _ in range(count)]
        self.laws_of = laws if draw.random() < 0.3 else laws[:1] * count
        ratio = draw.choice((1.0, 1.0, 3.0, 10.0, 100.0))
        self.modulus = [2e9 * (ratio if draw.random() < 0.5 else 1.0) for _ in range(count)]
        if min(self.modulus) > 2e9:
            self.modulus[draw.randrange(count)] = 2e9
        self.density = [1200.0 * draw.choice((1.0, 1.0, 1.0, 4.0)) for _ in range(count)]
        self.draw_bodies(draw, count)
        self.assemble(draw)

    def laws(self):
        """Those that are made for the speed, which is about the strain."""
        yields = self.scheme != "energy_momentum"
        if self.speed < 1.5e-3:
            return ("linear_elastic",) * 3 + ("st_venant_kirchhoff", "neo_hookean") + ("j2_small_strain",) * yields
        if self.speed < 1e-2:
            return ("st_venant_kirchhoff", "neo_hookean", "neo_hookean") + ("j2",) * yields
        return ("neo_hookean",) * 4 + ("j2",) * yields

    def draw_bodies(self, draw, count):
        budget = NODES[self.scheme in EXPLICIT] / count
        self.bodies, self.shapes, self.types = [], [], []
        for i in range(count):
            kind = shape_bodies.TYPES[(self.number + (i if draw.random() < 0.4 else 0)) % len(shape_bodies.TYPES)]
            shape, size = draw.choice(shape_bodies.SHAPES), 0.05 * draw.uniform(0.7, 1.4)
            make = shape_bodies.draw_body(draw, shape, size)
            cell = draw.uniform(0.09, 0.3)
            while len((body := make(cell, 1).of_type(kind)).nodes) > budget and cell < 1.0:
                cell *= 1.15
            body.drawn, body.finer = body.nodes, make(cell, 2)
            body.size, body.kind = size, kind
            body.skin = surface_crossing.Skin(body.facets())
            body.cell_size = body.cell()
            self.bodies.append(body)
            self.shapes.append(shape)
            self.types.append(kind)
        self.laws_of = [FINITE.get(law, law) if shape in SLENDER else law
                        for law, shape in zip(self.laws_of, self.shapes)]

    def assemble(self, draw):
        """The first body rests; each other one is placed before one of those that are there and flies at them."""
        waves = [math.sqrt(E / rho) for E, rho in zip(self.modulus, self.density)]
        self.normal_speed = self.speed * min(waves)
        self.velocity = [np.zeros(3)]
        cell = min(b.cell_size for b in self.bodies)
        longest = 0.0
        for i, body in enumerate(self.bodies[1:], 1):
            gap = cell * 10.0 ** draw.uniform(-4.0, -2.0)
            gap += body.skin.unlike(body.nodes) + max(b.skin.unlike(b.nodes) for b in self.bodies[:i])
            target = draw.randrange(i)
            direction = place(draw, self.bodies[:i], body, gap, self.bodies[target])
            aside = np.cross(direction, [draw.gauss(0.0, 1.0) for _ in range(3)])
            aside *= draw.choice((0.0, draw.uniform(0.0, 0.4))) / np.linalg.norm(aside)
            self.velocity.append(self.velocity[target] + self.normal_speed * (direction + aside))
            longest = max(longest, gap)
        travel = max(np.ptp(b.nodes, axis=0).max() / c for b, c in zip(self.bodies, waves))
        self.end = longest / self.normal_speed + draw.uniform(3.0, 5.0) * travel
        if set(self.laws_of) & {"linear_elastic", "j2_small_strain"}:  # before bodies have turned by 5 degrees
            self.end = min(self.end, (longest + 0.0125 * min(b.size for b in self.bodies)) / self.normal_speed)
        turn = np.array(rotation([draw.gauss(0.0, 1.0) for _ in range(3)], draw.uniform(0.0, math.pi)))
        away = np.array([draw.gauss(0.0, 1.0) for _ in range(3)])
        for body in self.bodies:
            body.nodes = body.nodes @ turn.T + self.distance * away / np.linalg.norm(away)
        self.velocity = [turn @ v for v in self.velocity]
        p_wave = math.sqrt((1.0 - NU) / ((1.0 + NU) * (1.0 - 2.0 * NU)))
        most = 600.0 if set(self.laws_of) == {"linear_elastic"} else 150.0
        self.step = max(0.5 * cell / (p_wave * min(waves)), self.end / most)

    def refined(self):
        """The same bodies at the same place on cells half as large."""
        fine = copy.copy(self)
        fine.bodies = []
        for body in self.bodies:
            one = body.finer.of_type(body.kind)
            centres = body.drawn.mean(axis=0), body.nodes.mean(axis=0)
            turn = np.linalg.lstsq(body.drawn - centres[0], body.nodes - centres[1], rcond=None)[0]
            one.nodes = (one.nodes - centres[0]) @ turn + centres[1]
            one.kind, one.meeting, one.cell_size = body.kind, getattr(body, "meeting", ""), one.cell()
            one.skin = surface_crossing.Skin(one.facets())
            fine.bodies.append(one)
        return fine

    def describe(self):
        each = ", ".join(f"{s} {t} {l}{' hard' if E > 2e9 else ''}{' ' + b.meeting if i else ''}" for i, (s, t, l, E, b) in
                         enumerate(zip(self.shapes, self.types, self.laws_of, self.modulus, self.bodies)))
        return (f"{self.scheme}, {self.speed:.2g} of the wave's speed, E 1 : {max(self.modulus) / min(self.modulus):.0f}, "
                f"friction {self.friction}, {self.units}, {self.distance:.0f} m away: {each}")

    def write(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        length, mass = UNITS[self.units]
        self.write_mesh(folder / "bodies.msh", length)
        text = [f'title = "{self.number}: {self.describe()}"', f'units = "{self.units}"', '[mesh]\nfile = "bodies.msh"']
        for i, (law, E, rho) in enumerate(zip(self.laws_of, self.modulus, self.density)):
            stress = mass / length
            yields = f"\nyield_stress = {0.01 * E * stress!r}\nhardening_modulus = {0.02 * E * stress!r}" \
                if law.startswith("j2") else ""
            text.append(f'[materials.B{i}]\nlaw = "{law}"\nE = {E * stress!r}\nnu = {NU}\n'
                        f'rho = {rho * mass / length**3!r}{yields}\n'
                        f'[[part]]\nname = "B{i}"\ncells = "B{i}"\nmaterial = "B{i}"')
            if i:
                text.append(f'[[initial]]\npart = "B{i}"\nvelocity = {[float(v) * length for v in self.velocity[i]]!r}')
        friction = f"\nfriction = {self.friction}" if self.friction else ""
        text.append(f'[[contact]]\nname = "touch"\nkind = "all"{friction}')
        text.append(f'[scheme]\nkind = "{self.scheme}"\n[time]\nend = {float(self.end)!r}')
        if self.scheme not in EXPLICIT:
            text.append(f"step = {float(self.step)!r}")
        text.append(with_vtu('[output]\nfields = ["displacement"]\n'))
        (folder / "case.toml").write_text("\n".join(text), encoding="utf-8")

    def write_mesh(self, path, length):
        """Gmsh's format 2.2."""
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(self.bodies))]
        lines += [f'3 {i} "B{i - 1}"' for i in range(1, len(self.bodies) + 1)]
        nodes = self.nodes() * length
        lines += ["$EndPhysicalNames", "$Nodes", str(len(nodes))]
        lines += [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(nodes.tolist(), 1)]
        elements, first = [], 1
        for tag, body in enumerate(self.bodies, 1):
            elements += [f"{shape_bodies.GMSH[body.kind]} 2 {tag} {tag} " + " ".join(str(n + first) for n in cell)
                         for cell in body.cells]
            first += len(body.nodes)
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        lines += [f"{i} {element}" for i, element in enumerate(elements, 1)] + ["$EndElements", ""]
        path.write_text("\n".join(lines), encoding="utf-8")

    def nodes(self):
        return np.vstack([b.nodes for b in self.bodies])

    def run(self, carom, folder):
        """What the run says, as a dictionary: fault (text, "" if none), message, figures."""
        self.write(folder)
        record = {"number": self.number, "impact": len(self.bodies), "name": self.scheme, "fault": "", "message": "",
                  "shapes": " + ".join(self.shapes), "types": " + ".join(self.types),
                  "meetings": ", ".join(b.meeting for b in self.bodies[1:])}
        check = subprocess.run([carom, "check", "case.toml"], cwd=folder, text=True, capture_output=True, check=False)
        foretold = re.search(r"(\d+) steps from", check.stdout)
        record["foretold"] = int(foretold[1]) if foretold else 0
        begin = time.monotonic()
        run = subprocess.run(["prlimit", f"--cpu={TIME_LIMIT}:{TIME_LIMIT + 5}", carom, "run", "case.toml", "--out", "out",
                              "--quiet", "--threads", "1"], cwd=folder, text=True, capture_output=True, check=False)
        record |= {"wall": time.monotonic() - begin, "code": run.returncode}
        if run.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return record | {"fault": "time-out"}
        summary_file = folder / "out" / "summary.json"
        if run.returncode not in (0, 1, 3) or not summary_file.exists():
            return record | {"fault": "refused" if run.returncode == 2 else f"crashed ({run.returncode})",
                             "message": (run.stderr + run.stdout).strip()}
        summary = json.loads(summary_file.read_text(encoding="utf-8"))
        record |= {"message": summary["message"], "steps": summary["scheme"]["steps"],
                   "verdict": {i["name"]: i["value"] for i in summary["verdict"] if not i["pass"]}}
        record |= self.measure(folder / "out", summary)
        if run.returncode == 3:
            record["fault"] = "stopped"
        return record

    def measure(self, out, summary):
        found = {"momentum": summary["linear_momentum"]["error"],
                 "gain": self.gain(read_csv(out / "energy.csv")),
                 "impulses": [[p["mass"] * (b - a) for a, b in zip(p["velocity_begin"], p["velocity_end"])]
                              for p in summary["parts"]]}
        found["overlap"], found["between"] = self.deepest(out)
        faults = []
        if summary["outcome"] != "good":
            faults.append("verdict: " + ", ".join(i["name"] for i in summary["verdict"] if not i["pass"]))
        if not found["momentum"] <= 1e-9:
            faults.append("momentum")
        if not found["gain"] <= 5e-3:
            faults.append("gain")
        if not found["overlap"] <= DEPTH_LIMIT:
            faults.append("crossing of " + found["between"].split()[0])
        return found | {"fault": "; ".join(faults)}

    def gain(self, energy):
        return gained(energy, self.scheme)

    def deepest(self, out):
        """Greatest depth of two skins in each other over all frames, in the smaller cell, and of what, which and when."""
        length = UNITS[self.units][0]
        frames = sorted((out / "fields").glob("step_*.vtu"))
        points = np.array(read_field(frames[0], "Points")).reshape(-1, 3)
        at = {tuple(p): i for i, p in enumerate(points.tolist())}
        order = [at[tuple(p)] for p in (self.nodes() * length).tolist()]
        middle = self.nodes().mean(axis=0)
        first = np.cumsum([0] + [len(b.nodes) for b in self.bodies])
        deepest = 0.0, ""
        for frame in frames:
            u = np.array(read_field(frame, "displacement")).reshape(-1, 3)[order] / length
            if not np.isfinite(u).all():
                return math.inf, f"nodes, {frame.stem}"
            x = self.nodes() - middle + u
            placed = [b.skin.placed(x[f:f + len(b.nodes)]) for b, f in zip(self.bodies, first)]
            for i, one in enumerate(placed):
                for j, two in enumerate(placed[:i]):
                    cell = min(self.bodies[i].cell_size, self.bodies[j].cell_size)
                    for depth, what in zip(surface_crossing.crossing_depths(two, one), ("nodes", "edges")):
                        deepest = max(deepest, (depth / cell, f"{what} of B{j} and B{i}, {frame.stem}"))
        return deepest


# --------------------------------------------------------------------------------------------------------- the trial
def judge_impulse(carom, folder, record, seed):
    """Against the same bodies on cells half as large; round ones, whose facets these change, are left out."""
    variant = Variant(record["number"], seed)
    if ROUND & set(variant.shapes):
        return
    fine = variant.refined().run(carom, folder / f"{record['number']}_refined")
    if "impulses" not in record or "impulses" not in fine or fine["fault"]:
        return
    one, two = np.array(record["impulses"]), np.array(fine["impulses"])
    record["error"] = float(np.linalg.norm(one - two, axis=1).max() / np.linalg.norm(two, axis=1).max())
    if not record["error"] <= 0.05:
        record["fault"] = "; ".join(filter(None, [record["fault"], "impulse"]))


def report(records):
    """Prints the wrong runs by class, and what is noted; returns the number of wrong ones."""
    classes = collections.defaultdict(list)
    for r in records:
        if r["fault"]:
            classes[r["fault"]].append(r)
    for fault, own in sorted(classes.items(), key=lambda item: -len(item[1])):
        print(f"\n{len(own)} {fault}")
        for r in own:
            print(f"  {r['number']:4} {r['name']:26} {r['shapes']} | {r['types']} | {r['meetings']} | {figures(r)}"
                  f" {r.get('between', '')}\n       {(r['message'].splitlines() or [''])[0][:220]}")
    slow = [r for r in records if r["foretold"] and r.get("steps", 0) > SLOW * r["foretold"]]
    deep = [r for r in records if r.get("overlap", 0.0) > NOTED]
    print(f"\n{len(slow)} with more than {SLOW:g} times the steps foretold:",
          ", ".join(f"{r['number']} ({r['steps'] / r['foretold']:.1f})" for r in slow))
    print(f"{len(deep)} with depths above {NOTED} of a cell, {sum(r['overlap'] > DEPTH_LIMIT for r in deep)} above "
          f"{DEPTH_LIMIT}:", ", ".join(f"{r['number']} ({r['overlap']:.2f})" for r in deep))
    return sum(map(len, classes.values()))


def figures(r):
    return " ".join(f"{key} {r[key]:.2g}" for key in ("error", "gain", "momentum", "overlap") if key in r) + \
        "".join(f" {name}: {value:.2g}" for name, value in r.get("verdict", {}).items())


def wanted(text):
    numbers = set()
    for part in text.split(","):
        first, _, last = part.partition("-")
        numbers |= set(range(int(first), int(last or first) + 1))
    return sorted(numbers)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("carom", nargs="?", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--small", action="store_true", help="some twenty variants")
    parser.add_argument("--only", type=wanted, help="numbers or ranges of variants, separated by commas")
    parser.add_argument("--keep", type=pathlib.Path, help="keep decks and results here")
    parser.add_argument("--json", type=pathlib.Path, help="write the records here")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--least", type=int, default=594, help="runs of 600 that must be right")
    parser.add_argument("--refined", action="store_true", help="impulses of every tenth against cells half as large")
    parser.add_argument("--self-test", action="store_true", help="the test of crossing alone")
    given = parser.parse_args()
    if not given.carom and not given.self_test:
        parser.error("the program is missing")
    return given


def main():
    given = arguments()
    if given.self_test:
        return 1 if surface_crossing.self_test() else 0
    chosen = given.only or (SMALL if given.small else range(VARIANTS))
    begin, folder = time.monotonic(), given.keep or pathlib.Path(tempfile.mkdtemp())
    try:
        records = run_all(given.carom, folder, (Variant(n, given.seed) for n in chosen), given.jobs)
        if given.refined:
            for r in records:
                if r["number"] % 10 == 0:
                    judge_impulse(given.carom, folder, r, given.seed)
    finally:
        if not given.keep:
            shutil.rmtree(folder)
    bad = report(records)
    if given.json:
        given.json.write_text(json.dumps(records, indent=1), encoding="utf-8")
    print(f"{len(records) - bad} right of {len(records)}; {time.monotonic() - begin:.0f} s")
    return 0 if len(records) - bad >= math.ceil(given.least / VARIANTS * len(records)) else 1


if __name__ == "__main__":
    sys.exit(main())
