#!/usr/bin/env python3
"""100 pairs of the same impact, seen otherwise: the same number of steps, and the same impulses to round-off.

    python3 galilean_trial.py build/release/carom                 all, ten minutes
    python3 galilean_trial.py build/release/carom --small         four of them
    python3 galilean_trial.py build/release/carom --only 17,203   these alone, as in shape_trial.py; --keep, --seed too

Towers of tower_trial.py without their plane, whose lowest block flies up, and so that impacts differ; each runs as it is and
once more as pair number n % 4 says:
  velocity   all bodies have a common velocity, three times that of the impact, in any direction;
  frame      turned in space;
  units      in mm, t and s, or in SI where it was in those (lengths x 1000, masses / 1000);
  place      shifted by 10 m.
Numbers that enter the decks in another way are rounded, by 1e-16 of a length, so that results differ by as much, times what
the impact makes of it: impulses must agree to LIMIT of the largest, and steps be as many.
Needs numpy, and prlimit of util-linux.
"""

import argparse
import copy
import math
import pathlib
import random
import shutil
import sys
import tempfile
import time

import numpy as np

import shape_trial
from impact_trial import UNITS, rotation
from tower_trial import SCHEMES, Tower

SEED = 20261127
PAIRS = 100
KINDS = ("velocity", "frame", "units", "place")
# Shifted by 10 m, positions of blocks of 0.03 m have 1e-13 of their size, gaps of 1e-5 m 2e-10; friction and touches
# make ten to a hundred times that of it.
LIMIT = {"velocity": 1e-6, "frame": 1e-6, "units": 1e-6, "place": 1e-6}


class Impact(Tower):
    """A tower whose lowest block flies up; without a plane."""

    def __init__(self, number, seed):
        super().__init__(number * len(SCHEMES) + (number // len(KINDS)) % len(SCHEMES), seed)
        self.friction = 0.0 if number % 8 < 4 else self.friction
        self.velocity = [-self.velocity[0]] + self.velocity[1:]
        for body in self.bodies:
            body.nodes = body.nodes - [0.0, 0.0, 0.01]

    def seen(self, kind, draw):
        other = copy.deepcopy(self)
        if kind == "velocity":
            more = [draw.gauss(0.0, 1.0) for _ in range(3)]
            more = 3.0 * self.normal_speed * np.array(more) / np.linalg.norm(more)
            other.velocity = [v + more for v in self.velocity]
        elif kind == "frame":
            turn = np.array(rotation([draw.gauss(0.0, 1.0) for _ in range(3)], draw.uniform(0.5, math.pi)))
            other.turn = turn
            other.velocity = [turn @ v for v in self.velocity]
            for body in other.bodies:
                body.nodes = body.nodes @ turn.T
        elif kind == "units":
            other.units = next(u for u in UNITS if u != self.units)
        else:
            for body in other.bodies:
                body.nodes = body.nodes + np.array([10.0, -5.0, 7.0])
        return other

    def write(self, folder):
        shape_trial.Variant.write(self, folder)
        length = UNITS[self.units][0]
        with open(folder / "case.toml", "a", encoding="utf-8") as deck:
            deck.write(f'[[initial]]\npart = "B0"\nvelocity = {[float(v) * length for v in self.velocity[0]]!r}\n')

    def write_mesh(self, path, length):
        shape_trial.Variant.write_mesh(self, path, length)

    def deepest(self, out):
        return 0.0, "not looked at"

    def impulses(self, record):
        length, mass = UNITS[self.units]
        return np.array(record["impulses"]) @ getattr(self, "turn", np.eye(3)) / (length * mass)


def judge(carom, folder, number, seed):
    """A line on the pair, and whether it is right."""
    kind = KINDS[number % len(KINDS)]
    one = Impact(number, seed)
    two = one.seen(kind, random.Random(f"{seed} pair {number}"))
    first, second = one.run(carom, folder / f"{number}a"), two.run(carom, folder / f"{number}b")
    name = f"{number:4} {kind:9} {one.scheme:20} {len(one.bodies)} blocks, mu {one.friction}"
    if "impulses" not in first or "impulses" not in second:
        same = first["fault"] == second["fault"]
        return f"{name} {first['fault']} / {second['fault']}: {(second['message'].splitlines() or [''])[0][:150]}", same
    a, b = one.impulses(first), two.impulses(second)
    error = np.abs(a - b).max() / np.abs(a).max()
    good = first["steps"] == second["steps"] and error <= LIMIT[kind]
    return f"{name} steps {first['steps']:5} {second['steps']:5} impulses {error:.1e}{'' if good else '  WRONG'}", good


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("carom", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--small", action="store_true", help="four pairs")
    parser.add_argument("--only", type=shape_trial.wanted, help="numbers or ranges of pairs, separated by commas")
    parser.add_argument("--keep", type=pathlib.Path, help="keep decks and results here")
    parser.add_argument("--seed", type=int, default=SEED)
    given = parser.parse_args()
    chosen = given.only or ((0, 1, 10, 15) if given.small else range(PAIRS))
    begin, folder, wrong = time.monotonic(), given.keep or pathlib.Path(tempfile.mkdtemp()), 0
    try:
        for number in chosen:
            line, good = judge(given.carom, folder, number, given.seed)
            print(line, flush=True)
            wrong += not good
    finally:
        if not given.keep:
            shutil.rmtree(folder)
    print(f"{len(chosen) - wrong} right of {len(chosen)}; {time.monotonic() - begin:.0f} s")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
