#!/usr/bin/python3
"""Time and memory of explicit steps with tens of thousands of rows of exact contact: a block that meets a plate, face
on face, nodes over facets, CD-Lagrange with a lumped mass, one thread.

Usage: exact_rows.py CAROM [SIDE...]. SIDE: nodes along a side of the block's foot, 141 and 224 without one (19,881 and
50,176 nodes). Models: away (out of reach, for comparison), nodes (the foot's nodes over the plate: independent rows),
nodes_friction, both (two_pass: the plate's nodes over the foot too, so that rows are redundant), both_friction. The
time to the end of the first step holds the reading, the start, at which all rows close together, and that step.
"""

import pathlib
import sys
import tempfile

import measure

CASE = """
title = "{name}"
units = "SI"

[[mesh.block]]
size = [1.0, 1.0, 0.05]
divisions = [{plate}, {plate}, 2]
groups = {{ cells = "PLATE", zmin = "GROUND", zmax = "TABLE" }}

[[mesh.block]]
origin = [0.01, 0.01, {bottom}]
size = [0.96, 0.97, 0.05]
divisions = [{block}, {block}, 2]
groups = {{ cells = "BLOCK", zmin = "FOOT", zmax = "TOP" }}

[[part]]
name = "plate"
cells = "PLATE"
material = "steel"

[[part]]
name = "block"
cells = "BLOCK"
material = "steel"

[[initial]]
part = "block"
velocity = [0.5, 0.2, -1.0]

[[contact]]
name = "table"
kind = "pair"
group = "FOOT"
master = "TABLE"
method = "{method}"
friction = {mu}

[materials.steel]
law = "linear_elastic"
E = 2.0e11
nu = 0.3
rho = 8000.0

[scheme]
kind = "cd_lagrange"

[time]
end = {end}
step = {step}

[output]
fields_every = 1000000
curves_every = 1000000
"""

MODELS = {
    "away": (1.0, "node_to_surface", 0.0),
    "nodes": (0.0, "node_to_surface", 0.0),
    "nodes_friction": (0.0, "node_to_surface", 0.3),
    "both": (0.0, "two_pass", 0.0),
    "both_friction": (0.0, "two_pass", 0.3),
}
SIDES = (141, 224)
STEPS = 20
COURANT = 1.0e-4  # s, times the size of a cell over a metre: half of the stable step


def main():
    """Prints a line for each model and size."""
    program = pathlib.Path(sys.argv[1]).resolve()
    print(f"{'model':16s} {'nodes':>7s} {'first step, s':>14s} {'step, s':>9s} {'memory, MiB':>12s}  outcome")
    with tempfile.TemporaryDirectory() as folder:
        for side in [int(word) for word in sys.argv[2:]] or SIDES:
            step = COURANT / side
            for name, (away, method, mu) in MODELS.items():
                case = pathlib.Path(folder) / f"{name}_{side}.toml"
                case.write_text(CASE.format(name=name, plate=side * 9 // 10, block=side - 1, bottom=0.05 + away,
                                            method=method, mu=mu, step=step, end=STEPS * step))
                cost, summary, _ = measure.carom(program, case)
                first, per_step = cost.marks[0], cost.per_step()[0] if len(cost.marks) > 1 else float("nan")
                print(f"{name:16s} {side * side:7d} {first.processor:14.2f} {per_step:9.3f} "
                      f"{cost.memory / 2**20:12.0f}  {summary['outcome']} {summary.get('message', '')}", flush=True)


if __name__ == "__main__":
    main()
