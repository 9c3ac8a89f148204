#!/usr/bin/python3
"""Cost of whole steps, in millions of cell-steps per second of processor time on one thread, ledger and curves in every
step; of one program, or of two whose runs alternate.

Usage: step_cost.py [--rounds N] [--only NAME,NAME] CAROM [OTHER_CAROM]

CPU times of a short and of a longer run are subtracted, so that set-up is left out. Of several rounds the median is
shown, with the smallest and the largest; with two programs the quotient of their times, round by round. Compare figures
of one call only.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

BAR = """
[[mesh.block]]
origin = [-0.01, -0.01, {gap}]
size = [0.02, 0.02, {length}]
divisions = [{across}, {across}, {along}]
groups = {{ cells = "BAR", zmin = "FOOT" }}

[[part]]
name = "bar"
cells = "BAR"
material = "steel"

[[initial]]
part = "bar"
velocity = [3.0, 0.0, -10.0]

[[contact]]
name = "wall"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
friction = {mu}
"""

SLIDE = """
[[mesh.block]]
size = [0.3, 0.2, 0.1]
divisions = [60, 40, 20]
groups = { cells = "PLATE", zmin = "GROUND", zmax = "TABLE" }

[[mesh.block]]
origin = [0.0513, 0.0217, 0.1]
size = [0.15, 0.15, 0.1]
divisions = [30, 30, 20]
groups = { cells = "BLOCK", zmin = "FOOT", zmax = "TOP" }

[[part]]
name = "plate"
cells = "PLATE"
material = "steel"

[[part]]
name = "block"
cells = "BLOCK"
material = "steel"

[[support]]
nodes = "GROUND"
blocked = ["x", "y", "z"]

[[initial]]
part = "block"
velocity = [10.0, 0.0, -1.0]

[[load]]
group = "TOP"
pressure = 1.0e7

[[contact]]
name = "table"
kind = "pair"
group = "FOOT"
master = "TABLE"
friction = 0.2
"""

COMMON = """
title = "cost of a step"
units = "SI"
{model}
[materials.steel]
law = "{law}"
E = 2.0e11
nu = 0.3
rho = 8000.0

[scheme]
{scheme}

[time]
end = {end}
step = {step}
{kept}
[output]
fields_every = 1000000
curves_every = 1
"""


def bar(across, along, gap=0.0, mu=0.0):
    """A bar of cubes on a wall."""
    return BAR.format(gap=gap, length=0.02 * along / across, across=across, along=along, mu=mu)


EXPLICIT = 'kind = "central_differences"'
CD_LAGRANGE = 'kind = "cd_lagrange"'
SOLVER = '\n[solver]\nkind = "{}"'
HHT = 'kind = "hht"\nalpha = -0.2'
# name: model, law, scheme, step over that of waves through a cell, steps of the short and of the longer run, cells
MODELS = {
    "explicit": (bar(16, 320), "linear_elastic", EXPLICIT, 0.5, (20, 220), 81920),
    "explicit free": (bar(16, 320, gap=1.0), "linear_elastic", EXPLICIT, 0.5, (20, 220), 81920),
    "explicit neo-Hookean": (bar(16, 320), "neo_hookean", EXPLICIT, 0.5, (20, 120), 81920),
    "explicit sliding pair": (SLIDE, "linear_elastic", EXPLICIT, 0.3, (20, 120), 66000),
    "CD-Lagrange": (bar(16, 320, mu=0.2), "linear_elastic", CD_LAGRANGE, 0.5, (20, 220), 81920),
    "HHT Cholesky": (bar(8, 160), "linear_elastic", HHT + SOLVER.format("cholmod"), 2.0, (10, 160), 10240),
    "HHT iterative": (bar(8, 160), "linear_elastic", HHT + SOLVER.format("cg"), 2.0, (10, 80), 10240),
    "HHT multipliers": (bar(8, 160, mu=0.2), "linear_elastic", HHT + '\nenforcement = "lagrange"', 2.0, (10, 160), 10240),
    "HHT neo-Hookean": (bar(6, 60), "neo_hookean", HHT, 2.0, (5, 15), 2160),
}
WAVE_SPEED = 5800.0  # of dilatation in the steel above


def cpu(carom, folder, name, steps):
    """CPU seconds of `steps` steps."""
    model, law, scheme, courant, _, _ = MODELS[name]
    cell = 0.005 if model == SLIDE else 0.02 / int(model.split("divisions = [")[1].split(",")[0])
    step = courant * cell / WAVE_SPEED
    case = folder / "case.toml"
    kept = "" if scheme.split('"')[1] in ("central_differences", "cd_lagrange") else "fixed = true\n"
    case.write_text(COMMON.format(model=model, law=law, scheme=scheme, step=step, end=steps * step, kept=kept))
    out = folder / "out"
    run = subprocess.run([carom, "run", case, "--out", out, "--threads", "1"],
                         capture_output=True, text=True, check=False)
    if not (out / "summary.json").exists():
        sys.exit(f"{name}: {run.stderr[-2000:]}")
    summary = json.loads((out / "summary.json").read_text())
    if summary["scheme"]["steps"] != steps:
        sys.exit(f"{name}: {summary['message']}\n{run.stderr[-2000:]}")
    return summary["cost"]["cpu_seconds"]


def seconds_per_step(carom, name):
    """CPU seconds of one step."""
    few, many = MODELS[name][4]
    with tempfile.TemporaryDirectory() as folder:
        short, long = (cpu(carom, pathlib.Path(folder), name, steps) for steps in (few, many))
    return (long - short) / (many - few)


def main():
    """Prints a line for each model."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--rounds", type=int, default=3)
    options.add_argument("--only", default=",".join(MODELS))
    options.add_argument("carom", nargs="+")
    given = options.parse_args()
    print(f"{'model':24s} {'M cell-steps/s, smallest to largest':>36s}" +
          ("   second program, time over the first's" if len(given.carom) > 1 else ""))
    for name in given.only.split(","):
        rounds = [[seconds_per_step(carom, name) for carom in given.carom] for _ in range(given.rounds)]
        rates = sorted(MODELS[name][5] / times[0] / 1e6 for times in rounds)
        line = f"{name:24s} {statistics.median(rates):12.3f} {rates[0]:12.3f} {rates[-1]:10.3f}"
        if len(given.carom) > 1:
            ratios = sorted(times[1] / times[0] for times in rounds)
            line += f" {statistics.median(ratios):12.3f} {ratios[0]:8.3f} {ratios[-1]:8.3f}"
        print(line, flush=True)


if __name__ == "__main__":
    main()
