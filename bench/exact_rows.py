#!/usr/bin/python3
"""Time and memory of explicit steps with tens of thousands of rows of exact contact: a block that meets a plate, face
on face, nodes over facets, CD-Lagrange with a lumped mass, one thread.

Usage: exact_rows.py CAROM [SIDE...]. SIDE: nodes along a side of the block's foot; without one 141 and 224 (19,881 and
50,176 nodes) where rows are independent, 61 where they are redundant. Models: away (out of reach, for comparison), nodes
(the foot's nodes over the plate: independent rows), nodes_friction, both (two_pass: the plate's nodes over the foot too, so
that rows are redundant), both_friction. Processor time: to the end of the first step that is seen, with the reading and the
start, at which all rows close together; and of a step.
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

INDEPENDENT, REDUNDANT = (141, 224), (61,)  # sides
MODELS = {
    "away": (1.0, "node_to_surface", 0.0, INDEPENDENT),
    "nodes": (0.0, "node_to_surface", 0.0, INDEPENDENT),
    "nodes_friction": (0.0, "node_to_surface", 0.3, INDEPENDENT),
    "both": (0.0, "two_pass", 0.0, REDUNDANT),
    "both_friction": (0.0, "two_pass", 0.3, REDUNDANT),
}
STEPS = 20
COURANT = 1.0e-4  # s, times the size of a cell over a metre: half of the stable step


def main():
    """Prints a line for each model and size."""
    program = pathlib.Path(sys.argv[1]).resolve()
    print(f"{'model':16s} {'side':>5s} {'first step, s':>14s} {'step, s':>9s} {'memory, MiB':>12s}")
    with tempfile.TemporaryDirectory() as folder:
        for name, (away, method, mu, sides) in MODELS.items():
            for side in [int(word) for word in sys.argv[2:]] or sides:
                step = COURANT / side
                case = pathlib.Path(folder) / f"{name}_{side}.toml"
                case.write_text(CASE.format(name=name, plate=side * 9 // 10, block=side - 1, bottom=0.05 + away,
                                            method=method, mu=mu, step=step, end=STEPS * step))
                cost, summary, _ = measure.carom(program, case)
                if len(cost.marks) < 2:
                    sys.exit(f"{name}: {summary['message']}\n{cost.text[-2000:]}")
                print(f"{name:16s} {side:5d} {cost.marks[0].processor:14.2f} {cost.per_step()[0]:9.3f} "
                      f"{cost.memory / 2**20:12.0f}", flush=True)


if __name__ == "__main__":
    main()
