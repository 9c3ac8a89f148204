#!/usr/bin/python3
"""A long run of a model that bounces for ever: does the balance of powers stay at round-off, and the memory where it was?

Usage: soak.py CAROM [--steps N]

Two blocks between two walls, thrown against each other, by CD-Lagrange (nodes that touch come back
as fast as they came), a million steps. Each step may round the sums by half a
unit, 1.1e-16 of the energy, and no more than that may add up; memory is looked at after a tenth of the steps and at the
end. (The impulses on nodes cost more energy than a verdict allows: that item is not looked at.)
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

CASE = """
title = "blocks that bounce between two walls"
units = "SI"

[[mesh.block]]
size = [0.02, 0.02, 0.04]
divisions = [2, 2, 4]
groups = {{ cells = "LOWER", zmin = "FOOT", zmax = "HEAD" }}

[[mesh.block]]
origin = [0.001, 0.002, 0.041]
size = [0.018, 0.016, 0.04]
divisions = [2, 2, 4]
groups = {{ cells = "UPPER", zmin = "SOLE", zmax = "TOP" }}

[[part]]
name = "lower"
cells = "LOWER"
material = "steel"

[[part]]
name = "upper"
cells = "UPPER"
material = "steel"

[materials.steel]
law = "neo_hookean"
E = 2.0e11
nu = 0.3
rho = 8000.0

[[initial]]
part = "lower"
velocity = [0.0, 0.0, 5.0]

[[initial]]
part = "upper"
velocity = [0.0, 0.0, -4.0]

[[contact]]
name = "blocks"
kind = "pair"
group = "SOLE"
master = "HEAD"
restitution = 1.0

[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, -0.001]
normal = [0.0, 0.0, 1.0]
restitution = 1.0

[[contact]]
name = "ceiling"
kind = "plane"
group = "TOP"
point = [0.0, 0.0, 0.082]
normal = [0.0, 0.0, -1.0]
restitution = 1.0

[scheme]
kind = "cd_lagrange"

[time]
end = {end}
step = {step}

[output]
fields_every = 100000000
curves_every = 1000
"""
STEP = 5e-7


def resident(pid):
    """Memory in use, kB."""
    for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1])
    return 0


def soak(carom, steps):
    """Returns what is wrong, "" when nothing is."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        case = pathlib.Path(folder) / "case.toml"
        case.write_text(CASE.format(end=steps * STEP, step=STEP))
        start = time.time()
        with subprocess.Popen([carom, "run", case, "--out", out, "--quiet", "--threads", "1"],
                              stderr=subprocess.DEVNULL) as run:
            early = last = 0
            while run.poll() is None:
                time.sleep(0.2)
                now = resident(run.pid) if run.poll() is None else 0
                last = now or last
                curve = out / "energy.csv"
                if early == 0 and curve.exists() and curve.read_text().count("\n") > steps / 10000:
                    early = now
        summary = json.loads((out / "summary.json").read_text())
    items = {item["name"]: item["value"] for item in summary["verdict"]}
    taken = summary["scheme"]["steps"]
    print(f"{taken} steps in {time.time() - start:.0f} s, {summary['outcome']}; memory {early} kB after a tenth of "
          f"them, {last} kB at the end; {items}", flush=True)
    if taken != steps:
        return summary["message"]
    if early == 0 or last > 1.02 * early + 1024:
        return f"memory grows from {early} to {last} kB"
    imbalance = items["energy balance"]
    return "" if imbalance <= 1.1e-16 * taken else f"the imbalance is {imbalance}"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--steps", type=int, default=1_000_000)
    options.add_argument("carom")
    given = options.parse_args()
    wrong = soak(given.carom, given.steps)
    if wrong:
        print("FAILED:", wrong)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
