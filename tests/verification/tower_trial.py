#!/usr/bin/env python3
"""60 towers of blocks that fall on a plane with default settings, drawn from a seed, each by five schemes.

    python3 tower_trial.py build/release/carom                 all, an hour
    python3 tower_trial.py build/release/carom --small         those that once gained energy
    python3 tower_trial.py build/release/carom --only 17,203   these alone, as in shape_trial.py; --keep, --seed, --json too

Two to six blocks of HEXA8 stand above each other, shifted by up to a third of their width, each of its own size, cells,
stiffness (1 : 1 to 1 : 10) and density, with gaps of 1e-3 of a block between them; they fly together, down and half of
them sideways, at 1e-3 to 1e-2 of the bar wave's speed. The deck says a plane below, [[contact]] kind = "all", and the
scheme. Run 5 n + s is tower n by scheme s. A run is right if it is as shape_trial.py has it (good, momentum, gain,
crossing), and if no node is below the plane by more than a quarter of a cell.
Needs numpy (Debian: python3-numpy), and prlimit of util-linux.
"""

import argparse
import json
import math
import pathlib
import random
import shutil
import sys
import tempfile
import time

import numpy as np

import shape_bodies
import shape_trial
import surface_crossing
from ball_on_plate import read_field
from impact_trial import EXPLICIT, UNITS, run_all

SEED = 20261126
TOWERS = 60
ONCE_WRONG = (50, 51, 53, 155, 180)
SCHEMES = ("central_differences", "newmark", "cd_lagrange", "hht", "moreau_jean")


