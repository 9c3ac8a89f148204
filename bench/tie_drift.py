#!/usr/bin/python3
"""Whether a tie drifts: a bar of two tied blocks in free flight, spinning and ringing, over a million explicit steps.

Usage: bench/tie_drift.py build/release/carom [--steps N]. Prints the largest distance that the sides of the tie have
parted by (over the length of a cell), and the largest errors of energy (over the initial one) and of both momenta (over
momentum and moment of momentum), in the first hundredth of the run and in all of it.
"""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

CASE = """title = "A tied bar in free flight"
[[mesh.block]]
size = [1.0, 0.5, 0.5]
divisions = [4, 2, 2]
groups = {{ cells = "LEFT", xmax = "LFACE" }}
points = {{ L = [1.0, 0.5, 0.5] }}
[[mesh.block]]
origin = [1.0, 0.0, 0.0]
size = [1.0, 0.5, 0.5]
divisions = [4, 2, 2]
groups = {{ cells = "RIGHT", xmin = "RFACE" }}
points = {{ R = [1.0, 0.5, 0.5] }}
[materials.any]
law = "neo_hookean"
E = 1.0
nu = 0.3
rho = 1.0
[[part]]
name = "left"
cells = "LEFT"
material = "any"
[[part]]
name = "right"
cells = "RIGHT"
material = "any"
[[initial]]
nodes = "all"
velocity = [0.01, -0.02, 0.005]
angular_velocity = [0.02, 0.03, 0.1]
centre = [1.0, 0.25, 0.25]
[[contact]]
name = "glue"
kind = "tie"
group = "RFACE"
master = "LFACE"
[scheme]
kind = "central_differences"
[time]
end = {end}
step = {step}
[output]
fields = []
curves_every = {every}
[[probe]]
name = "l"
group = "L"
quantities = ["displacement"]
[[probe]]
name = "r"
group = "R"
quantities = ["displacement"]
"""
STEP = 0.05
CELL = 0.25


def rows(path):
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
    return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(lines)]


def largest(values, share):
    return max(values[:max(2, int(share * len(values)))])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("carom")
    parser.add_argument("--steps", type=int, default=1_000_000)
    args = parser.parse_args()
    carom = str(pathlib.Path(args.carom).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        every = max(1, args.steps // 2000)
        (folder / "case.toml").write_text(CASE.format(end=args.steps * STEP, step=STEP, every=every), encoding="utf-8")
        subprocess.run([carom, "run", "case.toml", "--out", "out", "--threads", "1"], cwd=folder, check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        probes, energy = rows(folder / "out/probes.csv"), rows(folder / "out/energy.csv")
        summary = json.loads((folder / "out/summary.json").read_text(encoding="utf-8"))
    parted = [math.dist([row[f"l.displacement_{c}"] for c in "xyz"], [row[f"r.displacement_{c}"] for c in "xyz"]) / CELL
              for row in probes]
    start = energy[0]["kinetic"] + energy[0]["strain"]
    error = [abs(row["imbalance"]) / start for row in energy]
    print(f"steps {args.steps}, {sum(v['pass'] for v in summary['verdict'])} of {len(summary['verdict'])} verdict items passed")
    for what, values in {"parted (cells)": parted, "imbalance": error}.items():
        print(f"{what}: {largest(values, 0.01):.2e} in the first hundredth, {largest(values, 1.0):.2e} in all")
    first = energy[0]
    for what in ("momentum", "angular_momentum"):
        size = math.hypot(*(first[f"{what}_{c}"] for c in "xyz"))
        errors = [row[f"{what}_error"] / size for row in energy]
        print(f"{what} error: {largest(errors, 0.01):.2e} in the first hundredth, {largest(errors, 1.0):.2e} in all")
    return 0


if __name__ == "__main__":
    sys.exit(main())
