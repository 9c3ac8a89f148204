#!/usr/bin/python3
"""Cost of an implicit step in contact over that of a step without, of the same model, multipliers, one thread.

Usage: contact_step_cost.py CAROM [MODEL...]. Models: bar (81 fixed rows on a plane), bar_friction, slide (169 rows of a
block that slides on a plate), slide_friction, plane (a block of finite strain that slides on a plane, 289 rows),
plane_friction. Each runs with its contact and, for comparison, with the obstacle out of reach; CPU times of a short and
of a longer run are subtracted, so that set-up and the first touch are left out ("first touch" has what they cost more
with contact). Compare the figures of one call only.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

BAR = """
[[mesh.block]]
origin = [-0.01, -0.01, {gap}]
size = [0.02, 0.02, 0.2]
divisions = [8, 8, 160]
groups = {{ cells = "BAR", zmin = "FOOT" }}

[[part]]
name = "bar"
cells = "BAR"
material = "steel"

[[initial]]
part = "bar"
velocity = [{speed}, 0.0, -10.0]

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
size = [0.3, 0.16, 0.06]
divisions = [30, 16, 6]
groups = {{ cells = "PLATE", zmin = "GROUND", zmax = "TABLE" }}

[[mesh.block]]
origin = [0.0513, 0.0217, {top}]
size = [0.12, 0.12, 0.08]
divisions = [12, 12, 8]
groups = {{ cells = "BLOCK", zmin = "FOOT", zmax = "TOP" }}

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
velocity = [{speed}, 0.0, -1.0]

[[load]]
group = "TOP"
pressure = 1.0e7

[[contact]]
name = "table"
kind = "pair"
group = "FOOT"
master = "TABLE"
method = "node_to_surface"
friction = {mu}
"""

PLANE = """
[[mesh.block]]
origin = [0.0, 0.0, {gap}]
size = [0.16, 0.16, 0.16]
divisions = [16, 16, 16]
groups = {{ cells = "BLOCK", zmin = "FOOT", zmax = "TOP" }}

[[part]]
name = "block"
cells = "BLOCK"
material = "steel"

[[initial]]
part = "block"
velocity = [{speed}, 0.0, -1.0]

[[load]]
group = "TOP"
pressure = 1.0e8

[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
friction = {mu}
"""

COMMON = """
title = "{name}"
units = "SI"
{model}
[materials.steel]
law = "{law}"
E = 2.0e11
nu = 0.3
rho = 8000.0

[scheme]
kind = "hht"
alpha = -0.2
enforcement = "lagrange"

[solver]
kind = "{solver}"

[time]
end = {end}
step = {step}
fixed = true

[output]
fields_every = 1000000
curves_every = 1000000
"""

MODELS = {
    "bar": (BAR, "linear_elastic", 0.0, 0.0),
    "bar_friction": (BAR, "linear_elastic", 0.2, 1.0),
    "slide": (SLIDE, "linear_elastic", 0.0, 10.0),
    "slide_friction": (SLIDE, "linear_elastic", 0.2, 10.0),
    "plane": (PLANE, "st_venant_kirchhoff", 0.0, 10.0),
    "plane_friction": (PLANE, "st_venant_kirchhoff", 0.2, 10.0),
}
STEP = 2e-6
STEPS = {BAR: (4, 34), SLIDE: (4, 34), PLANE: (2, 6)}  # of the short and of the longer run


def cpu(carom, folder, name, touching, steps):
    """CPU seconds of `steps` steps."""
    model, law, mu, speed = MODELS[name]
    away = 0.0 if touching else 1.0
    text = COMMON.format(
        name=name, law=law, step=STEP, end=steps * STEP, solver="cholmod",
        model=model.format(gap=away, top=0.06 + away, mu=mu, speed=speed))
    case = folder / f"{name}_{touching}_{steps}.toml"
    case.write_text(text)
    out = folder / case.stem
    command = [carom, "run", case, "--out", out, "--threads", "1"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    summary = json.loads((out / "summary.json").read_text())
    if summary["scheme"]["steps"] != steps:
        sys.exit(f"{name}: {summary['message']}\n{run.stderr[-2000:]}")
    return summary["cost"]["cpu_seconds"]


def main():
    """Prints a line for each model."""
    carom, names = sys.argv[1], sys.argv[2:] or list(MODELS)
    print(f"{'model':16s} {'free, ms':>9s} {'contact, ms':>12s} {'quotient':>9s} {'first touch, ms':>16s}")
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            few, many = STEPS[MODELS[name][0]]
            times = {}
            for touching in (False, True):
                short = cpu(carom, pathlib.Path(folder), name, touching, few)
                long = cpu(carom, pathlib.Path(folder), name, touching, many)
                times[touching] = ((long - short) / (many - few), short)
            free, contact = times[False][0], times[True][0]
            first = times[True][1] - times[False][1] - few * (contact - free)
            print(f"{name:16s} {1e3 * free:9.1f} {1e3 * contact:12.1f} {contact / free:9.2f} {1e3 * first:16.0f}",
                  flush=True)


if __name__ == "__main__":
    main()