class Tower(shape_trial.Variant):
    """One tower by one scheme; the tower is drawn by its number alone."""

    def __init__(self, number, seed):
        draw = random.Random(f"{seed} tower {number // len(SCHEMES)}")
        self.number, self.scheme = number, SCHEMES[number % len(SCHEMES)]
        count = draw.choice((2, 2, 3, 3, 4, 5, 6))
        self.friction = draw.choice((0.0, 0.0, 0.2, 0.5))
        self.speed = 10.0 ** draw.uniform(-3.0, -2.0)
        self.units, self.distance = draw.choice(tuple(UNITS)), 0.0
        law = draw.choice(("neo_hookean", "st_venant_kirchhoff")) if self.speed > 3e-3 else "linear_elastic"
        self.laws_of, self.shapes, self.types = [law] * count, ["block"] * count, ["HEXA8"] * count
        ratio = draw.choice((1.0, 1.0, 3.0, 10.0))
        self.modulus = [2e9 * draw.choice((1.0, ratio)) for _ in range(count)]
        self.density = [1200.0 * draw.choice((1.0, 1.0, 3.0)) for _ in range(count)]
        self.bodies, top = [], 0.0
        for i in range(count):
            size = [draw.uniform(0.01, 0.03) for _ in range(3)]
            body = shape_bodies.box(size, [draw.choice((2, 3, 4)) for _ in range(3)])
            gap = 1e-3 * size[2] if i else 1e-5
            body.nodes += [draw.uniform(-0.3, 0.3) * size[0], draw.uniform(-0.3, 0.3) * size[1], top + gap + size[2] / 2]
            top += gap + size[2]
            body.size, body.kind, body.meeting = max(size), "HEXA8", "on"
            body.skin, body.cell_size = surface_crossing.Skin(body.facets()), body.cell()
            self.bodies.append(body)
        waves = [math.sqrt(E / rho) for E, rho in zip(self.modulus, self.density)]
        self.normal_speed = self.speed * min(waves)
        along = draw.choice((0.0, draw.uniform(0.0, 0.5)))
        self.velocity = [self.normal_speed * np.array([along, 0.0, -1.0])] * count
        travel = sum(np.ptp(b.nodes[:, 2]) / c for b, c in zip(self.bodies, waves))
        self.end = 2e-5 / self.normal_speed + 3.0 * travel
        cell = min(b.cell_size for b in self.bodies)
        p_wave = math.sqrt((1.0 - shape_trial.NU) / ((1.0 + shape_trial.NU) * (1.0 - 2.0 * shape_trial.NU)))
        self.step = max(0.5 * cell / (p_wave * min(waves)), self.end / 200.0)

    def write(self, folder):
        super().write(folder)
        length = UNITS[self.units][0]
        with open(folder / "case.toml", "a", encoding="utf-8") as deck:
            deck.write(f'[[initial]]\npart = "B0"\nvelocity = {[float(v) * length for v in self.velocity[0]]!r}\n'
                       '[[contact]]\nname = "floor"\nkind = "plane"\ngroup = "FOOT"\npoint = [0.0, 0.0, 0.0]\n'
                       f'normal = [0.0, 0.0, 1.0]\nfriction = {self.friction}\n')

    def write_mesh(self, path, length):
        """Gmsh's format 2.2; with the lower face of the lowest block."""
        super().write_mesh(path, length)
        text = path.read_text(encoding="utf-8")
        foot = [f for f in self.bodies[0].facets() if np.ptp(self.bodies[0].nodes[f][:, 2]) < 1e-9
                and self.bodies[0].nodes[f][:, 2].max() < 1e-4]
        count, tag = sum(len(b.cells) for b in self.bodies), len(self.bodies) + 1
        text = text.replace(f"$PhysicalNames\n{tag - 1}\n", f'$PhysicalNames\n{tag}\n2 {tag} "FOOT"\n')
        text = text.replace(f"$Elements\n{count}\n", f"$Elements\n{count + len(foot)}\n")
        more = "".join(f"{count + i} 3 2 {tag} {tag} " + " ".join(str(n + 1) for n in f) + "\n" for i, f in enumerate(foot, 1))
        path.write_text(text.replace("$EndElements", more + "$EndElements"), encoding="utf-8")

    def gain(self, energy):
        """Without what explicit schemes lend, at the end too: blocks of a few cells vibrate near the frequency of the step."""
        if self.scheme not in EXPLICIT:
            return super().gain(energy)
        return max(-q - min(0.0, i) for q, i in zip(energy["quadrature"], energy["impact"])) / energy["kinetic"][0]

    def deepest(self, out):
        """Of two skins in each other as shape_trial.py has it, and of nodes below the plane, in the smallest cell."""
        deepest = super().deepest(out)
        cell = min(b.cell_size for b in self.bodies) * UNITS[self.units][0]
        for frame in sorted((out / "fields").glob("step_*.vtu")):
            z = np.array(read_field(frame, "Points"))[2::3] + np.array(read_field(frame, "displacement"))[2::3]
            deepest = max(deepest, (-z.min() / cell, f"floor and B0, {frame.stem}"))
        return deepest


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("carom", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--small", action="store_true", help="those that once gained energy")
    parser.add_argument("--only", type=shape_trial.wanted, help="numbers or ranges of runs, separated by commas")
    parser.add_argument("--keep", type=pathlib.Path, help="keep decks and results here")
    parser.add_argument("--json", type=pathlib.Path, help="write the records here")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--seed", type=int, default=SEED)
    given = parser.parse_args()
    runs = TOWERS * len(SCHEMES)
    chosen = given.only or (ONCE_WRONG if given.small else range(runs))
    begin, folder = time.monotonic(), given.keep or pathlib.Path(tempfile.mkdtemp())
    try:
        records = run_all(given.carom, folder, (Tower(n, given.seed) for n in chosen), given.jobs)
    finally:
        if not given.keep:
            shutil.rmtree(folder)
    bad = shape_trial.report(records)
    if given.json:
        given.json.write_text(json.dumps(records, indent=1), encoding="utf-8")
    print(f"{len(records) - bad} right of {len(records)}; {time.monotonic() - begin:.0f} s")
    return 1 if bad > len(records) // 60 else 0


if __name__ == "__main__":
    sys.exit(main())
